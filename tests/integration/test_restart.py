# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that is stopped and resumed gives the same ledger, digit for digit, and on
another number of ranks to the solvers' tolerance."""

import math
import re

from common import *


class Restart(ProgramTest):

    def stop_and_resume(self, program, parameters, stops, n_ranks=1, end=3):
        """Compare a whole run to @p end with one that is stopped at each of
        @p stops."""
        parameters = list(parameters) + ["Output/Fields every=5",
                                         "Output/Checkpoint every=1000"]
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.run_program(program, parameters + [f"Time/Final time={end}"], whole,
                         n_ranks=n_ranks)
        options = []
        for time in stops + [end]:
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
                ("bar_ss", "penalty", "BDF2", "redistributed"),
                ("bar_ss", "Nitsche-hybrid", "midpoint", "redistributed"))
        if is_debug_build():
            cases, stops = cases[1::2], stops[1:4:2]
        for program, treatment, scheme, mass in cases:
            with self.subTest(f"{program} {treatment} {scheme} {mass}"):
                self.stop_and_resume(program, SCHEMES[scheme] +
                                     [f"Contact/Treatment={treatment}",
                                      f"Time/Mass={mass}"], stops)
                shutil.rmtree(self.folder / "parts")

    def test_forces_of_velocities(self):
        """Friction and viscosity of instants are part of the state."""
        self.stop_and_resume("elastic_ball",
                             BALL + ["Start/Initial velocity=6, -10", "Time/Scheme=HHT",
                                     "Contact/Treatment=Signorini active set",
                                     "Contact/Friction coefficient=0.3",
                                     "Material/Viscosity=linear",
                                     "Material/Viscosity eta=1e6"], [.004, .012])

    def test_on_two_ranks(self):
        self.stop_and_resume("bar_ss", ["Time/Scheme=TR-BDF2"], [1., 1.5], 2)

    def restart_on_other_ranks(self, program, parameters, stop, end, ranks):
        """Compare a whole run on one rank with runs that are stopped on some number of
        ranks and resumed on another, for each pair in @p ranks: to the solvers'
        tolerance."""
        parameters = NO_FIELDS + parameters + ["Output/Checkpoint every=1000"]
        whole = self.run_program(program, parameters + [f"Time/Final time={end}"],
                                 self.folder / "whole")
        for first, second in ranks[-1:] if is_debug_build() else ranks:
            with self.subTest(f"{program} on {first} and {second} ranks"):
                parts = self.folder / f"{program}-{first}{second}"
                stopped = self.run_program(program,
                                           parameters + [f"Time/Final time={stop}"],
                                           parts, n_ranks=first)
                resumed = self.run_program(program,
                                           parameters + [f"Time/Final time={end}"],
                                           parts, n_ranks=second,
                                           options=["--resume"])
                self.assertEqual(whole.names, resumed.names)
                self.assertEqual(whole["time"], resumed["time"])
                self.assertLess(len(stopped["time"]), len(whole["time"]))
                self.check_same(whole, resumed)
        return whole, stopped

    def check_same(self, one, other):
        """Scale of the columns: energies against the largest energy, momenta against the largest
        momentum of their kind, the rest by itself."""
        kinds = (".*energy.*|.*work.*|.*dissipation.*", "momentum.*",
                 "angular_momentum.*", "contact_force.*", "contact_pressure.*",
                 "penetration.*|mean_gap.*|smallest_gap.*", "displacement.*")
        n_compared = 0
        for kind in kinds:
            names = [name for name in one.names if re.fullmatch(kind, name)]
            values = [[x for x in one[name] if not math.isnan(x)] for name in names]
            scale = max([largest(column) for column in values if column] or [0.])
            for name in names:
                for a, b in zip(one[name], other[name]):
                    self.assertEqual(math.isnan(a), math.isnan(b), msg=name)
                    if not math.isnan(a):
                        self.assertLessEqual(abs(a - b), 1e-9 * scale, msg=name)
            n_compared += len(names)
        self.assertGreater(n_compared, 10)

    def test_on_another_number_of_ranks(self):
        """Unknowns are numbered by the partition: the stored order must not be."""
        self.restart_on_other_ranks(
            "bar_ss", ["Contact/Treatment=proximal augmented Lagrangian"], 1.5, 3,
            ((1, 2), (2, 1), (2, 3)))

    def test_multipliers_and_friction_on_another_number_of_ranks(self):
        _, stopped = self.restart_on_other_ranks(
            "elastic_ball",
            BALL + ["Start/Initial velocity=6, -10",
                    "Contact/Friction coefficient=0.3",
                    "Contact/Treatment=Signorini multipliers"], .01, .015,
            ((1, 2), (2, 3)))
        # The run is stopped while the body slips.
        self.assertGreater(stopped["contact_force_foundation"][-1], 0.)
        self.assertGreater(increments(stopped["friction_work"])[-1], 0.)

    def test_viscosity_on_another_number_of_ranks(self):
        _, stopped = self.restart_on_other_ranks(
            "hyperelastic_ring",
            RING + ["Start/Initial gap=0.055", "Contact/Friction coefficient=0.3",
                    "Material/Viscosity=Curnier", "Material/Viscosity eta=400"],
            .09, .13, ((1, 2), (2, 1)))
        self.assertGreater(stopped["contact_force_foundation"][-1], 0.)
        self.assertGreater(increments(stopped["viscous_dissipation"])[-1], 0.)

    def test_bodies_in_space_on_another_number_of_ranks(self):
        _, stopped = self.restart_on_other_ranks(
            "colliding_spheres",
            ["Spheres/Mesh size of the left sphere=0.6",
             "Spheres/Mesh size of the right sphere=0.8", "Spheres/Speed=2",
             "Spheres/Offset=0.5", "Spheres/Spin of the left sphere=0, 0.5, 2",
             "Contact/Friction coefficient=0.3", "Time/Time step=5e-3",
             "Material/Viscosity=Pioletti", "Material/Viscosity eta=1e3"],
            .06, .08, ((1, 2), (2, 1), (2, 3)))
        self.assertGreater(stopped["contact_force_spheres"][-1], 0.)
        self.assertGreater(stopped["friction_work"][-1], 0.)
        self.assertGreater(stopped["viscous_dissipation"][-1], 0.)

    def test_with_an_integrator_of_its_own(self):
        # In flight and in contact, which begins at t = 1.
        self.stop_and_resume("bar_sd", ["Time/Scheme=ARKODE"], [.5, 1.25], end=1.5)

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
    """Each test damages a copy of the same run."""

    def setUp(self):
        super().setUp()
        if is_debug_build():
            self.skipTest("is refused before anything is computed")
        self.parameters = NO_FIELDS + ["Output/Checkpoint every=5",
                                       "Time/Final time=0.5"]
        self.copy_of_shared_run("bar_sd", self.parameters)
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

    def test_earlier_format(self):
        data = self.checkpoint.read_bytes()
        head, _, rest = data.partition(b"\n")
        self.assertRegex(head, rb"format \d+$")
        self.checkpoint.write_bytes(
            re.sub(rb"\d+$", lambda number: b"%d" % (int(number[0]) - 1), head) +
            b"\n" + rest)
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
