# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Python package: numbers of a run against its files, refused input, commands."""

import csv
import math
import re
import types
import unittest.mock
import xml.etree.ElementTree as ElementTree

from common import *

PACKAGE = ROOT / "python"
sys.path.insert(0, str(PACKAGE))

try:
    import matplotlib
    import numpy
    import ricochet
    from ricochet import measures, prm
except ImportError:
    numpy = None

# A case of a fraction of a second, with fields.
CASE = """set Program = elastic_ball
subsection Mesh
  set Nodes          = 200
  set Boundary nodes = 40
end
subsection Start
  set Initial gap = 0.0355
end
subsection Time
  set Time step  = 1e-3
  set Final time = 0.04
end
subsection Output
  set Fields every = 10
  set Log every    = 0
end
"""


# A block that falls on a floor with friction and hits another one, in a few milliseconds.
SCENE = """set Program = ricochet
set Dimension = 2
subsection Body left
  set Shape         = rectangle
  set Size          = 1, 1
  set Cells along   = 3, 3
  set Translation   = 0, 0.004
  set Velocity      = 3, -2
  set Young modulus = 1e7
end
subsection Body right
  set Like        = left
  set Velocity    = 0, 0
  set Translation = 1.01, 0.5
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface              = left: lower
  set Against              = floor
  set Treatment            = penalty
  set Friction coefficient = 0.1
end
subsection Contact side
  set Surface              = left: right
  set Against              = right: left
  set Treatment            = penalty
end
subsection Time
  set Time step  = 5e-4
  set Final time = 0.05
end
subsection Output
  set Fields every = 0
  set Log every    = 0
end
"""

# It settles first: multipliers are for equilibria, and most treatments are not.
PHASE_SCENE = SCENE.replace("  set Velocity      = 3, -2\n", "") + """
subsection Condition hold
  set Boundary = right: right
end
subsection Phase settle
  subsection Time
    set Scheme     = static
    set Final time = 1
    set Time step  = 1
  end
  subsection Contact floor
    set Treatment = Signorini active set
  end
  subsection Condition lid
    set Boundary = left: upper
    set Kind     = displacement
    set Value    = 0; -0.01*t
  end
end
subsection Phase go
  set Without = Contact side
  subsection Time
    set Final time = 2e-3
  end
end
"""


