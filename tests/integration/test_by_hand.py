# SPDX-License-Identifier: LGPL-2.1-or-later
"""The programs that are written out by hand against those that take the library.

bar_by_hand has everything in one file, disk_step_by_step all but mesh, material and
table: both programs have only the equations in common. A difference is an error in
one of them.
"""

from common import *


class ByHand(ProgramTest):

    def run_both(self, by_hand, library, parameters):
        """The ledgers of the two programs with the same parameters."""
        return [ledger for _, ledger in self.run_many(
            [(by_hand, by_hand, parameters), (library, library, parameters + NO_FIELDS)])]

    def compare(self, by_hand, library, tolerance, scales):
        """Each number of the columns that both tables have; their size by unit."""
        names = [name for name in by_hand.names if name in library.names
                 and name not in NOISE]
        for name in names:
            with self.subTest(name):
                unit = by_hand.units[by_hand.names.index(name)]
                self.assertEqual(unit, library.units[library.names.index(name)])
                self.assertEqual(len(by_hand[name]), len(library[name]))
                difference = largest(a - b for a, b in zip(by_hand[name],
                                                           library[name]))
                self.assertLess(difference, tolerance * scales[unit])
        return names

    def test_bar(self):
        for treatment in ("Nitsche", "penalty", "Signorini active set"):
            for scheme in ("Crank-Nicolson", "midpoint"):
                with self.subTest(treatment=treatment, scheme=scheme):
                    # With multipliers and consistent mass Crank-Nicolson makes energy,
                    # and opens and closes contact many times: a perturbation grows by a
                    # factor of ten in a second.
                    grows = (treatment, scheme) == ("Signorini active set",
                                                    "Crank-Nicolson")
                    by_hand, library = self.run_both(
                        "bar_by_hand", "bar_sd",
                        [f"Contact/Treatment={treatment}", f"Time/Scheme={scheme}",
                         f"Time/Final time={3.5 if grows else 12}"])
                    # Energies are 1/8 J, displacements 1/2 m, velocities and pressures
                    # about 1.
                    names = self.compare(by_hand, library, 1e-10,
                                         {"s": 12., "J": .125, "m": .5, "m/s": 1.,
                                          "N": 1.})
                    self.assertEqual(
                        set(names),
                        {"time", "kinetic_energy", "elastic_energy", "energy",
                         "modified_energy", "contact_work", "contact_force_left",
                         "displacement_left", "velocity_left"})
                    # The bar touches, and flies again.
                    self.assertGreater(max(by_hand["contact_force_left"]), .4)
                    self.assertEqual(by_hand["contact_force_left"][-1], 0.)
                    self.assertLess(largest(by_hand["balance_residual"]), 1e-13)

    def test_bar_on_another_mesh(self):
        parameters = ["Mesh/Mesh size=0.02", "Time/Time step=0.03", "Time/Final time=4",
                      "Time/Scheme=midpoint", "Contact/Nitsche gamma0=20"]
        self.compare(*self.run_both("bar_by_hand", "bar_sd", parameters), 1e-10,
                     {"s": 12., "J": .125, "m": .5, "m/s": 1., "N": 1.})

    def test_disk(self):
        by_hand, library = self.run_both("disk_step_by_step", "elastic_ball", BALL)
        # Newton's tolerance is 1e-10 of the forces in one, 1e-12 in the other.
        start = library["energy"][0]
        names = self.compare(by_hand, library, 1e-10,
                             {"s": 1., "J": start, "m": .1,
                              "N": max(library["contact_force_foundation"])})
        self.assertEqual(
            set(names),
            {"time", "kinetic_energy", "elastic_energy", "energy", "modified_energy",
             "contact_work", "smallest_gap_foundation", "contact_force_foundation"})
        # All of the impact, whose springs hold part of the energy meanwhile.
        self.assertGreater(max(by_hand["contact_force_foundation"]), 3e8)
        self.assertEqual(by_hand["contact_force_foundation"][-1], 0.)
        self.assertLess(min(by_hand["energy"]), .999 * start)
        self.assertLess(largest(energy - start for energy in by_hand["modified_energy"]),
                        1e-10 * start)
        self.assertLess(largest(by_hand["balance_residual"]), 1e-10)

    def test_what_they_refuse(self):
        for program, parameter, message in (
                ("bar_by_hand", "Mesh/Mesh size=0.03", "does not divide the bar"),
                ("bar_by_hand", "Contact/Nitsche gamma0=1", "must exceed the modulus"),
                ("bar_by_hand", "Contact/Penalty epsilon0=1", "has no effect"),
                ("disk_step_by_step", "Time/Time step=1", "between one and 1e8 time steps"),
                ("disk_step_by_step", "Mesh/Nodes=8", "nodes")):
            with self.subTest(parameter):
                code, _, error = self.attempt(program, [parameter])
                self.assertEqual(code, 1, msg=error)
                self.assertIn(message, error)


if __name__ == "__main__":
    main()
