# SPDX-License-Identifier: LGPL-2.1-or-later
"""Newton's method on contact alone: the same results as with the whole body, for two
solutions with the body's factorisation in each stage of a step."""

import math
import re

from common import *

WHOLE = ["Linear solver/Condense to contact=false"]
CORRECTED = NO_FIELDS + ["Linear solver/Type=corrected", "Output/Timing=true"]
COARSE = CORRECTED + ["Mesh/Mesh size=14", "Time/Final time=12"]
NODES = ["Mesh/Degree=1", "Mesh/Mesh size=9"]
OBLIQUE = ["Contact/Friction coefficient=0.3",
           "Start/Initial velocity=1, 0.4, 0"]

# Balance and dissipation are round-off by themselves; counts can differ by one where
# a residual sits at the tolerance.
NOT_COMPARED = ("balance_residual", "numerical_dissipation", "newton_iterations",
                "linear_solves")


def case(program, treatment, scheme, *others):
    parameters = SCHEMES[scheme] + [f"Contact/Treatment={treatment}", *others]
    if program == "sphere":
        return program, COARSE + parameters
    return program, CORRECTED + ["Time/Final time=3"] + parameters


CASES = [
    case("sphere", "Nitsche", "CN"),
    case("sphere", "Nitsche", "CN", "Contact/Nitsche theta=-1"),
    case("sphere", "Nitsche", "TR-BDF2", "Contact/Nitsche theta=0"),
    case("sphere", "Nitsche-hybrid", "midpoint"),
    case("sphere", "penalty", "HHT 0.05"),
    case("sphere", "proximal augmented Lagrangian", "TR-BDF2"),
    case("sphere", "improved normal compliance", "midpoint", *NODES, *OBLIQUE),
    case("sphere", "Hauret-Le Tallec", "midpoint", *NODES, *OBLIQUE),
    case("sphere", "Signorini multipliers", "CN", *NODES),
    case("bar_sd", "Nitsche", "TR-BDF2", "Time/Mass=redistributed"),
    case("bar_ss", "Nitsche", "HHT 0.05", "Time/Mass=redistributed"),
    case("bar_ss", "proximal augmented Lagrangian", "CN"),
    case("bar_ss", "standard normal compliance", "CN"),
    # The bar is clamped at one end: its matrix is not quite symmetric.
    case("bar_sd", "Signorini multipliers", "TR-BDF2"),
    case("bar_sd", "penalty", "midpoint"),
]


class Condensed(ProgramTest):

    def compare(self, one, other, tolerance):
        self.assertEqual(one.names, other.names)
        for name in one.names:
            if name in NOT_COMPARED:
                continue
            values = [(a, b) for a, b in zip(one[name], other[name])
                      if not (math.isnan(a) and math.isnan(b))]
            # What is open has no penetration but round-off.
            scale = max([abs(a) for a, _ in values] + [1e-4])
            self.assertLess(max([abs(a - b) for a, b in values] + [0.]) / scale,
                            tolerance, msg=name)

    def substitutions(self, folder):
        return int(re.search(r"back-substitutions \S+ s \((\d+)\)",
                             (folder / "log.txt").read_text()).group(1))

    def test_same_results_with_two_solutions_a_stage(self):
        cases = CASES[1:10:4] if is_debug_build() else CASES
        runs = []
        for number, (program, parameters) in enumerate(cases):
            for way, more in (("condensed", []), ("whole", WHOLE)):
                runs.append((f"{number}-{way}", program, parameters + more))
        ledgers = dict(self.run_many(runs))
        for number, (program, parameters) in enumerate(cases):
            with self.subTest(f"{program} " + " ".join(parameters)):
                one, other = (ledgers[f"{number}-{way}"]
                              for way in ("condensed", "whole"))
                self.compare(one, other, 1e-9)
                if program != "sphere":
                    # One or two points that a stiff law presses deep at the guess:
                    # round-off there costs an iteration with the whole body.
                    continue
                # One more for the initial acceleration, and few for stages whose
                # residual in the end was not small enough.
                stages = len(one["time"]) - 1
                if "TR-BDF2" in " ".join(parameters):
                    stages *= 2
                spent, spent_before = (
                    self.substitutions(self.folder / f"case-{2 * number + k}")
                    for k in (0, 1))
                self.assertLessEqual(spent, 2 * stages + 1 + stages // 20)
                self.assertLess(spent, spent_before)

    def test_one_and_two_ranks(self):
        for program, parameters in (CASES[0], CASES[6]):
            with self.subTest(" ".join(parameters)):
                self.compare(*(self.run_program(program, parameters,
                                                self.folder / f"{n}", n_ranks=n)
                               for n in (1, 2)), 1e-9)
            if is_debug_build():
                break

    def test_resumed_digit_for_digit(self):
        for number in (2, 6):
            program, parameters = CASES[number]
            parameters = parameters + ["Output/Checkpoint every=100"]
            whole = self.folder / f"whole-{number}"
            parts = self.folder / f"parts-{number}"
            self.run_program(program, parameters, whole)
            self.run_program(program, parameters + ["Time/Final time=8"], parts)
            self.run_program(program, parameters, parts, options=["--resume"])
            self.assertEqual((whole / "energy.csv").read_text(),
                             (parts / "energy.csv").read_text())
            if is_debug_build():
                break

    def test_bodies_with_large_strains(self):
        """One tangent a step: the same results, and the same digits when resumed."""
        ring = NO_FIELDS + ["Linear solver/Type=corrected", "Output/Timing=true",
                            "Mesh/Nodes around=64", "Mesh/Nodes across=4",
                            "Start/Initial gap=0.15", "Contact/Compliance exponent=3",
                            "Contact/Friction coefficient=0.2",
                            "Output/Checkpoint every=1000"]
        end = ["Time/Final time=0.2"]
        one = self.run_program("hyperelastic_ring", ring + end, self.folder / "one")
        whole = self.run_program("hyperelastic_ring", ring + end + WHOLE,
                                 self.folder / "whole")
        self.compare(one, whole, 1e-9)
        log = (self.folder / "one" / "log.txt").read_text()
        self.assertLessEqual(int(re.search(r"(\d+) factorisations", log).group(1)),
                             len(one["time"]))
        parts = self.folder / "parts"
        self.run_program("hyperelastic_ring", ring + ["Time/Final time=0.1"], parts)
        self.run_program("hyperelastic_ring", ring + end, parts, options=["--resume"])
        self.assertEqual((self.folder / "one" / "energy.csv").read_text(),
                         (parts / "energy.csv").read_text())


if __name__ == "__main__":
    main()
