# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results do not depend on the number of MPI ranks."""

from common import *


class Ranks(ProgramTest):

    def compare(self, program, parameters):
        ledgers = [self.run_program(program, parameters,
                                    self.folder / f"{n}-ranks", n_ranks=n)
                   for n in (1, 2)]
        self.assertEqual(ledgers[0].names, ledgers[1].names)
        for name in ledgers[0].names:
            if name in NOISE:
                continue
            # Some columns are round-off by themselves: the dissipation of a
            # scheme that conserves, the penetration of Signorini's condition.
            # They are relative to the quantity that they are part of.
            whole = {"numerical_dissipation": "energy",
                     "penetration_foundation": "mean_gap_foundation",
                     "penetration_left": "mean_gap_left",
                     "penetration_right": "mean_gap_right"}.get(name, name)
            if is_part_of_energy(name):
                whole = "energy"
            scale = max(map(abs, ledgers[0][whole])) or 1.
            difference = max(abs(a - b) for a, b in
                             zip(ledgers[0][name], ledgers[1][name]))
            self.assertLess(difference / scale, 1e-10, msg=name)

    def test_each_kind_of_treatment(self):
        cases = (
                ("bar_sd", "Nitsche", "CN", "consistent"),
                ("bar_sd", "Nitsche-hybrid", "midpoint", "consistent"),
                ("bar_sd", "penalty", "HHT -0.02", "redistributed"),
                ("bar_sd", "proximal augmented Lagrangian", "TR-BDF2",
                 "consistent"),
                ("bar_sd", "Signorini multipliers", "HHT 0.05", "redistributed"),
                ("bar_sd", "Signorini active set", "TR-BDF2", "consistent"),
                ("bar_ss", "Nitsche", "HHT 0.05", "redistributed"),
                ("bar_ss", "Signorini active set", "TR-BDF2", "consistent"))
        # One with multipliers and one without, with assertions.
        for program, treatment, scheme, mass in (cases[3::3] if is_debug_build()
                                                 else cases):
            with self.subTest(f"{program} {treatment} {scheme} {mass}"):
                self.compare(program, NO_FIELDS + SCHEMES[scheme] +
                             [f"Contact/Treatment={treatment}",
                              f"Time/Mass={mass}"])

    def test_forces_of_velocities(self):
        """Friction and viscosity of instants, by exact and by regularised friction."""
        for treatment, scheme in (("Signorini active set", "generalised-alpha"),
                                  ("Nitsche", "TR-BDF2")):
            viscous = treatment != "Nitsche"
            with self.subTest(treatment):
                self.compare("elastic_ball", NO_FIELDS + BALL + SCHEMES[scheme] + [
                    "Start/Initial velocity=6, -10", "Time/Final time=0.01",
                    "Contact/Friction coefficient=0.3",
                    f"Contact/Treatment={treatment}"] +
                    ["Material/Viscosity=linear", "Material/Viscosity eta=1e6"] * viscous)

    def test_more_ranks_than_cells(self):
        """Ranks without cells take part in everything."""
        parameters = NO_FIELDS + ["Mesh/Mesh size=0.5", "Time/Final time=1",
                                  "Contact/Treatment=proximal augmented "
                                  "Lagrangian"]
        one = self.run_program("bar_ss", parameters, self.folder / "one")
        four = self.run_program("bar_ss", parameters, self.folder / "four",
                                n_ranks=4)
        for a, b in zip(one["energy"], four["energy"]):
            self.assertAlmostEqual(a, b, delta=1e-12)

    def test_fields_are_written_in_parallel(self):
        self.run_program("bar_ss", ["Time/Final time=0.5"], n_ranks=2)
        files = sorted((self.folder / "run" / "solution").iterdir())
        self.assertEqual([f.name for f in files],
                         ["step-000000.vtu", "step-000010.vtu"])

    def test_an_error_is_printed_once(self):
        code, _, error = self.attempt("bar_sd", ["Mesh/Mesh size=0.3"],
                                      n_ranks=2)
        self.assertNotEqual(code, 0)
        self.assertEqual(error.count("does not divide"), 1)


if __name__ == "__main__":
    main()
