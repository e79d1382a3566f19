# SPDX-License-Identifier: LGPL-2.1-or-later
"""Data of a run besides its table: points and nodes of each contact, fields as HDF5 files, and the
largest values and the restitution in the summary. Against the table, VTU files, and by hand."""

import json

from common import *

sys.path.insert(0, str(ROOT / "python"))
try:
    import h5py
    import numpy as np
    from ricochet import NotARun, RicochetError, Run
except ImportError:
    h5py = None

SCENE = """
set Program   = ricochet
set Dimension = {dimension}
subsection Body ball
  set Shape         = {shape}
  set Size          = {size}
  set Cells along   = {cells}
  set Translation   = {above}
  set Velocity      = {down}
  set Young modulus = 1e5
end
subsection Body slab
  set Shape         = {shape}
  set Size          = {slab}
  set Cells along   = {slab_cells}
  set Young modulus = 2e5
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact ball on slab
  set Surface              = ball: lower
  set Against              = slab: upper
  set Friction coefficient = 0.3
end
subsection Contact floor
  set Surface = slab: lower
  set Against = floor
end
subsection Time
  set Final time = 0.06
  set Time step  = 2e-3
end
subsection Output
  set Fields every  = 15
  set Contact every = 5
end
"""
# In the order of dimensions.
SIZES = {
    2: dict(shape="rectangle", size="0.4, 0.2", cells="3, 2", above="0.3, 0.21", down="0.5, -2", slab="1, 0.2",
            slab_cells="5, 1"),
    3: dict(shape="block", size="0.4, 0.4, 0.2", cells="3, 2, 2", above="0.3, 0.3, 0.21", down="0.5, 0, -2",
            slab="1, 1, 0.2", slab_cells="5, 5, 1"),
}


