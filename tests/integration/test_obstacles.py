# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies on curved and moving obstacles (obstacle_course): energy, friction on an
incline against hand calculations, work of moving obstacles, restart, ranks, and refused input."""

import math

from common import *

FILES = ROOT / "parameter_files" / "obstacle_course"
COARSE = NO_FIELDS + ["Body/Boundary nodes=32"]

FLOOR = ["Obstacle/Shape=level set",
         "Obstacle/Function=y - 0.05*sin(4*x)",
         "Obstacle/Gradient=-0.2*cos(4*x); 1", "Obstacle/Length=0.2",
         "Body/Centre=0.2,0.6"]
BOWL = ["Obstacle/Radius=2", "Obstacle/Body inside=true",
        "Body/Centre=-1.2,-0.88"]
DISK = []


def energy_of_all(ledger):
    """Energy with that of contact and without the work of gravity."""
    return [e - w for e, w in zip(ledger["modified_energy"],
                                  ledger["external_work"])]


class ObstaclesAtRest(ProgramTest):

    def impact(self, obstacle, treatment, *parameters, n_ranks=1):
        return self.run_program(
            "obstacle_course",
            COARSE + obstacle + ["Time/Final time=0.3", "Time/Time step=3e-3",
                                 f"Contact/Treatment={treatment}", *parameters],
            n_ranks=n_ranks)

    def test_energy_is_kept(self):
        for obstacle in (DISK, BOWL, FLOOR):
            for treatment in KEEP_ENERGY + KEEP_MODIFIED_ENERGY:
                with self.subTest(f"{obstacle} {treatment}"):
                    ledger = self.impact(obstacle, treatment)
                    energy = energy_of_all(ledger)
                    scale = max(ledger["kinetic_energy"])
                    self.assertGreater(max(ledger["contact_force_obstacle"]), 1e3)
                    self.assertLess((max(energy) - min(energy)) / scale, 1e-9)
                    self.assertLess(max(map(abs, ledger["balance_residual"])),
                                    1e-9)
                    if treatment in KEEP_ENERGY:
                        self.assertLess(max(map(abs, ledger["contact_work"])),
                                        1e-9 * scale)

    def test_linear_bodies_with_nitsche(self):
        """They cannot turn, and their energy is kept or lost all the same. The
        hybrid never gains; Nitsche itself closes its balance."""
        for treatment in ("Nitsche-hybrid", "Nitsche"):
            ledger = self.impact(BOWL, treatment,
                                 "Material/Law=linear elastic",
                                 "Contact/Nitsche gamma0=4e7")
            self.assertGreater(max(ledger["contact_force_obstacle"]), 1e3)
            self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-9)
            if treatment == "Nitsche-hybrid":
                energy = energy_of_all(ledger)
                scale = max(ledger["kinetic_energy"])
                self.assertLess(max(b - a for a, b in zip(energy, energy[1:])),
                                1e-11 * scale)

    def test_other_schemes_close_their_balance(self):
        for scheme in ("HHT 0.05", "TR-BDF2", "CN"):
            for treatment in ("penalty", "Signorini active set"):
                with self.subTest(f"{scheme} {treatment}"):
                    ledger = self.impact(BOWL, treatment, *SCHEMES[scheme])
                    self.assertGreater(max(ledger["contact_force_obstacle"]),
                                       1e3)
                    self.assertLess(max(map(abs, ledger["balance_residual"])),
                                    1e-9)

    def test_arkode_agrees(self):
        """An integrator of its own to another one with small steps."""
        centre = [self.impact(BOWL, "penalty", "Contact/Penalty epsilon0=1e-6",
                              "Time/Final time=0.15", *more)
                  ["centre_displacement_y"][-1]
                  for more in (["Time/Scheme=ARKODE"],
                               ["Time/Time step=5e-4"])]
        self.assertAlmostEqual(centre[0], centre[1], delta=6e-5)

    def test_ranks(self):
        ledgers = [self.impact(FLOOR, "persistent contact",
                               "Contact/Friction coefficient=0.2", n_ranks=n)
                   for n in (1, 2)]
        for name in ("kinetic_energy", "friction_work", "momentum_x"):
            scale = max(map(abs, ledgers[0][name]))
            self.assertLess(max(abs(a - b) for a, b in
                                zip(ledgers[0][name], ledgers[1][name])),
                            1e-9 * scale, msg=name)


class FoldingStrip(ProgramTest):
    """A strip that falls on its end buckles and touches itself, and the ground."""

    def fall(self, treatment, *parameters, promise_off_by=None):
        return self.run_program(
            "obstacle_course",
            NO_FIELDS + ["Time/Final time=0.2",
                         f"Contact/Treatment={treatment}", *parameters],
            prm=FILES / "folding_strip.prm", promise_off_by=promise_off_by)

    def test_balance_and_depth(self):
        for treatment in ("persistent contact", "Signorini active set"):
            with self.subTest(treatment):
                ledger = self.fall(treatment)
                start = ledger["energy"][0]
                self.assertGreater(max(ledger["active_points_itself"]), 0)
                self.assertGreater(max(ledger["contact_force_itself"]), 1.)
                self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-10)
                energy = energy_of_all(ledger)
                if treatment in KEEP_ENERGY:
                    for e in energy:
                        self.assertLess(abs(e - start), 1e-9 * start)
                    # No deeper than in the ground.
                    self.assertLess(max(ledger["penetration_itself"]),
                                    max(ledger["penetration_obstacle"]))
                else:
                    for a, b in zip(energy, energy[1:]):
                        self.assertLess(b - a, 1e-11 * start)
                    # The strip is 1.2 m long.
                    for name in ("itself", "obstacle"):
                        self.assertLess(max(ledger[f"penetration_{name}"]),
                                        1.2e-10)

    def test_on_a_circle_with_friction(self):
        """Forces of both contacts have all directions here, and nodes that can touch
        themselves have multipliers, which do not act on the obstacle."""
        for treatment in ("persistent contact", "Ayyad-Barboteu two-step",
                          "Signorini active set"):
            with self.subTest(treatment):
                ledger = self.fall(treatment, "Obstacle/Shape=circle",
                                   "Body/Centre=0.1,1.15", "Time/Final time=0.1",
                                   "Contact/Friction coefficient=0.2")
                start = ledger["energy"][0]
                self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-10)
                work = ledger["friction_work"]
                self.assertGreater(work[-1], 1e-3 * start)
                for a, b in zip(work, work[1:]):
                    self.assertGreaterEqual(b - a, -1e-12 * start)
                energy = energy_of_all(ledger)
                for a, b in zip(energy, energy[1:]):
                    self.assertLess(b - a, 1e-11 * start)


    def test_shares_of_both_contacts(self):
        """A node is pressed by the strip or by the ground, here a plate that rises. The strip
        touches itself while it flies: these forces do not belong to the plate."""
        for treatment, parameters, promise_off_by in (
                ("persistent contact", [], None),
                ("Signorini active set", [], None),
                # Two nodes are released in a fold while they are pressed, and their stored energy
                # is lost.
                ("improved normal compliance", ["Contact/Compliance coefficient=1e9"],
                 2.7e-4)):
            with self.subTest(treatment):
                ledger = self.fall(treatment, "Obstacle/Translation=0; 0.5*t",
                                   *parameters, promise_off_by=promise_off_by)
                self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-10)
                n_in_flight = 0
                for k, of_plate in enumerate(ledger["contact_force_obstacle"]):
                    if ledger["smallest_gap_obstacle"][k] > .01:
                        self.assertEqual(of_plate, 0.)
                        self.assertEqual(ledger["active_points_obstacle"][k], 0)
                        n_in_flight += ledger["active_points_itself"][k] > 0
                self.assertGreater(n_in_flight, 2)
                # The plate pushes upwards with the force of the ledger, at 0.5 m/s.
                push = sum(.5 * force * (b - a) for force, a, b in
                           zip(ledger["contact_force_obstacle"][1:], ledger["time"],
                               ledger["time"][1:]))
                self.assertLess(abs(ledger["obstacle_work"][-1] - push), 1e-9 * push)


class Incline(ProgramTest):
    """tan(beta) = 1/2. Coarser bodies than those of the parameter files, which
    the figures hold against the same numbers."""

    SINE, COSINE, GRAVITY = math.sqrt(.2), 2. * math.sqrt(.2), 9.81

    def acceleration(self, file, mass, *parameters):
        """Down the slope: that of the least-squares line through the momentum,
        once the body has settled."""
        ledger = self.run_program("obstacle_course", NO_FIELDS +
                                  list(parameters), prm=FILES / file)
        self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-9)
        time = ledger["time"]
        first = len(time) // 3
        time = time[first:]
        velocity = [(self.COSINE * x - self.SINE * y) / mass for x, y in
                    zip(ledger["momentum_x"][first:],
                        ledger["momentum_y"][first:])]
        middle = sum(time) / len(time)
        return (sum((t - middle) * v for t, v in zip(time, velocity)) /
                sum((t - middle)**2 for t in time))

    def test_a_block_slides_or_sticks(self):
        coarse = "Body/Boundary nodes=64"
        sliding = self.acceleration("block_slides.prm", 500., coarse)
        exact = self.GRAVITY * (self.SINE - .49 * self.COSINE)
        self.assertAlmostEqual(sliding / exact, 1., delta=.02)
        sticking = self.acceleration("block_sticks.prm", 500., coarse)
        self.assertLess(abs(sticking), 2e-3 * self.GRAVITY * self.SINE)

    def test_a_disk_slips_or_rolls(self):
        mass = 1000. * .5 * 64 * .25 * math.sin(2. * math.pi / 64)
        coarse = ["Body/Boundary nodes=64"]
        slipping = self.acceleration("disk_slips.prm", mass, *coarse)
        exact = self.GRAVITY * (self.SINE - .15 * self.COSINE)
        self.assertAlmostEqual(slipping / exact, 1., delta=.02)
        # A polygon of 64 edges loses at each of them.
        rolling = self.acceleration("disk_rolls.prm", mass, *coarse)
        exact = 2. / 3. * self.GRAVITY * self.SINE
        self.assertAlmostEqual(rolling / exact, 1., delta=.05)
        self.assertLess(rolling, 1.01 * exact)


class MovingObstacles(ProgramTest):

    def difference(self, file, time_step):
        """Difference of the obstacle's work by the balance and by its resultants."""
        ledger = self.run_program("obstacle_course", COARSE +
                                  [f"Time/Time step={time_step}",
                                   "Time/Final time=0.4"], prm=FILES / file)
        self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-9)
        friction = ledger["friction_work"]
        self.assertGreater(friction[-1], .1)
        self.assertGreater(min(b - a for a, b in zip(friction, friction[1:])),
                           -1e-12 * friction[-1])
        stored = ledger["modified_energy"][-1] - ledger["energy"][-1]
        by_balance = stored - ledger["contact_work"][-1]
        self.assertGreater(by_balance, 100.)
        return abs(by_balance - ledger["obstacle_work"][-1])

    def test_their_work(self):
        for file in ("rising_plate.prm", "drum.prm"):
            with self.subTest(file):
                coarse, fine = (self.difference(file, step)
                                for step in (8e-3, 4e-3))
                self.assertGreater(coarse / fine, 3.)
                self.assertLess(coarse / fine, 5.)

    def test_restart(self):
        """The work of the obstacle is part of a checkpoint."""
        parameters = COARSE + ["Output/Checkpoint every=10"]
        whole = self.run_program("obstacle_course", parameters +
                                 ["Time/Final time=0.16"],
                                 self.folder / "whole",
                                 prm=FILES / "rising_plate.prm")
        for end, options in (("0.08", []), ("0.16", ["--resume"])):
            parts = self.run_program("obstacle_course", parameters +
                                     [f"Time/Final time={end}"],
                                     self.folder / "parts",
                                     prm=FILES / "rising_plate.prm",
                                     options=options)
        self.assertGreater(whole["obstacle_work"][-1], 1.)
        self.assertEqual(whole.columns, parts.columns)

    def test_halved_steps_add_their_work(self):
        ledger = self.run_program(
            "obstacle_course", COARSE + ["Newton/Maximum iterations=4",
                                         "Time/Final time=0.2"],
            prm=FILES / "rising_plate.prm")
        self.assertGreater(ledger["step_halvings"][-1], 0)
        self.assertAlmostEqual(-ledger["contact_work"][-1] /
                               ledger["obstacle_work"][-1], 1., delta=1e-4)


