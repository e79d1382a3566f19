# SPDX-License-Identifier: LGPL-2.1-or-later
"""SUNDIALS' adaptive integrator and Crank-Nicolson with tiny steps agree.

The semi-discrete Nitsche and penalty systems are Lipschitz differential
equations (paper C, (11), (15); it says so of the first) with one solution on one
mesh. ARKODE is independent of our time schemes.
"""

from common import *


class Arkode(ProgramTest):

    def difference(self, treatment, refinement, reference):
        step = .05 / refinement
        ledger = self.run_program(
            "bar_sd", NO_FIELDS + [f"Contact/Treatment={treatment}",
                                   "Time/Final time=3",
                                   f"Time/Time step={step:.17g}"])
        return max(abs(a - b) for name in ("displacement_left", "mean_gap_left")
                   for a, b in zip(ledger[name][::refinement], reference[name]))

    def check(self, treatment):
        reference = self.run_program(
            "bar_sd", NO_FIELDS + [f"Contact/Treatment={treatment}",
                                   "Time/Final time=3", "Time/Scheme=ARKODE",
                                   "Time/ARKODE relative tolerance=1e-11",
                                   "Time/ARKODE absolute tolerance=1e-13"])
        self.assertEqual(len(reference["time"]), 61)
        # The residual of its balance is the integration error.
        self.assertLess(max(map(abs, reference["balance_residual"])), 1e-9)
        energy = reference["modified_energy"]
        self.assertLess(max(energy) - min(energy), 1e-8)

        coarse, middle, fine = (self.difference(treatment, n, reference)
                                for n in (8, 32, 128))
        # Second order: 4^2 from one to the next; kinks of the force cost some.
        self.assertLess(middle, coarse / 8.)
        self.assertLess(fine, middle / 8.)
        self.assertLess(fine, 1e-4)
        print(f"{treatment}: differences {coarse:.2e} {middle:.2e} {fine:.2e}")

    def test_nitsche(self):
        self.check("Nitsche")

    def test_penalty(self):
        self.check("penalty")


if __name__ == "__main__":
    main()
