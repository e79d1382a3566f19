# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two hollow tori that collide, with self-contact: energy, all six momenta, the walls inside with
self-contact and without it, ranks, restart, the same in a scene, and refused input.

They lie flat against each other, so that their tubes are squashed all around: the walls meet
inside after half of the run.
"""

from common import *

sys.path.insert(0, str(ROOT / "figures"))
try:
    import numpy as np
    from shared import overlap_in_space
except ImportError:
    np = None
needs_numpy = unittest.skipIf(np is None,
                              "NumPy or VTK (Debian's python3-numpy, python3-vtk9) is missing")

FLAT = ["Tori/Wall=0.1", "Tori/Cells around the ring=10", "Tori/Cells around the tube=10",
        "Tori/Centre of the left torus=-0.42, 0, 0", "Tori/Axis of the left torus=1, 0.03, 0.05",
        "Tori/Centre of the right torus=0.42, 0.1, 0.07",
        "Tori/Axis of the right torus=1, -0.1, 0.02",
        "Material/Young modulus=1e5", "Time/Time step=3e-3", "Time/Final time=0.09"]
PERSISTENT = ["Contact/Treatment=persistent contact", "Contact/Friction coefficient=0.3"]
WITHOUT = ["Contact/Self=false"]
MOMENTA = ("momentum_x", "momentum_y", "momentum_z", "angular_momentum_x",
           "angular_momentum_y", "angular_momentum_z")
INSIDES = ("left_inside", "right_inside")


class CollidingTori(ProgramTest):

    def check(self, ledger):
        scale = ledger["energy"][0]
        self.assertLess(largest(ledger["balance_residual"]), 1e-10)
        self.assertGreaterEqual(min(increments(ledger["friction_work"])), -1e-12 * scale)
        momentum = abs(ledger["momentum_x_left"][0])
        for name in MOMENTA:
            drift = largest([p - ledger[name][0] for p in ledger[name]])
            self.assertLess(drift / momentum, 1e-10, msg=name)

    def overlap_with_themselves(self, folder):
        """Volumes and depths of each torus at the end, computed independently of the program."""
        last = sorted((folder / "solution").glob("step-*.vtu"))[-1]
        return overlap_in_space.overlap_in(last, itself=True)

    @needs_numpy
    def test_walls_meet_inside(self):
        cases = [("with", "colliding_tori", FLAT + PERSISTENT + ["Output/Fields every=30"]),
                 ("without", "colliding_tori",
                  FLAT + PERSISTENT + WITHOUT + ["Output/Fields every=30"])]
        ledgers = dict(self.run_many(cases))
        for name, ledger in ledgers.items():
            with self.subTest(name):
                self.check(ledger)
                scale = ledger["energy"][0]
                total = [e + w for e, w in zip(ledger["energy"], ledger["friction_work"])]
                self.assertLess(largest([e - scale for e in total]), 1e-9 * scale)
                self.assertGreater(ledger["friction_work"][-1], 1e-2 * scale)
        # Most of what is left of the overlap is between nodes of these coarse meshes.
        found, passed = (self.overlap_with_themselves(self.folder / f"case-{n}")
                         for n in (0, 1))
        self.assertGreater(passed.volume, .05)
        self.assertLess(found.volume, .2 * passed.volume)
        # The insides push as hard as the outsides.
        for name in INSIDES:
            self.assertGreater(max(ledgers["with"][f"contact_force_{name}"]), 1e4)

    def test_one_and_two_ranks_and_restart(self):
        parameters = FLAT + PERSISTENT + NO_FIELDS + [
            "Output/Checkpoint every=1000", "Time/Final time=0.024",
            "Tori/Cells around the ring=8", "Tori/Cells around the tube=8"]
        whole = self.run_program("colliding_tori", parameters, self.folder / "1")
        self.check(whole)
        self.assertGreater(max(whole["contact_force_left_outside"]), 1e4)
        two = self.run_program("colliding_tori", parameters, self.folder / "2", n_ranks=2)
        for name in ("energy", "friction_work", "momentum_y_right",
                     "angular_momentum_x_right", "contact_force_right_outside"):
            scale = largest(whole[name])
            self.assertLess(largest([a - b for a, b in zip(whole[name], two[name])]),
                            1e-9 * scale, msg=name)
        self.run_program("colliding_tori", parameters + ["Time/Final time=0.012"],
                         self.folder / "parts")
        self.run_program("colliding_tori", parameters, self.folder / "parts",
                         options=["--resume"])
        self.assertEqual((self.folder / "1" / "energy.csv").read_text(),
                         (self.folder / "parts" / "energy.csv").read_text())

    def test_what_is_refused(self):
        for parameters, words in (
                (["Material/Law=linear elastic"], "Linear elastic bodies cannot turn"),
                (["Tori/Wall=0.35"], "thinner than the radius of its tube"),
                (["Tori/Tube radius=1.1"], "has a hole"),
                (["Tori/Axis of the left torus=0, 0, 0"], "needs a length"),
                (["Contact/Treatment=Nitsche"], "Nitsche"),
                (["Time/Scheme=TR-BDF2"], "TR-BDF2"),
                (["Tori/Centre of the left torus=0.9, 0, 0"], "overlap")):
            with self.subTest(" ".join(parameters)):
                code, out, err = self.attempt("colliding_tori", parameters)
                self.assertEqual(code, 1, msg=out + err)
                self.assertIn(words, " ".join(err.split()))


if __name__ == "__main__":
    main()