@unittest.skipIf(numpy is None, "NumPy or matplotlib (Debian's python3-matplotlib) is missing")
class PythonPackage(ProgramTest):

    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp(prefix="ricochet-"))
        cls.addClassCleanup(shutil.rmtree, cls.shared, ignore_errors=True)
        cls.case = cls.shared / "case.prm"
        cls.case.write_text(CASE)
        cls.ball = ricochet.run(program_path("elastic_ball"), cls.case,
                                output=cls.shared / "ball")

    def script(self, name, *words):
        """Run a command from the source tree; return exit code, output and errors."""
        result = subprocess.run(
            [sys.executable, str(PACKAGE / "bin" / name), *map(str, words)],
            capture_output=True, text=True, timeout=300, cwd=self.folder,
            env={**os.environ, "RICOCHET_PROGRAMS": program_path("")})
        return result.returncode, result.stdout, result.stderr

    def assert_picture(self, path, colours=20):
        """A picture that is not blank: with a least number of colours."""
        from matplotlib import image
        pixels = (255 * image.imread(path)[:, :, :3]).round().astype(int)
        self.assertGreater(min(pixels.shape[:2]), 200)
        self.assertGreater(len(numpy.unique(pixels @ (65536, 256, 1))), colours, msg=path)

    # The table and its summary

    def test_summary_and_table(self):
        ledger = Ledger(self.ball.folder)
        for name, unit in zip(ledger.names, ledger.units):
            self.assertEqual(list(self.ball.table[name]), list(ledger[name]))
            self.assertEqual(self.ball.units[name], unit)
        self.assertEqual(list(self.ball.table), ledger.names)
        self.assertIn("time", self.ball.table)
        self.assertEqual(len(self.ball.table), len(ledger["time"]))
        summary = self.ball.summary()
        energy, force = ledger["energy"], ledger["contact_force_foundation"]
        self.assertEqual(self.ball.contacts, ["foundation"])
        self.assertEqual(summary.energy_lost, (energy[0] - energy[-1]) / energy[0])
        self.assertEqual(summary.largest_force, {"foundation": max(force)})
        self.assertEqual(summary.largest_penetration, max(ledger["penetration_foundation"]))
        self.assertEqual(summary.newton_iterations, sum(ledger["newton_iterations"]))
        self.assertEqual(summary.largest_balance_residual, largest(ledger["balance_residual"]))
        # The program's own words for the numbers in the column are those of the package.
        line = re.search("steps by how they were solved: (.+)", self.ball.log).group(1)
        self.assertEqual(line, ", ".join(f"{k} {n}" for k, n in summary.solvers.items()))
        self.assertEqual(sum(summary.solvers.values()), summary.steps)
        self.assertAlmostEqual(summary.contact_duration, 1e-3 * sum(f > 0 for f in force))
        self.assertGreater(summary.contact_duration, 0.02)
        momentum = ledger["momentum_y"]
        self.assertAlmostEqual(summary.restitution, -momentum[-1] / momentum[0], places=12)
        self.assertIn(" N at ", str(summary))
        found = self.ball.result
        self.assertEqual(found["contacts"]["foundation"]["largest_force"]["value"], max(force))
        self.assertEqual(found["columns"]["energy"]["last"], energy[-1])
        for text in ("[" * 100000, "{}", '{"format": 2}', "\0"):
            other = self.folder / "other"
            other.mkdir(exist_ok=True)
            (other / "parameters.prm").write_text("")
            with self.assertRaises(ricochet.NotARun):
                ricochet.Run(other).result
            (other / "summary.json").write_text(text)
            with self.assertRaises(ricochet.NotARun):
                ricochet.Run(other).result
        self.assertGreater(self.ball.wall_seconds, 0)
        self.assertGreater(self.ball.seconds_in_steps, 0)

    def test_data_frame(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas (Debian's python3-pandas) is missing")
        frame = self.ball.energy
        ledger = Ledger(self.ball.folder)
        self.assertEqual(list(frame.columns), ledger.names)
        self.assertEqual(list(frame["energy"]), list(ledger["energy"]))
        self.assertEqual(frame.attrs["units"]["contact_force_foundation"], "N")

    def test_units_of_the_user_and_unfinished_rows(self):
        """Units are those of the header; a row without an end is left out; an empty cell is
        not a number; a contact may have blanks in its name."""
        run = self.folder / "run"
        run.mkdir()
        (run / "energy.csv").write_text(
            "time [ms],energy [mJ],modified_energy [mJ],external_work [mJ],"
            "contact_force_ball on floor [kN],penetration_ball on floor [mm]\n"
            "0,4,,0,0,0\n1,3,,0.5,2,0.25\n2,3,,0.5,0,0\n3,3,,0.")
        result = ricochet.Run(run)
        self.assertEqual(list(result.table["time"]), [0, 1, 2])
        self.assertTrue(numpy.isnan(result.table["modified_energy"]).all())
        self.assertEqual(result.contacts, ["ball on floor"])
        summary = result.summary()
        self.assertEqual(summary.energy_lost, (4 + .5 - 3) / 4)
        self.assertEqual(summary.contact_duration, 1)
        self.assertIn("2 kN at 1 ms (ball on floor)", str(summary))

    def test_restitution_of_two_disks(self):
        """Restitution from the momenta alone is that of the program."""
        disks = ricochet.run(program_path("colliding_disks"), overrides={
            "Disks/Rings of the left disk": 5, "Disks/Rings of the right disk": 4,
            "Time/Final time": 0.3, "Output/Fields every": 0, "Output/Log every": 0},
            output=self.folder / "disks")
        printed = float(re.search(r"^restitution +(\S+)$", disks.log, re.M).group(1))
        self.assertEqual(disks.summary().restitution, printed)
        ours = measures.restitution(disks.table)
        self.assertIsNotNone(ours)
        # The normal is another one: the direction of the impulse, on a coarse mesh.
        self.assertAlmostEqual(ours, printed, delta=0.005)

    # Fields and parameters

    def test_restitution_of_scenes(self):
        """The run has that of its only contact in summary.json; of several, each has its own."""
        scene = self.folder / "scene.prm"
        scene.write_text(SCENE)
        os.environ["RICOCHET_PROGRAMS"] = program_path("")
        # Friction on an obstacle: the table alone has none.
        one = ricochet.run(scene, overrides={"Body right/Translation": "9, 1"},
                           output=self.folder / "one")
        found = one.result["contacts"]
        self.assertIsNone(found["side"]["restitution"])
        number = found["floor"]["restitution"]
        self.assertTrue(0 < number < 1)
        self.assertEqual(one.summary().restitution, number)
        self.assertEqual(one.summary().contacts["floor"].restitution, number)
        self.assertIsNone(one.summary().contacts["side"].restitution)
        self.assertIn("restitution ", str(one.summary()))
        code, out, error = self.script("ricochet-compare", scene, "--treatments",
                                       "penalty,persistent contact", "-o", self.folder / "both")
        self.assertEqual(code, 0, msg=out + error)
        header, _, *lines = out.splitlines()
        names = [cell.strip() for cell in header.split(" | ")]
        for name in ("floor", "side"):
            column = names.index(f"restitution of {name}")
            for k, line in enumerate(lines[:2], start=1):
                result = ricochet.Run(self.folder / "both" / "runs" / f"{k:02}").result
                self.assertAlmostEqual(float(line.split(" | ")[column]),
                                       result["contacts"][name]["restitution"], delta=1e-3)
        self.assertIn("restitution of side", (self.folder / "both" / "index.html").read_text())
        (one.folder / "summary.json").write_text('{"format": 1, "contacts": 3}')
        with self.assertRaisesRegex(ricochet.NotARun, "is damaged"):
            ricochet.Run(one.folder).summary()

    def test_a_parameter_file_alone(self):
        """It names its program; what stands at another place is refused by a sentence."""
        os.environ["RICOCHET_PROGRAMS"] = program_path("")
        self.assertEqual(ricochet.parameters_of(self.case)["Mesh/Nodes"], "200")
        few = {"Time/Final time": 2e-3, "Output/Fields every": 0}
        run = ricochet.run(self.case, overrides=few, output=self.folder / "alone")
        self.assertEqual(run.program, "elastic_ball")
        outcomes = ricochet.sweep(str(self.case), overrides={"Time/Time step": [1e-3, 2e-3]},
                                  common=few, output=self.folder / "sweep")
        self.assertEqual([len(one.run.table) for one in outcomes], [3, 2])
        nameless = self.folder / "nameless.prm"
        nameless.write_text("subsection Time\nend\n")
        for call in (ricochet.run, ricochet.sweep, ricochet.parameters_of):
            for words, sentence in (
                    ((nameless,), "needs a line 'set Program = NAME'"),
                    ((self.folder / "none.prm",), "does not exist"),
                    ((self.case, self.case), "is a parameter file: it stands alone"),
                    ((self.case, few), "Overrides stand behind the parameter file")):
                with self.assertRaisesRegex(ricochet.RicochetError, sentence):
                    call(*words)
        with self.assertRaisesRegex(ricochet.RicochetError, "needs a line 'set Program = NAME'"):
            ricochet.dataset(nameless, {"A/B": [1]}, 1, 1)

    def test_fields(self):
        entries = ElementTree.parse(self.ball.folder / "solution.pvd").findall(".//DataSet")
        self.assertEqual(list(self.ball.times), [float(e.get("timestep")) for e in entries])
        self.assertEqual(self.ball.steps, [0, 10, 20, 30, 40])
        with self.assertRaisesRegex(ricochet.NotARun, "no fields of step 3; it has those of 0, 10"):
            self.ball.field_file(3)
        self.assertEqual(self.ball.field_file(0.019).step, 20)
        self.assertEqual(self.ball.field_file(0.045).step, 40)
        for time in (5., -.02, math.nan):
            with self.assertRaisesRegex(ricochet.NotARun, "it has those from 0 to 0.04"):
                self.ball.fields(time)
        try:
            import vtkmodules.vtkIOXML
        except ImportError:
            self.skipTest("VTK (Debian's python3-vtk9) is missing")
        from ricochet import fields
        grid = self.ball.fields(20)
        # Over the nodes once: those of neighbouring cells coincide.
        places = fields.array_of_points(grid)
        _, first = numpy.unique(places.round(6), axis=0, return_index=True)
        force = fields.array(grid, "contact_force")[first].sum(axis=0)
        self.assertAlmostEqual(
            force[1] / self.ball.table["contact_force_foundation"][20], 1, places=5)
        lowest = (places + fields.displacements(grid))[:, 1].min()
        self.assertAlmostEqual(
            lowest, self.ball.table["smallest_gap_foundation"][20], places=5)
        # The foundation, as pictures show it: the plane y = 0 with its normal.
        floor = ricochet.results.read_fields(self.ball.field_file(20).obstacles)
        self.assertGreater(floor.GetNumberOfCells(), 0)
        self.assertLess(abs(fields.array_of_points(floor)[:, 1]).max(), 1e-6)
        self.assertTrue((fields.array(floor, "normal") == [0, 1, 0]).all())
        self.assertIn('file="solution/obstacles-000020.vtu"',
                      (self.ball.folder / "obstacles.pvd").read_text())
        damaged = self.folder / "damaged.vtu"
        damaged.write_bytes(self.ball.field_file(20).path.read_bytes()[:2000])
        with self.assertRaisesRegex(ricochet.NotARun, "damaged"):
            ricochet.results.read_fields(damaged)

    def test_curved_cells(self):
        """Small linear tetrahedra fill a quadratic one; numbers do not exceed those at nodes."""
        try:
            import vtk
            from vtkmodules.util.numpy_support import vtk_to_numpy
        except ImportError:
            self.skipTest("VTK (Debian's python3-vtk9) is missing")
        from ricochet import curved
        local = numpy.concatenate([curved._small_ones(halvings)[0] for halvings in (1, 2)])
        shapes, weights = curved.shape_functions(local), curved._linear_weights(local)
        for values in (shapes, weights):
            self.assertLess(abs(values.sum(axis=1) - 1).max(), 1e-14)
        self.assertGreaterEqual(weights.min(), -1e-14)
        corners = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
        nodes = [*corners, *(.5 * (corners[i] + corners[j]) for i, j in curved.EDGES)]
        # The middle of an edge is moved along a parabola: quadratic functions are exact.
        moved = numpy.array([[0, 0, x * (1 - x)] for x, _, _ in nodes])
        grid, points = vtk.vtkUnstructuredGrid(), vtk.vtkPoints()
        for node in nodes:
            points.InsertNextPoint(node)
        grid.SetPoints(points)
        grid.InsertNextCell(curved.QUADRATIC_TETRAHEDRON, 10, list(range(10)))
        self.assertTrue(curved.is_quadratic(grid))
        shown = numpy.arange(10.)
        fine = curved.pieces(grid, {"shown": shown, "moved": moved})
        self.assertEqual(fine.GetNumberOfCells(), 64)
        places = vtk_to_numpy(fine.GetPoints().GetData())
        values = [vtk_to_numpy(fine.GetPointData().GetArray(n)) for n in ("shown", "moved")]
        self.assertEqual((values[0].min(), values[0].max()), (0, 9))
        parabola = places[:, 0] * (1 - places[:, 0])
        self.assertLess(abs(values[1][:, 2] - parabola).max(), 1e-6)
        cells = vtk_to_numpy(fine.GetCells().GetConnectivityArray()).reshape(-1, 4)
        sides = places[cells[:, 1:]] - places[cells[:, :1]]
        volumes = abs(numpy.linalg.det(sides)) / 6
        self.assertLess(abs(volumes - 1 / 384).max(), 1e-7)
        edges = curved.outer_edges(grid, moved, numpy.arange(10))
        self.assertEqual(edges.GetNumberOfLines(), 6)

    def test_parameters(self):
        self.assertEqual(self.ball.program, "elastic_ball")
        self.assertEqual(self.ball.parameters["Mesh/Boundary nodes"], "40")
        self.assertEqual(self.ball.parameters["Linear solver/Type"], "automatic")
        file = self.folder / "mine.prm"
        (self.folder / "base.prm").write_text("set Program = ricochet # for\nsubsection A b\n"
                                              "  set X y = 1, \\\n    2\nend\n")
        file.write_text("include base.prm\nsubsection Contact ball on floor\n subsection C\n"
                        "  set Z =\n end\nend\nsubsection Contact b\nend\n")
        text = prm.read(file)
        self.assertEqual(text.values, {"Program": "ricochet", "A b/X y": "1, 2",
                                       "Contact ball on floor/C/Z": ""})
        self.assertEqual(prm.contact_sections(text), ["Contact ball on floor", "Contact b"])
        self.assertEqual(prm.contact_sections(prm.read(self.case)), ["Contact"])
        file.write_text("include mine.prm\n")
        with self.assertRaisesRegex(ricochet.BadParameterFile, "line 1: .* includes itself"):
            prm.read(file)
        # Signs that end a line for Python, but not for the programs, end no comment.
        file.write_text("# note\x0cset Program = bash\n# \u2028set X = 1\nset Y = 2\x85\r\n",
                        encoding="utf-8")
        self.assertEqual(prm.read(file).values, {"Y": "2\x85"})
        # Each file includes the next one twice.
        for k in range(20):
            (self.folder / f"{k}.prm").write_text(f"include {k + 1}.prm\n" * 2)
        (self.folder / "20.prm").write_text("set Z = 1\n")
        with self.assertRaisesRegex(ricochet.BadParameterFile, "one of more than"):
            prm.read(self.folder / "0.prm")
        # Written data are read back unchanged.
        file.write_text(prm.write(text.values))
        self.assertEqual(prm.read(file).values, text.values)

    def test_names_of_differences(self):
        a = {"Program": "p", "Contact/Treatment": "x", "Time/Time step": "0.0010", "Output/Y": "1"}
        b = {**a, "Contact/Treatment": "y", "Output/Y": "2"}
        c = {**a, "Time/Time step": "2e-3"}
        self.assertEqual(prm.labels([a, b]), ["x", "y"])
        self.assertEqual(prm.labels([a, b, c]), ["x, Time step = 0.001", "y, Time step = 0.001",
                                                 "x, Time step = 0.002"])

    # Refused input

    def test_what_is_no_run(self):
        with self.assertRaisesRegex(ricochet.NotARun, "There is no folder 'nowhere'"):
            ricochet.Run("nowhere")
        with self.assertRaisesRegex(ricochet.NotARun, "holds no run"):
            ricochet.Run(self.folder)
        (self.folder / "energy.csv").write_text("a [m],b [s]\n1,2\n")
        with self.assertRaisesRegex(ricochet.NotARun, "no energy table"):
            ricochet.Run(self.folder).table
        (self.folder / "energy.csv").write_text("time [s],energy [J]\n1,2\n3,four\n")
        with self.assertRaisesRegex(ricochet.NotARun, "not a number in row 2"):
            ricochet.Run(self.folder).table
        with self.assertRaisesRegex(ricochet.NotARun, "has written no fields"):
            ricochet.Run(self.folder).steps
        code, _, error = self.script("ricochet-plot", "nowhere")
        self.assertEqual((code, error), (2, "ricochet-plot: There is no folder 'nowhere'.\n"))

    def test_refused_and_missing_programs(self):
        with self.assertRaises(ricochet.Refused) as caught:
            ricochet.run(program_path("bar_sd"), overrides={"Time/Time step": "fast"},
                         output=self.folder / "x")
        self.assertIn("the value 'fast' of 'Time/Time step' is not allowed", str(caught.exception))
        self.assertEqual(caught.exception.exit_code, 1)
        with self.assertRaisesRegex(ricochet.RicochetError, "no program"):
            ricochet.run("no_such", programs=program_path(""))

    def test_sweep(self):
        outcomes = ricochet.sweep(
            program_path("bar_sd"), overrides={"Time/Time step": [0.1, 0.05],
                                 "Contact/Treatment": ["penalty", "Nitsche-hybrid"]},
            common={"Output/Fields every": 0, "Time/Final time": 1},
            output=self.folder / "sweep", jobs=2)
        self.assertEqual([o.run is not None for o in outcomes], [True, False, True, False])
        self.assertEqual([len(o.run.table) for o in outcomes if o.run], [11, 21])
        self.assertIn("cannot be combined", outcomes[1].error.sentence)
        self.assertTrue(all(o.wall_seconds > 0 for o in outcomes))

    def test_sweep_that_goes_on(self):
        """Runs are computed again where the file, what it names, an override, the program or the
        run in the folder is another one; and one row for each run."""
        case, program = self.folder / "case.prm", self.folder / "bar_sd"
        case.write_text("include more.prm\nsubsection Output\nset Fields every = 0\nend\n")
        more = self.folder / "more.prm"
        more.write_text("subsection Time\nset Final time = 0.2\nend\n")
        own = lambda rest="": program.write_text(
            f'#!/bin/sh\n# {rest}\nexec {program_path("bar_sd")} "$@"\n') and program.chmod(0o755)
        own()
        folder = self.folder / "sweep"

        def computed(treatments=("penalty", "Nitsche"), step=0.1):
            names = []
            found = ricochet.sweep(
                program, case, {"Contact/Treatment": treatments}, folder,
                common={"Time/Time step": step}, progress=lambda one, *_: names.append(
                    one.overrides["Contact/Treatment"]))
            return sorted(names), found

        names, outcomes = computed()
        self.assertEqual(names, ["Nitsche", "penalty"])
        self.assertEqual([one.error for one in outcomes], [None, None])
        names, again = computed()
        self.assertEqual(names, [])
        for one, other in zip(outcomes, again):
            self.assertEqual((one.name, one.overrides, one.run.result, one.error),
                             (other.name, other.overrides, other.run.result, None))
            self.assertGreater(other.wall_seconds, 0)
        self.assertEqual(computed(("penalty", "Signorini multipliers"))[0],
                         ["Signorini multipliers"])
        self.assertEqual(len(computed(step=0.05)[0]), 2)
        more.write_text("subsection Time\nset Final time = 0.3\nend\n")
        self.assertEqual(len(computed(step=0.05)[0]), 2)
        own("built anew")
        self.assertEqual(len(computed(step=0.05)[0]), 2)
        self.assertEqual(computed(step=0.05)[0], [])
        # Another run in the folder, and one that was not finished.
        ricochet.run(program_path("bar_sd"), case, output=folder / "1", overwrite=True)
        (folder / "2" / "summary.json").unlink()
        names, outcomes = computed(("penalty", "Nitsche-hybrid", "Nitsche"), step=0.05)
        self.assertEqual(names, ["Nitsche", "Nitsche-hybrid", "penalty"])

        rows = [ricochet.sampling.row(one.overrides, one) for one in outcomes]
        self.assertEqual([row["state"] for row in rows], ["complete", "refused", "complete"])
        self.assertIn("cannot be combined", rows[1]["reason"])
        self.assertEqual(rows[0]["Time/Time step"], 0.05)
        self.assertEqual(rows[0]["lost_to_contact"],
                         outcomes[0].run.result["energy"]["lost"]["contact"])
        with unittest.mock.patch.dict(sys.modules, {"pandas": None}):
            self.assertEqual(ricochet.frame(outcomes), rows)
        try:
            import pandas
        except ImportError:
            return
        frame = ricochet.frame(outcomes)
        self.assertEqual(list(frame["Contact/Treatment"]), ["penalty", "Nitsche-hybrid", "Nitsche"])
        self.assertTrue(pandas.isna(frame["balance_closes"][1]))

    def test_files_that_parameters_name(self):
        """A mesh, a table or the state of another run that changes is other input."""
        case, mesh = self.folder / "case.prm", self.folder / "a.msh"
        case.write_text("subsection Mesh\nset File = a.msh\nend\n")
        checksums = []
        own = ricochet.programs.checksum_of_file, lambda file: ricochet.programs.checksum_of_inputs(
            pathlib.Path("p"), "", {"Mesh/File": str(file)})

        def add():
            checksums.extend((own[0](case), own[1](mesh)))

        for text in ("1", "2"):
            mesh.write_text(text)
            add()
        mesh.unlink()
        add()
        mesh.mkdir()
        (mesh / "checkpoint.bin").write_text("3")
        add()
        self.assertEqual(len(set(checksums)), 8)
        # Values that are no names of files.
        case.write_text(f"set X = {'x' * 5000}\nset Y =\nset Z = a\0b\n")
        self.assertEqual(own[0](case), own[0](case))

    def test_xarray(self):
        """The table as a data set with units, by whatever `xarray` is installed."""
        calls = []
        stub = types.SimpleNamespace(Dataset=lambda *words, **named: calls.append((words, named)))
        with unittest.mock.patch.dict(sys.modules, {"xarray": stub}):
            self.ball.to_xarray()
        ((columns,), named), = calls
        self.assertEqual({"time", *columns}, set(self.ball.table.columns))
        self.assertNotIn("time", columns)
        for name, (dimension, values, attributes) in {**columns, **named["coords"]}.items():
            self.assertEqual((dimension, attributes), ("time", {"units": self.ball.units[name]}))
            self.assertIs(values, self.ball.table[name])
        with unittest.mock.patch.dict(sys.modules, {"xarray": None}):
            with self.assertRaisesRegex(ricochet.RicochetError, "install the package python3-xa"):
                self.ball.to_xarray()

    def test_names_that_do_not_exist(self):
        """The nearest one is named; who expects a KeyError gets one."""
        for action, nearest in (
                (lambda: self.ball.table["enrgy"], "energy"),
                (lambda: self.ball.units["Time"], "time"),
                (lambda: self.ball.parameters["Time/Time stp"], "Time/Time step"),
                (lambda: self.ball.result["contacts"]["floor"], "foundation"),
                (lambda: self.ball.summary().contacts["fundation"], "foundation"),
                (lambda: self.ball.summary().largest_force["foundatoin"], "foundation"),
                (lambda: measures.duration(self.ball.table, "fundation"),
                 "contact_force_foundation"),
                (lambda: ricochet.fields.COLOURS["vonMises"], "von_mises")):
            with self.assertRaisesRegex(ricochet.NoSuchName, f"Is '{nearest}' meant") as caught:
                action()
            self.assertIsInstance(caught.exception, KeyError)
        with self.assertRaisesRegex(ricochet.RicochetError, "Is 'elastic_ball' meant"):
            ricochet.run("elastic_bal", programs=program_path(""))
        self.assertIsNone(self.ball.parameters.get("A/B"))

    def test_obstacle_that_moves(self):
        """A plate that is lifted and turned has the position of its motion."""
        try:
            import vtkmodules.vtkIOXML
        except ImportError:
            self.skipTest("VTK (Debian's python3-vtk9) is missing")
        from ricochet import fields
        run = ricochet.run(program_path("obstacle_course"),
                           ROOT / "parameter_files/obstacle_course/rising_plate.prm",
                           overrides={"Body/Boundary nodes": 16, "Time/Final time": 0.4,
                                      "Time/Time step": 0.02, "Output/Fields every": 10,
                                      "Output/Log every": 0}, output=self.folder / "plate")
        for file in run.field_files:
            grid = ricochet.results.read_fields(file.obstacles)
            self.assertGreater(grid.GetNumberOfCells(), 2)
            lift = 0.2 * (1 - math.cos(4 * file.time))
            angle = 0.2 * math.sin(3 * file.time)
            normal = numpy.array((-math.sin(angle), math.cos(angle), 0.))
            places = fields.array_of_points(grid)
            self.assertLess(abs((places - [0., lift, 0.]) @ normal).max(), 1e-6)
            self.assertLess(abs(fields.array(grid, "normal") - normal).max(), 1e-6)

    # Commands

    def test_plot(self):
        words = ["-o", self.folder / "plots"]
        names = ["energies.png", "contact_forces.png", "gaps.png"]
        try:
            import vtkmodules.vtkIOXML
            if shutil.which("xvfb-run") or os.environ.get("DISPLAY"):
                words += ["--fields", "--animation", "gif", "--frames", "3"]
                names.append("fields_von_mises.png")
        except ImportError:
            pass
        code, out, error = self.script("ricochet-plot", self.ball.folder, *words)
        self.assertEqual(code, 0, msg=error)
        for name in names:
            self.assert_picture(self.folder / "plots" / name)
        if len(names) > 3:
            # The colours of the body: it is not white inside.
            self.assert_picture(self.folder / "plots" / "fields_von_mises.png", 500)
            from PIL import Image
            with Image.open(self.folder / "plots" / "animation_von_mises.gif") as film:
                self.assertGreaterEqual(film.n_frames, 3)
        if not shutil.which("ffmpeg"):
            code, _, error = self.script("ricochet-plot", self.ball.folder, "--animation", "mp4")
            self.assertEqual(code, 2)
            self.assertIn("needs ffmpeg", error)

    def test_a_file_that_crashes_vtk(self):
        try:
            import vtkmodules.vtkIOXML
        except ImportError:
            self.skipTest("there is no VTK")
        run = self.folder / "damaged"
        shutil.copytree(self.ball.folder, run)
        for file in run.glob("solution/step-*.vtu"):
            file.write_text(re.sub('NumberOfPoints="[0-9]*"',
                                   'NumberOfPoints="1000000000000"', file.read_text()))
        code, _, error = self.script("ricochet-plot", run, "--fields", "-o", run / "plots")
        self.assertEqual(code, 2, msg=error)
        self.assertRegex(error.splitlines()[-1],
                         "^ricochet-plot: .*(VTK crashed|damaged)")

    def test_compare(self):
        folder = self.folder / "compared"
        code, out, error = self.script(
            "ricochet-compare", self.case, "--treatments",
            "persistent contact,Signorini active set", "--schemes", "Crank-Nicolson",
            "--impact-positions", "2", "--set", "Contact/Compliance exponent=3",
            "--finest", "Time/Time step=5e-4", "--jobs", "2", "-o", folder)
        self.assertEqual(code, 0, msg=out + error)
        lines = {line.split(" | ")[0].strip(): [cell.strip() for cell in line.split(" | ")[1:]]
                 for line in out.splitlines() if " | " in line}
        header = lines.pop("method")
        refused, good = (f"{treatment}, Crank-Nicolson"
                         for treatment in ("persistent contact", "Signorini active set"))
        self.assertEqual(list(lines), [refused, good])
        # The refused one has its reason, and the other one numbers.
        self.assertIn("cannot be combined with the time scheme 'Crank-Nicolson'",
                      lines[refused][0])
        cells = dict(zip(header, lines[good]))
        tables = [ricochet.Run(path).table for path in sorted((folder / "runs").glob("02-impact*"))]
        self.assertEqual(len(tables), 2)
        lost = [100 * measures.energy_lost(table) for table in tables]
        self.assertAlmostEqual(float(cells["energy lost (%)"].split()[0]), sum(lost) / 2, places=3)
        self.assertIn("error of displacement (%)", header)
        # The impacts are half a step apart, at a quarter and at three quarters of it.
        gaps = [table["smallest_gap_foundation"][0] for table in tables]
        self.assertEqual([round(gap / 1e-2 % 1, 6) for gap in gaps], [.25, .75])
        page = (folder / "index.html").read_text()
        self.assertEqual(page.count("data:image/png;base64,"), 4)
        self.assertNotIn("src=\"http", page)
        self.assertIn("cannot be combined", page)

    def test_dataset(self):
        """Samples fill their ranges evenly, are the same for a seed, and are not computed twice;
        rows have what the summaries have."""
        ranges = {"Start/Initial gap": (.0305, .0405), "Time/Time step": [1e-3, 2e-3],
                  "Contact/Treatment": ["Nitsche", "Signorini active set", "no treatment"]}
        draws = ricochet.samples(ranges, 8, 5)
        self.assertEqual(draws, ricochet.samples(ranges, 8, 5))
        self.assertNotEqual(draws, ricochet.samples(ranges, 8, 6))
        self.assertEqual(sorted(int((draw["Start/Initial gap"] - .0305) / .01 * 8)
                                for draw in draws), list(range(8)))
        folder = self.folder / "set"
        os.environ["RICOCHET_PROGRAMS"] = program_path("")
        count = []
        rows = ricochet.dataset(self.case, ranges, 8, 5, output=folder,
                                progress=lambda *_: count.append(1))
        self.assertEqual(len(count), 8)
        self.assertEqual(len({row["hash"] for row in rows}), 8)
        states = {row["state"] for row in rows}
        self.assertEqual(states, {"complete", "refused"})
        for row, draw in zip(rows, draws):
            self.assertEqual(row["state"] == "refused", draw["Contact/Treatment"] == "no treatment")
            if row["state"] == "complete":
                self.assertIs(row["balance_closes"], True)
                result = ricochet.Run(folder / row["hash"]).result
                self.assertEqual(row["lost_to_contact"], result["energy"]["lost"]["contact"])
                self.assertEqual(row["largest_force_foundation"],
                                 result["contacts"]["foundation"]["largest_force"]["value"])
        again = []
        self.assertEqual(ricochet.dataset(self.case, ranges, 8, 5, output=folder,
                                          progress=lambda *_: again.append(1)), rows)
        # Refused samples are asked again.
        self.assertEqual(len(again), sum(row["state"] == "refused" for row in rows))
        with open(folder / "dataset.csv", newline="") as file:
            self.assertEqual([row["hash"] for row in csv.DictReader(file)],
                             [row["hash"] for row in rows])
        for bad in ({}, {"A/B": (2, 1)}, {"A/B": []}):
            with self.assertRaises(ricochet.RicochetError):
                ricochet.dataset(self.case, bad, 2, 1, output=folder)

    def test_compare_by_parameters(self):
        """Parts of the loss add up to it; the observed order is that of the numbers."""
        from ricochet import comparison
        self.assertAlmostEqual(comparison.order([.4, .2, .1], [17., 5., 2.]), 2.)
        self.assertAlmostEqual(comparison.order([.4, .2, .1], [5., 3., 2.]), 1.)
        self.assertIsNone(comparison.order([.4, .2, .1], [1., 2., 1.5]))
        self.assertIsNone(comparison.order([.4, .2, .1], [1., 1., 1.]))
        folder = self.folder / "varied"
        code, out, error = self.script(
            "ricochet-compare", self.case, "--vary", "Time/Time step=2e-3,1e-3,5e-4", "--vary",
            "Contact/Treatment=Signorini active set,penalty", "--schemes", "Crank-Nicolson",
            "-o", folder)
        self.assertEqual(code, 0, msg=out + error)
        rows = [line for line in out.splitlines() if line.startswith("Crank-Nicolson, Time step")]
        self.assertEqual(len(rows), 6)
        with open(folder / "table.csv", newline="") as file:
            table = list(csv.DictReader(file))
        for row in table:
            parts = sum(float(row[f"mean to {what} (%)"]) for what in ("contact", "scheme")
                        if f"mean to {what} (%)" in row)
            self.assertAlmostEqual(parts, float(row["mean energy lost (%)"]), delta=1e-7)
        lines = [line for line in out.splitlines() if line.startswith("Observed orders in")]
        self.assertEqual(len(lines), 2)
        self.assertIn("(0.002, 0.001, 0.0005): Crank-Nicolson, Contact/Treatment = penalty: "
                      "energy lost", lines[1])
        self.assertIn("Observed orders", (folder / "index.html").read_text())
        for words, sentence in ((["--vary", "Time/Time step"], "not of the form"),
                                (["--vary", "Time/Time step=1,,2"], "a value is empty"),
                                (["--vary", "Time/Time step=1,1"], "there twice"),
                                (["--vary", "A/B=1", "--vary", "A/B=2"], "varied already")):
            code, _, error = self.script("ricochet-compare", self.case, *words, "-o",
                                         self.folder / "refused")
            self.assertEqual(code, 2)
            self.assertIn(sentence, error)

    def test_compare_of_phases(self):
        """Treatments and schemes are those of phases in motion, of the contacts that are there."""
        scene = self.folder / "phases.prm"
        scene.write_text(PHASE_SCENE)
        found = prm.read(scene)
        self.assertEqual(prm.contact_sections(found), ["Phase go/Contact floor"])
        self.assertEqual(prm.scheme_parameters(found), ["Phase go/Time/Scheme"])
        folder = self.folder / "compared"
        code, out, error = self.script(
            "ricochet-compare", scene, "--treatments", "persistent contact,penalty", "--schemes",
            "midpoint", "--set", "Phase go/Contact floor/Friction coefficient=0.2", "-o", folder)
        self.assertEqual(code, 0, msg=out + error)
        for number, treatment in enumerate(("persistent contact", "penalty"), start=1):
            self.assertRegex(out, rf"(?m)^{treatment}, midpoint +\| +-?\d")
            run = folder / "runs" / f"{number:02}"
            settle, go = (prm.read(run / name / "parameters.prm").values
                          for name in ("1_settle", "2_go"))
            self.assertEqual(settle["Contact floor/Treatment"], "Signorini active set")
            self.assertEqual(settle["Time/Scheme"], "static")
            self.assertEqual(go["Contact floor/Treatment"], treatment)
            self.assertEqual(go["Contact floor/Friction coefficient"], "0.2")
        static = ["--set", "Phase go/Time/Scheme=static"]
        for words, sentence in (
                (["--treatments", "penalty", *static], "No phase of '.*' is in motion"),
                (["--schemes", "midpoint", *static], "No phase of '.*' is in motion"),
                (["--impact-positions", "2"], "the first phase of '.*' is static"),
                (["--vary", "Phase og/Time/Time step=1,2"], "Is 'Phase go' meant"),
                (["--vary", "Phase go/Time/Tim step=1,2"], "Is 'Phase go/Time/Time step' meant"),
                (["--treatments", "penalty", "--vary", "Contact floor/Treatment=Nitsche,penalty"],
                 "chosen twice, by --treatments and by --vary")):
            code, _, error = self.script("ricochet-compare", scene, *words, "-o",
                                         self.folder / "refused")
            self.assertEqual(code, 2, msg=error)
            self.assertRegex(error, sentence)

    def test_compare_with_one_parameter_twice(self):
        """One of two options would win, and rows be named after the other one."""
        vary = ["--vary", "Time/Scheme=HHT,TR-BDF2"]
        for words, names in (
                (["--schemes", "midpoint", *vary], "'Time/Scheme' .* --schemes and by --vary"),
                (["--treatments", "Nitsche", "--vary", "Contact/Treatment=penalty"],
                 "'Contact/Treatment' .* --treatments and by --vary"),
                (["--set", "Time/Scheme=HHT", *vary], "'Time/Scheme' .* --vary and by --set"),
                (["--set", "Time/Scheme=HHT", "--schemes", "HHT"], "--schemes and by --set"),
                (["--set", "Time/Scheme=HHT", "--set", "Time/Scheme=HHT"], "--set and by --set"),
                (["--impact-positions", "2", "--vary", "Start/Initial gap=0.01,0.02"],
                 "'Start/Initial gap' .* --impact-positions and by --vary")):
            code, out, error = self.script("ricochet-compare", self.case, *words, "-o",
                                           self.folder / "twice")
            self.assertEqual((code, out), (2, ""))
            self.assertRegex(error, f"{names}: leave one of them out")
            self.assertFalse((self.folder / "twice").exists())

    def test_compare_at_positions_of_each_step(self):
        """Impacts are spread over the step of the row."""
        folder = self.folder / "steps"
        code, out, error = self.script(
            "ricochet-compare", self.case, "--impact-positions", "2", "--vary",
            "Time/Time step=8e-4,1.4e-3", "--vary", "Contact/Treatment=penalty,no treatment",
            "-o", folder)
        self.assertEqual(code, 0, msg=out + error)
        self.assertEqual(out.count("'no treatment' of 'Contact/Treatment' is not allowed"), 2)
        for number, step in ((1, 8e-4), (3, 1.4e-3)):
            tables = [ricochet.Run(path).table
                      for path in sorted((folder / "runs").glob(f"{number:02}-impact*"))]
            self.assertEqual([round(table["smallest_gap_foundation"][0] / (10 * step) % 1, 6)
                              for table in tables], [.25, .75])

    def test_compare_with_a_misspelt_method(self):
        """Nothing is run, and the nearest name is suggested."""
        scene = self.folder / "scene.prm"
        scene.write_text("""set Program = ricochet
set Dimension = 2
subsection Body ball
  set Shape = disk
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact on floor
  set Surface = ball
  set Against = floor
end
""")
        for case, words, wrong, nearest in (
                (self.case, ["--treatments", "penalty,persistant contact"],
                 "treatment 'persistant contact'", "persistent contact"),
                (self.case, ["--treatments", "PENALTY"], "treatment 'PENALTY'", "penalty"),
                (self.case, ["--schemes", "midpoint,TR-BFD2"], "scheme 'TR-BFD2'", "TR-BDF2"),
                (scene, ["--treatments", "nitsche"], "treatment 'nitsche'", "Nitsche"),
                (self.case, ["--vary", "Time/Tim step=1e-3,2e-3"], "parameter 'Time/Tim step'",
                 "Time/Time step"),
                (self.case, ["--set", "Tme/Time step=1e-3"], "parameter 'Tme/Time step'",
                 "Time/Time step"),
                (scene, ["--finest", "Contact on floor/Stik=exact"],
                 "parameter 'Contact on floor/Stik'", "Contact on floor/Stick")):
            code, out, error = self.script("ricochet-compare", case, *words, "-o",
                                           self.folder / "misspelt")
            self.assertEqual(code, 2, msg=out + error)
            self.assertRegex(error, f"There is no {wrong}. "
                                    f"(The nearest valid name is|Is) '{nearest}'")
            self.assertEqual(out, "")
            self.assertFalse((self.folder / "misspelt").exists())

    def test_compare_runs_our_programs_only(self):
        """A parameter file may come from an untrusted source: a program named in it is not run."""
        own = self.folder / "evil"
        own.write_text(f"#!/bin/sh\ntouch {self.folder}/was_run\n")
        own.chmod(0o755)
        for name in ("bash", str(own), "../evil", "true"):
            case = self.folder / "hostile.prm"
            case.write_text(f"set Program = {name}\n")
            code, _, error = self.script("ricochet-compare", case)
            self.assertEqual(code, 2, msg=error)
            self.assertIn("is no program of Ricochet; those are ricochet, bar_sd", error)
        self.assertFalse((self.folder / "was_run").exists())

    def test_compare_without_a_file(self):
        code, _, error = self.script("ricochet-compare", self.folder / "none.prm")
        self.assertEqual(code, 2)
        self.assertIn("does not exist", error)


if __name__ == "__main__":
    main()
