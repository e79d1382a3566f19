# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every contact treatment with every scheme, both masses, both bars.

Each run ends without a halved step, and its discrete energy balance closes to
solver tolerance at every step: an identity, independent of what the result
looks like. The three treatments of Signorini's condition pose the same problem
in one dimension and must agree with each other.
"""

import itertools

from common import *

# Numbers of the column solver, see SolverReport.
CONDENSED, CONDENSED_FAILED = 4, 64


class Combinations(ProgramTest):

    def masses(self, scheme):
        """Both; with assertions the one or the other by turns: all of them are run in
        the release build."""
        both = ("consistent", "redistributed")
        if not is_debug_build():
            return both
        return (both[list(SCHEMES).index(scheme) % 2],)

    def cases(self, program):
        final_time = ["Time/Final time=3"] if is_debug_build() else []
        combinations = list(itertools.product(TREATMENTS, SCHEMES)) + [
            ("Nitsche-hybrid", "midpoint")]
        for treatment, scheme in combinations:
            for mass in self.masses(scheme):
                yield ((treatment, scheme, mass), program,
                       NO_FIELDS + final_time + SCHEMES[scheme] +
                       [f"Contact/Treatment={treatment}", f"Time/Mass={mass}"])

    def check(self, program):
        ledgers = dict(self.run_many(self.cases(program)))
        self.assertEqual(len(ledgers), (1 if is_debug_build() else 2) *
                         (len(TREATMENTS) * len(SCHEMES) + 1))
        for name, ledger in ledgers.items():
            with self.subTest(name):
                self.assertEqual(ledger["step_halvings"][-1], 0)
                # Relative to the initial energy.
                self.assertLess(max(map(abs, ledger["balance_residual"])),
                                2e-12)

        for scheme in SCHEMES:
            for mass in self.masses(scheme):
                reference = ledgers["Signorini active set", scheme, mass]
                for other in ("Signorini multipliers",
                              "proximal augmented Lagrangian"):
                    with self.subTest(f"{other}, {scheme}, {mass}"):
                        ledger = ledgers[other, scheme, mass]
                        difference = max(
                            abs(a - b) for a, b in
                            zip(reference["displacement_left"],
                                ledger["displacement_left"]))
                        # Newton's tolerance, magnified by many impacts.
                        self.assertLess(difference, 1e-6)
        return ledgers

    def test_bar_sd(self):
        self.check("bar_sd")

    def test_bar_ss(self):
        if is_debug_build():
            self.skipTest("the same code as of the other bar")
        ledgers = self.check("bar_ss")
        # Each of them condensed to contact, which bars of this size are not by themselves.
        condensed = [(name, program, parameters + ["Linear solver/Type=condensed",
                                                   "Time/Final time=3"])
                     for name, program, parameters in self.cases("bar_ss")]
        for name, ledger in self.run_many(condensed):
            with self.subTest(f"condensed: {name}"):
                # In all steps, none of which has fallen back to the whole tangent.
                strategies = {int(value) for value in ledger["solver"][1:]}
                self.assertEqual({value & CONDENSED for value in strategies}, {CONDENSED})
                self.assertEqual({value & CONDENSED_FAILED for value in strategies}, {0})
                reference = ledgers[name]
                for column in ("displacement_left", "energy"):
                    self.assertLess(max(abs(a - b) for a, b in zip(reference[column],
                                                                   ledger[column])), 1e-6)

    def test_variants_of_nitsche(self):
        """theta = -1 and 0 have no modified energy, but their balance closes."""
        cases = [((theta, scheme), "bar_sd",
                  NO_FIELDS + SCHEMES[scheme] + [f"Contact/Nitsche theta={theta}",
                                                 "Time/Final time=3"])
                 for theta in (-1, 0) for scheme in SCHEMES]
        if is_debug_build():
            cases = cases[::3]
        for name, ledger in self.run_many(cases):
            with self.subTest(name):
                self.assertLess(max(map(abs, ledger["balance_residual"])),
                                2e-12)
                # The obstacle is respected to the order of the mesh size.
                self.assertGreater(min(ledger["displacement_left"]), -.05)


if __name__ == "__main__":
    main()