class BadObstacles(ProgramTest):

    def refuse(self, message, *parameters):
        code, out, err = self.attempt("obstacle_course", parameters)
        self.assertEqual(code, 1, msg=out + err)
        self.assertIn(message, " ".join(err.split()))
        self.assertFalse((self.folder / "run" / "energy.csv").exists())

    def test_overlap_at_the_start(self):
        self.refuse("overlaps with the obstacle", "Body/Centre=0,0.9")

    def test_an_obstacle_within_the_body(self):
        self.refuse("overlaps with the obstacle", "Body/Centre=0.013,0.017",
                    "Obstacle/Radius=0.005")

    def test_a_gradient_of_another_function(self):
        self.refuse("is not that of its function", *FLOOR,
                    "Obstacle/Gradient=-0.3*cos(4*x); 1")

    def test_expressions(self):
        self.refuse("cannot be read", *FLOOR, "Obstacle/Function=y - sin(4*")
        self.refuse("cannot be read", "Obstacle/Rotation=2*tau")
        self.refuse("needs 2 expressions", "Obstacle/Translation=0; t; 0")
        self.refuse("needs 2 expressions", *FLOOR, "Obstacle/Gradient=0")

    def test_a_motion_that_is_not_finite(self):
        self.refuse("is not finite at t = 0.25", "Obstacle/Rotation=1/(t-0.25)")

    def test_a_direction_of_no_length(self):
        self.refuse("vector of no length", "Obstacle/Shape=half space",
                    "Obstacle/Direction=0,0")

    def test_arkode_with_a_moving_obstacle(self):
        self.refuse("cannot be combined with an obstacle that moves",
                    "Contact/Treatment=penalty", "Time/Scheme=ARKODE",
                    "Obstacle/Rotation=t")

    def test_parameters_of_another_shape(self):
        self.refuse("Obstacle/Radius", "Obstacle/Shape=half space",
                    "Obstacle/Radius=2")


if __name__ == "__main__":
    main()
