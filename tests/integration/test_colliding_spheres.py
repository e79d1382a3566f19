# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two spheres that collide in 3D: energy, all six momenta, friction, ranks, restart, and refused
input."""

from common import *

COARSE = ["Spheres/Mesh size of the left sphere=0.6",
          "Spheres/Mesh size of the right sphere=0.8",
          "Time/Final time=0.16", "Time/Time step=5e-3", "Spheres/Speed=2"]
OBLIQUE = ["Spheres/Offset=0.5", "Spheres/Spin of the left sphere=0, 0.5, 2",
           "Spheres/Spin of the right sphere=1, 0, 0"]
FRICTION = ["Contact/Friction coefficient=0.3"]
MOMENTA = ("momentum_x", "momentum_y", "momentum_z", "angular_momentum_x",
           "angular_momentum_y", "angular_momentum_z")
KEPT = KEEP_ENERGY + ["Signorini active set"] + KEEP_MODIFIED_ENERGY
COMPLIANT = KEEP_MODIFIED_ENERGY + ["standard normal compliance"]
PENALTIES = ["standard normal compliance", "penalty"]


class CollidingSpheres(ProgramTest):

    def check(self, treatment, ledger, linear=False, holds_nodes=True):
        scale = ledger["energy"][0]
        self.assertGreater(max(ledger["contact_force_spheres"]), 1e3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-10)
        self.assertGreaterEqual(min(increments(ledger["friction_work"])),
                                -1e-12 * scale)
        # No external loads. Relative to the momentum of one sphere.
        momentum = abs(ledger["momentum_x_left"][0])
        for name in MOMENTA:
            drift = largest([p - ledger[name][0] for p in ledger[name]])
            # Lever arms of linear bodies are those of the reference, but contact is in the current
            # position.
            if not (linear and "angular" in name):
                self.assertLess(drift / momentum, 1e-10, msg=name)
            # Sum over both.
            for whole, a, b in zip(ledger[name], ledger[f"{name}_left"],
                                   ledger[f"{name}_right"]):
                self.assertLess(abs(whole - a - b), 1e-11 * momentum, msg=name)
        total = [e + w for e, w in zip(ledger["energy"], ledger["friction_work"])]
        if treatment in KEEP_ENERGY:
            self.assertLess(largest([e - scale for e in total]), 1e-9 * scale)
        if treatment in KEEP_MODIFIED_ENERGY:
            kept = [e + w for e, w in
                    zip(ledger["modified_energy"], ledger["friction_work"])]
            self.assertLess(largest([e - scale for e in kept]), 1e-9 * scale)
        # No facet is found through a body or round a corner of it.
        self.assertLess(max(ledger["penetration_spheres"]), .1)
        if treatment == "Signorini active set":
            self.assertLess(max(increments(total)), 1e-11 * scale)
            if holds_nodes:
                self.assertLess(max(ledger["penetration_spheres"]), 1e-9)

    def test_every_treatment(self):
        cases = [(treatment, "colliding_spheres",
                  COARSE + OBLIQUE + NO_FIELDS + friction +
                  [f"Contact/Treatment={treatment}"] +
                  (["Contact/Compliance coefficient=1e7"]
                   if treatment in COMPLIANT else []))
                 for treatment in KEPT + PENALTIES
                 for friction in ([], FRICTION)
                 if not (treatment == "penalty" and friction)]
        if is_debug_build():
            cases = cases[1:2]
        for name, ledger in self.run_many(cases):
            with self.subTest(name):
                self.check(name, ledger)

    def test_hexahedra_and_linear_bodies(self):
        for parameters in (["Spheres/Cells=hexahedra"] + OBLIQUE + FRICTION,
                           ["Material/Law=linear elastic"],
                           ["Spheres/Slave=right"] + OBLIQUE):
            with self.subTest(" ".join(parameters)):
                if is_debug_build():
                    parameters = parameters + ["Time/Final time=0.06"]
                ledger = self.run_program("colliding_spheres",
                                          COARSE + NO_FIELDS + parameters)
                self.check("persistent contact", ledger, "linear" in parameters[0])
            if is_debug_build():
                break

    def test_mortar(self):
        """Energy and momenta as with points; on one and two ranks, with a factorisation
        and multigrid the same; continued to the digit."""
        for treatment, coupling in (("persistent contact", "mortar"),
                                    ("Ayyad-Barboteu two-step", "dual mortar"),
                                    ("Signorini active set", "dual mortar")):
            parameters = (COARSE + OBLIQUE + FRICTION + NO_FIELDS +
                          [f"Contact/Treatment={treatment}",
                           f"Contact/Coupling={coupling}",
                           "Output/Checkpoint every=1000"])
            if is_debug_build():
                parameters.append("Time/Final time=0.06")
            with self.subTest(treatment):
                folder = self.folder / coupling / treatment
                ledger = self.run_program("colliding_spheres", parameters, folder)
                # Contact acts on the mean gap around a node, over other pieces in the next step.
                self.check(treatment, ledger, holds_nodes=False)
            if is_debug_build():
                return
        for more in ([], ["Linear solver/Type=multigrid"]):
            other = self.run_program("colliding_spheres", parameters + more, n_ranks=2)
            for name in ("energy", "friction_work", "momentum_y_right"):
                self.assertLess(
                    largest([a - b for a, b in zip(ledger[name], other[name])]),
                    1e-9 * largest(ledger[name]), msg=name)
        self.run_program("colliding_spheres", parameters + ["Time/Final time=0.06"],
                         self.folder / "parts")
        self.run_program("colliding_spheres", parameters, self.folder / "parts",
                         options=["--resume"])
        self.assertEqual((folder / "energy.csv").read_text(),
                         (self.folder / "parts" / "energy.csv").read_text())

    def test_multigrid(self):
        """The same as with a factorisation, with constraints and with a law, on one
        rank and on two."""
        treatments = ("persistent contact", "improved normal compliance")
        for treatment in treatments[:1] if is_debug_build() else treatments:
            parameters = (COARSE + OBLIQUE + NO_FIELDS +
                          [f"Contact/Treatment={treatment}",
                           "Time/Final time=0.06"] +
                          (FRICTION if treatment == "persistent contact" else
                           ["Contact/Compliance coefficient=1e7"]))
            factored = self.run_program("colliding_spheres", parameters)
            self.assertGreater(max(factored["contact_force_spheres"]), 1e3)
            for n_ranks in (1, 2):
                with self.subTest(f"{treatment}, {n_ranks} ranks"):
                    ledger = self.run_program(
                        "colliding_spheres",
                        parameters + ["Linear solver/Type=multigrid"],
                        n_ranks=n_ranks)
                    scale = ledger["energy"][0]
                    self.assertLess(largest(ledger["balance_residual"]), 1e-11)
                    for name in ("energy", "kinetic_energy_right", "friction_work"):
                        self.assertLess(
                            largest([a - b for a, b in
                                     zip(factored[name], ledger[name])]),
                            1e-9 * scale, msg=name)

    def test_spin_of_what_slides(self):
        """Head-on, the left sphere spins about z: friction transfers spin from it to the other one,
        and both are pushed apart along y."""
        ledger = self.run_program(
            "colliding_spheres",
            COARSE + NO_FIELDS + FRICTION + ["Spheres/Spin of the left sphere=0, 0, 2"])
        self.check("persistent contact", ledger)
        # The surface of the left sphere goes towards y where it touches, so that the
        # right one is dragged there, and begins to turn about z in the sense of the traction on it:
        # r x t points against z.
        self.assertGreater(ledger["momentum_y_right"][-1], 0.)
        self.assertLess(ledger["momentum_y_left"][-1], 0.)
        momentum = abs(ledger["momentum_x_left"][0])
        self.assertGreater(ledger["momentum_y_right"][-1], .01 * momentum)
        # By symmetry hardly anything goes along z; the meshes have none.
        self.assertLess(abs(ledger["momentum_z_right"][-1]),
                        .1 * ledger["momentum_y_right"][-1])
        # Coulomb: the impulse along the surface is at most 0.3 times that across it.
        self.assertLess(ledger["momentum_y_right"][-1],
                        .3 * (ledger["momentum_x_right"][-1] -
                              ledger["momentum_x_right"][0]) * (1. + 1e-3))

    def test_one_and_two_ranks_and_restart(self):
        parameters = COARSE + OBLIQUE + FRICTION + NO_FIELDS + [
            "Output/Checkpoint every=1000"]
        if is_debug_build():
            parameters.append("Time/Final time=0.06")
        whole = self.run_program("colliding_spheres", parameters, self.folder / "1")
        two = self.run_program("colliding_spheres", parameters, self.folder / "2",
                               n_ranks=2)
        self.assertGreater(max(whole["contact_force_spheres"]), 1e3)
        for name in ("energy", "friction_work", "momentum_y_right",
                     "angular_momentum_x_right", "contact_force_spheres"):
            scale = largest(whole[name])
            self.assertLess(largest([a - b for a, b in zip(whole[name], two[name])]),
                            1e-9 * scale, msg=name)
        self.run_program("colliding_spheres", parameters + ["Time/Final time=0.04"],
                         self.folder / "parts")
        self.run_program("colliding_spheres", parameters, self.folder / "parts",
                         options=["--resume"])
        self.assertEqual((self.folder / "1" / "energy.csv").read_text(),
                         (self.folder / "parts" / "energy.csv").read_text())

    def test_what_is_refused(self):
        if is_debug_build():
            self.skipTest("is refused before anything is computed")
        for parameters, words in (
                (["Spheres/Distance=1.9"], "must be two radii at least"),
                (["Spheres/Offset=3"], "must be smaller than Spheres/Distance"),
                (["Material/Law=linear elastic",
                  "Spheres/Spin of the left sphere=0, 0, 1"],
                 "Linear elastic bodies cannot turn"),
                (["Contact/Treatment=Nitsche"], "Nitsche"),
                (["Contact/Coupling=cut faces"], "points, mortar, dual mortar"),
                (["Contact/Coupling=mortar",
                  "Contact/Treatment=improved normal compliance"],
                 "Signorini active set"),
                (["Contact/Coupling=dual mortar", "Contact/Treatment=penalty"],
                 "quadrature points"),
                (["Time/Scheme=TR-BDF2"], "TR-BDF2"),
                (["Spheres/Mesh size where they touch=2"], "larger than"),
                (["Spheres/Mesh size where they touch=0.1",
                  "Spheres/Cells=hexahedra"], "is for Spheres/Cells = tetrahedra")):
            with self.subTest(" ".join(parameters)):
                code, out, err = self.attempt("colliding_spheres",
                                              COARSE + parameters)
                self.assertEqual(code, 1, msg=out + err)
                self.assertIn(words, " ".join(err.split()))


if __name__ == "__main__":
    main()
