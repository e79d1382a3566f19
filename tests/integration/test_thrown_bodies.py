# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elastic ball and the hyperelastic ring: every treatment of papers A and B,
with and without friction and viscosity.

The checks are identities (papers A and B, proposition 3.1) and the conservation laws that follow,
not stored numbers.
"""

import itertools
import re

from common import *

FRICTION = {
    "elastic_ball": ["Start/Initial velocity=6, -10",
                     "Contact/Friction coefficient=0.3"],
    "hyperelastic_ring": ["Contact/Friction coefficient=0.3"],
}
VISCOSITY = {
    "elastic_ball": ["Material/Viscosity=linear", "Material/Viscosity eta=1e6"],
    "hyperelastic_ring": ["Material/Viscosity=Curnier",
                          "Material/Viscosity eta=400"],
}


# These bodies are so small that the linear solver would choose "direct".
CONDENSED = ["Linear solver/Type=condensed"]


class ThrownBodies(ProgramTest):

    def body(self, program):
        """Parameters of a small body."""
        if program == "elastic_ball":
            # The ball hits in the first step, and has parted again after 0.028 s.
            return BALL + NO_FIELDS + ["Time/Time step=2e-3", "Time/Final time=0.032"]
        # The ring has hit, and rebounds.
        return RING + NO_FIELDS + ["Time/Final time=0.24"]

    def check_balance(self, ledger):
        self.assertEqual(ledger["step_halvings"][-1], 0)
        # Relative to the initial energy.
        self.assertLess(largest(ledger["balance_residual"]), 5e-10)
        # There was contact: the test is not empty.
        self.assertGreater(max(ledger["contact_force_foundation"]), 0)

    def check_momenta(self, ledger, friction):
        velocity, mass = 10., 1000. * 57.
        momentum = ledger["momentum_x"]
        if friction:
            self.assertGreater(largest([p - momentum[0] for p in momentum]),
                               1e-6 * mass * velocity)
        else:
            self.assertLess(largest([p - momentum[0] for p in momentum]),
                            1e-9 * mass * velocity)
        # Off contact the angular momentum is kept too.
        force = ledger["contact_force_foundation"]
        turning = ledger["angular_momentum"]
        off = [n for n in range(1, len(force))
               if force[n] == 0. and force[n - 1] == 0.]
        self.assertGreater(len(off), 0)
        for n in off:
            self.assertLess(abs(turning[n] - turning[n - 1]),
                            1e-9 * mass * velocity * 10.)

    def check_energy(self, treatment, ledger, friction, viscosity):
        scale = ledger["energy"][0]
        kept = ("modified_energy" if treatment in KEEP_MODIFIED_ENERGY
                else "energy")
        energy = [e / scale for e in ledger[kept]]
        if treatment in LOSE_ENERGY:
            # Signorini and SNC lose at the impact. The energy stored by compliance belongs to it.
            energy = [e / scale for e in ledger["modified_energy"]]
            self.assertLess(max(increments(energy)), 5e-10)
            self.assertLess(energy[-1], 1. - 1e-4)
        elif friction or viscosity:
            self.assertLess(max(increments(energy)), 5e-10)
            self.assertLess(energy[-1], 1. - 1e-6)
        else:
            self.assertLess(largest([e - 1. for e in energy]), 1e-9)
        # Work against friction and viscosity is never negative.
        for name, on in (("friction_work", friction),
                         ("viscous_dissipation", viscosity)):
            self.assertGreater(min(increments(ledger[name])), -1e-13 * scale)
            self.assertEqual(ledger[name][-1] > 0, on, msg=name)

    def check_program(self, program, treatments):
        cases = []
        for treatment, friction, viscosity in itertools.product(
                treatments, (False, True), (False, True)):
            # All of them in the release build. With assertions each treatment once:
            # the ring with friction and viscosity, the ball without.
            on_ring = program == "hyperelastic_ring"
            if is_debug_build() and (friction, viscosity) != (on_ring, on_ring):
                continue
            cases.append(((treatment, friction, viscosity), program,
                          self.body(program) +
                          [f"Contact/Treatment={treatment}"] +
                          (FRICTION[program] if friction else []) +
                          (VISCOSITY[program] if viscosity else [])))
        for name, ledger in self.run_many(cases):
            treatment, friction, viscosity = name
            with self.subTest(name):
                self.check_balance(ledger)
                self.check_momenta(ledger, friction)
                self.check_energy(treatment, ledger, friction, viscosity)
                if program == "elastic_ball":
                    # The body has come back.
                    self.assertEqual(ledger["contact_force_foundation"][-1], 0.)
                if treatment.startswith("Signorini"):
                    self.assertLess(max(ledger["penetration_foundation"]),
                                    1e-9)

    def test_elastic_ball(self):
        self.check_program("elastic_ball",
                           KEEP_ENERGY + KEEP_MODIFIED_ENERGY + LOSE_ENERGY)

    def test_hyperelastic_ring(self):
        self.check_program("hyperelastic_ring",
                           KEEP_ENERGY + KEEP_MODIFIED_ENERGY + LOSE_ENERGY)

    def test_other_combinations(self):
        """Other exponents, laws, cells, masses; the methods of paper C."""
        inc, snc = "improved normal compliance", "standard normal compliance"
        cases = [
            ("elastic_ball", ["Contact/Treatment=Nitsche"]),
            ("elastic_ball", ["Contact/Treatment=Nitsche-hybrid"]),
            ("elastic_ball", ["Contact/Treatment=proximal augmented Lagrangian"]),
            ("elastic_ball", ["Contact/Treatment=Signorini active set",
                              "Time/Mass=redistributed"]),
            ("elastic_ball", [f"Contact/Treatment={inc}", "Mesh/Degree=2",
                              "Mesh/Nodes=96", "Mesh/Boundary nodes=32"]),
            ("elastic_ball", ["Contact/Treatment=persistent contact",
                              "Mesh/Cells=quadrilaterals",
                              "Material/Plane state=plane strain"]),
            ("elastic_ball", [f"Contact/Treatment={snc} at midpoint"]),
            ("hyperelastic_ring", [f"Contact/Treatment={inc}",
                                   "Contact/Compliance exponent=3",
                                   "Material/Plane state=plane strain"]),
            ("hyperelastic_ring", [f"Contact/Treatment={inc}",
                                   "Contact/Compliance exponent=4.5",
                                   "Material/Law=neo-Hookean",
                                   "Material/Young modulus=3e6"]),
            ("hyperelastic_ring", ["Contact/Treatment=persistent contact",
                                   "Material/Law=Saint Venant-Kirchhoff",
                                   "Material/Young modulus=3e6",
                                   "Mesh/Cells=quadrilaterals"]),
            ("hyperelastic_ring", ["Contact/Treatment=persistent contact",
                                   "Material/Viscosity=Pioletti",
                                   "Material/Viscosity eta=400"]),
            ("hyperelastic_ring", ["Contact/Treatment=Signorini active set",
                                   "Time/Mass=redistributed",
                                   "Mesh/Nodes across=8"]),
        ]
        # Collocation schemes take nonlinear bodies and compliance too.
        for scheme in ("CN", "HHT 0.05", "TR-BDF2"):
            cases += [("elastic_ball",
                       [f"Contact/Treatment={snc}"] + SCHEMES[scheme]),
                      ("hyperelastic_ring",
                       ["Contact/Treatment=Signorini active set"] +
                       SCHEMES[scheme])]
        runs = [((program, *parameters), program,
                 self.body(program) + parameters)
                for program, parameters in cases]
        for name, ledger in self.run_many(runs):
            with self.subTest(name):
                self.check_balance(ledger)

    def test_newton_converges_quadratically(self):
        """The last residuals of a step in contact: each is at most of the size
        of the square of the one before, up to one constant and round-off."""
        for solver in (["Linear solver/Type=direct"], CONDENSED):
            with self.subTest(solver[0]):
                self.check_quadratic_tails(solver)

    def check_quadratic_tails(self, solver):
        code, out, error = self.attempt(
            "hyperelastic_ring",
            RING + ["Output/Fields every=0", "Output/Newton table=true",
                    "Newton/Reuse tangent below=0", "Time/Final time=0.24"] + solver)
        self.assertEqual(code, 0, msg=error)
        tails = 0
        residuals = []
        for line in out.splitlines():
            match = re.match(r" *Newton +(\d+) +residual +(\S+) ", line)
            if match:
                if match.group(1) == "0":
                    residuals = []
                residuals.append(float(match.group(2)))
            elif residuals:
                tail = [r for r in residuals if r < 1e-3]
                for a, b in zip(tail, tail[1:]):
                    if a > 1e-6:
                        tails += 1
                        self.assertLess(b, max(1e3 * a * a, 1e-12))
                residuals = []
        self.assertGreater(tails, 10)

    def test_one_and_two_ranks(self):
        for program, parameters in (
                ("elastic_ball", ["Contact/Treatment=persistent contact"] +
                 FRICTION["elastic_ball"]),
                ("elastic_ball", ["Contact/Treatment=Signorini multipliers"]),
                ("elastic_ball", ["Contact/Treatment=Signorini multipliers"] +
                 CONDENSED),
                ("elastic_ball", FRICTION["elastic_ball"] + CONDENSED),
                ("hyperelastic_ring", FRICTION["hyperelastic_ring"] +
                 VISCOSITY["hyperelastic_ring"]),
                ("hyperelastic_ring", CONDENSED),
                ("hyperelastic_ring",
                 ["Contact/Treatment=Ayyad-Barboteu two-step"])):
            with self.subTest(f"{program} {parameters}"):
                ledgers = [self.run_program(program,
                                            self.body(program) + parameters,
                                            self.folder / f"{n}", n_ranks=n)
                           for n in (1, 2)]
                for name in ledgers[0].names:
                    if name in NOISE or name == "numerical_dissipation":
                        continue
                    # Signorini's condition has none but round-off.
                    if (name == "penetration_foundation" and
                            "Contact/Treatment=Signorini multipliers" in
                            parameters):
                        continue
                    # Some columns are sums that nearly vanish.
                    whole = {"angular_momentum": 1e6, "momentum_x": 1e6,
                             "contact_work": ledgers[0]["energy"][0]}
                    scale = (whole["contact_work"] if is_part_of_energy(name) else
                             whole.get(name) or largest(ledgers[0][name]) or 1.)
                    difference = largest([a - b for a, b in
                                          zip(ledgers[0][name],
                                              ledgers[1][name])])
                    self.assertLess(difference / scale, 1e-9, msg=name)

    def test_restart_in_the_middle_of_an_impact(self):
        for program, stop, end, parameters in (
                ("elastic_ball", .008, .012,
                 ["Contact/Treatment=persistent contact"]),
                ("elastic_ball", .008, .012, FRICTION["elastic_ball"]),
                ("elastic_ball", .008, .012,
                 FRICTION["elastic_ball"] + CONDENSED),
                ("hyperelastic_ring", .09, .13,
                 FRICTION["hyperelastic_ring"] +
                 ["Contact/Treatment=persistent contact"]),
                ("hyperelastic_ring", .09, .13, CONDENSED +
                 ["Contact/Treatment=persistent contact"]),
                ("hyperelastic_ring", .09, .13,
                 VISCOSITY["hyperelastic_ring"]),
                ("hyperelastic_ring", .08, .12,
                 ["Contact/Treatment=Ayyad-Barboteu two-step"])):
            with self.subTest(f"{program} {parameters}"):
                parameters = (self.body(program) + parameters +
                              ["Output/Checkpoint every=1000"])
                whole, parts = self.folder / "whole", self.folder / "parts"
                gap = ["Start/Initial gap=0.055"]
                self.run_program(program, parameters + gap +
                                 [f"Time/Final time={end}"], whole)
                self.run_program(program, parameters + gap +
                                 [f"Time/Final time={stop}"], parts)
                ledger = Ledger(parts)
                self.run_program(program, parameters + gap +
                                 [f"Time/Final time={end}"], parts,
                                 options=["--resume"])
                self.assertGreater(ledger["contact_force_foundation"][-1], 0)
                self.assertEqual((whole / "energy.csv").read_text(),
                                 (parts / "energy.csv").read_text())

    def test_inverted_element_stops_the_run(self):
        """Thrown so hard that no step is short enough."""
        code, _, error = self.attempt(
            "hyperelastic_ring",
            RING + ["Contact/Treatment=Signorini active set",
                    "Start/Initial velocity=0, -200",
                    "Time/Maximum halvings=1", "Start/Initial gap=9"])
        self.assertEqual(code, 2, msg=error)
        text = " ".join(error.split())
        for message in ("The step from t = ", "after 1 halvings",
                        "turned inside out: det F = ", "in the cell around (",
                        "All results up to then are in the output folder"):
            self.assertIn(message, text)
        folder = self.folder / "run"
        ledger = Ledger(folder)
        self.assertGreaterEqual(len(ledger["time"]), 2)
        for name in ("energy.h5", "checkpoint.bin", "solution.pvd"):
            self.assertTrue((folder / name).exists(), msg=name)


if __name__ == "__main__":
    main()
