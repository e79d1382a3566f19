# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that is stopped and resumed gives the same ledger, digit for digit."""

from common import *


class Restart(ProgramTest):

    def stop_and_resume(self, program, parameters, stops, n_ranks=1):
        """Compare a whole run with one that is stopped at each of @p stops."""
        parameters = list(parameters) + ["Output/Fields every=5",
                                         "Output/Checkpoint every=1000"]
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.run_program(program, parameters + ["Time/Final time=3"], whole,
                         n_ranks=n_ranks)
        options = []
        for time in stops + [3]:
            self.run_program(program, parameters + [f"Time/Final time={time}"],
                             parts, options=options, n_ranks=n_ranks)
            options = ["--resume"]
        self.assertEqual((whole / "energy.csv").read_text(),
                         (parts / "energy.csv").read_text())
        self.assertEqual(self.pvd_entries(whole), self.pvd_entries(parts))

    def pvd_entries(self, folder):
        """All but the comment, which holds the time of day."""
        return [line for line in (folder / "solution.pvd").read_text().split("\n")
                if "DataSet" in line]

    def test_in_flight_at_impact_and_in_contact(self):
        stops = [.05, 1., 1.05, 1.5, 2.1]
        cases = (
                ("bar_sd", "Nitsche", "CN", "consistent"),
                ("bar_sd", "Nitsche", "TR-BDF2", "redistributed"),
                ("bar_sd", "Signorini active set", "HHT 0.05", "consistent"),
                ("bar_ss", "proximal augmented Lagrangian", "TR-BDF2",
                 "consistent"),
                ("bar_ss", "Nitsche-hybrid", "midpoint", "redistributed"))
        if is_debug_build():
            cases, stops = cases[1::2], stops[1:4:2]
        for program, treatment, scheme, mass in cases:
            with self.subTest(f"{program} {treatment} {scheme} {mass}"):
                self.stop_and_resume(program, SCHEMES[scheme] +
                                     [f"Contact/Treatment={treatment}",
                                      f"Time/Mass={mass}"], stops)
                shutil.rmtree(self.folder / "parts")

    def test_on_two_ranks(self):
        self.stop_and_resume("bar_ss", ["Time/Scheme=TR-BDF2"], [1., 1.5], 2)

    def test_on_another_number_of_ranks(self):
        # Multipliers and displacements, to the tolerance of the solvers.
        parameters = NO_FIELDS + ["Output/Checkpoint every=20",
                                  "Contact/Treatment=proximal augmented "
                                  "Lagrangian"]
        whole = self.run_program("bar_ss", parameters + ["Time/Final time=3"])
        for first, second in ((2, 3),) if is_debug_build() else ((1, 2), (2, 1), (2, 3)):
            with self.subTest(f"{first} and {second} ranks"):
                parts = self.folder / f"{first}{second}"
                self.run_program("bar_ss", parameters + ["Time/Final time=1.5"],
                                 parts, n_ranks=first)
                ledger = self.run_program("bar_ss",
                                          parameters + ["Time/Final time=3"],
                                          parts, n_ranks=second,
                                          options=["--resume"])
                for name in ("energy", "contact_force_left",
                             "contact_force_right"):
                    if name not in whole.names:
                        continue
                    scale = max(map(abs, whole[name]))
                    self.assertEqual(len(whole[name]), len(ledger[name]))
                    for a, b in zip(whole[name], ledger[name]):
                        self.assertLess(abs(a - b), 1e-10 * scale)

    def test_with_an_integrator_of_its_own(self):
        self.stop_and_resume("bar_sd", ["Time/Scheme=ARKODE"], [.5, 1.25])

    def test_a_run_that_was_killed_forgets_what_came_after_its_checkpoint(self):
        parameters = NO_FIELDS + ["Output/Checkpoint every=30"]
        whole = self.folder / "whole"
        self.run_program("bar_sd", parameters + ["Time/Final time=3"], whole)
        parts = self.folder / "parts"
        # 30 steps to the checkpoint; then forge later rows, the last cut short,
        # as a process leaves them that dies while it writes.
        self.run_program("bar_sd", parameters + ["Time/Final time=1.5"], parts)
        with open(parts / "energy.csv", "a") as file:
            file.write("1.55,0.1,0.2\n1.6,0.")
        self.run_program("bar_sd", parameters + ["Time/Final time=3"], parts,
                         options=["--resume"])
        self.assertEqual((whole / "energy.csv").read_text(),
                         (parts / "energy.csv").read_text())


class BadCheckpoint(ProgramTest):

    def setUp(self):
        super().setUp()
        self.parameters = NO_FIELDS + ["Output/Checkpoint every=5",
                                       "Time/Final time=0.5"]
        self.run_program("bar_sd", self.parameters)
        self.checkpoint = self.folder / "run" / "checkpoint.bin"

    def refuse(self, message, parameters=(), n_ranks=1):
        before = (self.folder / "run" / "energy.csv").read_bytes()
        code, _, error = self.attempt("bar_sd",
                                      self.parameters + list(parameters),
                                      options=["--resume"], n_ranks=n_ranks)
        self.assertEqual(code, 1, msg=error)
        self.assertIn(message, " ".join(error.split()))
        self.assertEqual(error.count("cannot be resumed"), 1)
        # Nothing of the earlier run is touched.
        self.assertEqual((self.folder / "run" / "energy.csv").read_bytes(),
                         before)

    def test_truncated(self):
        data = self.checkpoint.read_bytes()
        self.checkpoint.write_bytes(data[:len(data) // 2])
        self.refuse("is truncated: it holds")

    def test_empty(self):
        self.checkpoint.write_bytes(b"")
        self.refuse("is no checkpoint of this version")

    def test_damaged(self):
        data = bytearray(self.checkpoint.read_bytes())
        data[-9] ^= 1
        self.checkpoint.write_bytes(bytes(data))
        self.refuse("is damaged: its checksum is wrong")

    def test_missing(self):
        self.checkpoint.unlink()
        self.refuse("does not exist")

    def test_other_parameters(self):
        self.refuse("belongs to a run with other parameters",
                    ["Time/Time step=0.025"])

    def test_earlier_final_time(self):
        self.refuse("its checkpoint is at t = 0.5 s, after the final time 0.25",
                    ["Time/Final time=0.25"])


if __name__ == "__main__":
    main()