@unittest.skipUnless(h5py, "needs h5py and NumPy")
class RunData(ProgramTest):
    def run_scene(self, dimension, parameters=(), folder=None, **kwargs):
        file = self.folder / "scene.prm"
        file.write_text(SCENE.format(dimension=dimension, **SIZES[dimension]))
        folder = folder or self.folder / "run"
        ledger = self.run_program("ricochet", ["Output/Log every=0", *parameters], folder,
                                  prm=file, **kwargs)
        return Run(folder), ledger

    def test_restitution_needs_bodies_that_come(self):
        """Two bars that touch, with one velocity, meet a wall: that of the bar and the wall exists,
        that of the two bars would be a quotient of round-off."""
        text = "set Program = ricochet\nset Dimension = 2\n"
        for name, place in (("a", 0.), ("b", 1.)):
            text += (f"subsection Body {name}\n  set Shape = rectangle\n  set Cells along = 4, 2\n"
                     f"  set Translation = {place}, 0\n  set Velocity = 1, 0\nend\n")
        text += """
subsection Obstacle wall
  set Shape     = half space
  set Centre    = 2.01, 0
  set Direction = -1, 0
end
subsection Contact ab
  set Surface = a: right
  set Against = b: left
end
subsection Contact wall
  set Surface = b: right
  set Against = wall
end
subsection Time
  set Final time = 0.3
  set Time step  = 0.002
end
"""
        file = self.folder / "scene.prm"
        file.write_text(text)
        self.run_program("ricochet", NO_FIELDS, self.folder / "run", prm=file)
        contacts = Run(self.folder / "run").result["contacts"]
        self.assertGreater(contacts["ab"]["largest_force"]["value"], 0)
        self.assertIsNone(contacts["ab"]["restitution"])

    def test_points_and_nodes_of_contacts(self):
        """Sums over points and nodes are the columns of the table; the smallest gap is the
        column's; forces between two bodies cancel."""
        for dimension, n_ranks in ((2, 1), (3, 2)):
            with self.subTest(dimension=dimension, n_ranks=n_ranks):
                run, ledger = self.run_scene(dimension, n_ranks=n_ranks)
                for name in ("ball_on_slab", "floor"):
                    contact = run.contact(name)
                    self.assertEqual(contact.steps, list(range(0, 31, 5)))
                    largest = max(ledger[f"contact_force_{name}"])
                    self.assertGreater(largest, 0)
                    for each in contact:
                        self.assertAlmostEqual(each.time, ledger["time"][each.step], 12)
                        force = ledger[f"contact_force_{name}"][each.step]
                        self.assertLess(abs(each.normal_force.sum() - force), 1e-12 * largest)
                        gap = ledger[f"smallest_gap_{name}"][each.step]
                        self.assertLess(abs(each.gap.min() - gap), 1e-12)
                        self.assertEqual(each.active.sum(),
                                         ledger[f"active_points_{name}"][each.step])
                        loaded = each.area > 0
                        self.assertLess(
                            abs((each.pressure * each.area)[loaded].sum() - force), 1e-12 * largest)
                        if name == "floor":
                            for c, axis in enumerate("xyz"[:dimension]):
                                column = ledger[f"resultant_{axis}_{name}"][each.step]
                                self.assertLess(abs(each.force[:, c].sum() - column),
                                                1e-12 * largest)
                            # The floor is the plane below: gaps are heights.
                            np.testing.assert_allclose(each.position[:, -1], each.gap, atol=1e-12)
                        elif len(each.force):
                            np.testing.assert_allclose(each.force.sum(axis=0), 0,
                                                       atol=1e-10 * largest)
                frame = run.contact("floor").frame()
                self.assertEqual(list(frame.columns[:3]), ["time", "step", "x"])
        with self.assertRaisesRegex(RicochetError, "Is 'floor' meant"):
            run.contact("flor")

    def test_one_treatment_with_several_boundaries(self):
        """Both ends of a bar: their points are apart, nodal forces together."""
        ledger = self.run_program("bar_ss", [*NO_FIELDS, "Output/Contact every=20",
                                             "Time/Final time=6"])
        run = Run(self.folder / "run")
        left, right = run.contact("left"), run.contact("right")
        for a, b in zip(left, right):
            for each, name in ((a, "left"), (b, "right")):
                self.assertAlmostEqual(each.normal_force.sum(),
                                       ledger[f"contact_force_{name}"][each.step], 12)
            self.assertAlmostEqual(float(a.force.sum()),
                                   a.normal_force.sum() - b.normal_force.sum(), 12)
        # A run without leaves none of the earlier one.
        self.run_program("bar_ss", [*NO_FIELDS, "Time/Final time=1"])
        with self.assertRaisesRegex(NotARun, "Output/Contact every"):
            Run(self.folder / "run").contact("left")

    def test_fields_in_hdf5(self):
        """The same fields as in VTU files, to the seven digits of deal.II's patches, also on two ranks and
        after --resume."""
        for dimension, n_ranks in ((2, 1), (3, 2)):
            with self.subTest(dimension=dimension, n_ranks=n_ranks):
                vtu, _ = self.run_scene(dimension, folder=self.folder / f"vtu{dimension}")
                hdf5, ledger = self.run_scene(
                    dimension, ["Output/Fields format=hdf5"], self.folder / f"hdf5{dimension}",
                    n_ranks=n_ranks)
                self.assertEqual(hdf5.steps, vtu.steps)
                np.testing.assert_allclose(hdf5.times, vtu.times, atol=1e-12)
                for step in vtu.steps:
                    places, order = self.sorted_nodes(hdf5, step)
                    others, other_order = self.sorted_nodes(vtu, step)
                    np.testing.assert_allclose(places, others, atol=1e-6)
                    # Points have all digits.
                    np.testing.assert_allclose(5 * places[:, 0], np.round(5 * places[:, 0] * 30) / 30,
                                               atol=1e-12)
                    for name in ("displacement", "contact_force", "von_mises", "part"):
                        values = hdf5.field(name, step)[order]
                        expected = vtu.field(name, step)[other_order]
                        np.testing.assert_allclose(values, expected, rtol=2e-6,
                                                   atol=2e-6 * abs(expected).max() + 1e-30)
                    forces = hdf5.field("contact_force", step)
                    largest = max(ledger["contact_force_floor"])
                    for c, axis in enumerate("xyz"[:dimension]):
                        # The forces between two bodies cancel.
                        self.assertLess(
                            abs(forces[:, c].sum() - ledger[f"resultant_{axis}_floor"][step]),
                            1e-6 * largest)
        folder = self.folder / "stopped"
        short = ["Output/Fields format=hdf5", "Output/Checkpoint every=15"]
        self.run_scene(2, [*short, "Time/Final time=0.03"], folder)
        resumed, _ = self.run_scene(2, short, folder, options=["--resume"])
        self.assertEqual(resumed.steps, [0, 15, 30])
        np.testing.assert_array_equal(resumed.field("velocity", 30),
                                      Run(self.folder / "hdf52").field("velocity", 30))
        # Files of a run with HDF5 do not stay beside those of another one.
        self.run_scene(2, folder=folder)
        self.assertEqual([file for file in folder.glob("**/*") if file.suffix in (".xdmf", ".h5")
                          and file.name != "energy.h5" and file.parent.name != "contact"], [])

    @staticmethod
    def sorted_nodes(run, step):
        """Positions with the body of each, in an order that does not depend on cells."""
        nodes = np.column_stack([run.nodes(step), run.field("part", step)])
        order = np.lexsort(np.round(nodes, 6).T)
        return nodes[order], order

    def test_extremes_and_restitution(self):
        """The largest values of fields against the VTU files of each step, with their places; the
        restitution by hand from the momenta of the table."""
        run, ledger = self.run_scene(2, ["Output/Fields every=1", "Time/Final time=0.1",
                                         "Output/Contact every=0"])
        found = run.result["largest_of_written_fields"]
        self.assertEqual(found["acceleration"]["unit"], "m/s^2")
        for name, entry in found.items():
            lengths = [np.linalg.norm(run.field(name, step), axis=1).max() if name != "von_mises"
                       else self.largest_in_cells(run, name, step) for step in run.steps]
            self.assertAlmostEqual(entry["value"] / max(lengths), 1, 5)
            step = run.steps[int(np.argmax(lengths))]
            self.assertAlmostEqual(entry["time"], ledger["time"][step], 9)
            places = run.nodes(step)[:, :2]
            self.assertLess(np.linalg.norm(places - entry["place"], axis=1).min(), 1e-6)
        force = ledger["contact_force_ball_on_slab"]
        touching = [k for k, value in enumerate(force) if value > 0]
        before, after = touching[0] - 1, touching[-1] + 1
        # Densities are the same: 80 kg and 200 kg.
        velocities = [np.array([ledger[f"momentum_{c}_ball"][k] / 80
                                - ledger[f"momentum_{c}_slab"][k] / 200 for c in "xy"])
                      for k in (before, after)]
        change = velocities[1] - velocities[0]
        self.assertAlmostEqual(run.result["contacts"]["ball_on_slab"]["restitution"],
                               -(velocities[1] @ change) / (velocities[0] @ change), 9)
        self.assertIn("restitution", (self.folder / "run/log.txt").read_text())

    @staticmethod
    def largest_in_cells(run, name, step):
        from ricochet.fields import array
        return array(run.fields(step), name).max()


if __name__ == "__main__":
    main()
