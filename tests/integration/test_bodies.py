# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact between deformable bodies (colliding_disks, stent_artery, sliding_block):
energy and momenta, the motion of a rigid block, independence of the choice of the slave, restart,
ranks, and refused input."""

import math

from common import *

FILES = ROOT / "parameter_files"

# Disks that meet with an offset, so that nodes pass vertices. They part before the
# end of the run.
DISKS = NO_FIELDS + ["Disks/Rings of the left disk=6",
                     "Disks/Rings of the right disk=5", "Disks/Offset=1"]
COARSE_STENT = NO_FIELDS + ["Geometry/Artery nodes along=41",
                            "Geometry/Artery nodes across=5",
                            "Geometry/Stent nodes along=52",
                            "Geometry/Stent nodes across=3"]

# Compliance that is soft enough for the artery: with the program's defaults, 1000
# times as stiff, Newton's method fails soon after the stent has reached the wall.
SOFT = ["Contact/Compliance coefficient=100"]
SOFT_STENT = {name: ["Contact/Tangential compliance=0.1"] + SOFT
              for name in ("improved normal compliance", "Hauret-Le Tallec",
                           "standard normal compliance",
                           "standard normal compliance at midpoint")}
SOFT_STENT["penalty"] = ["Contact/Tangential compliance=0.1",
                         "Contact/Penalty epsilon0=1e-2"]

PARTS = {"colliding_disks": ("left", "right"),
         "stent_artery": ("artery", "stent"),
         "sliding_block": ("block", "strip")}
MOMENTA = ("momentum_x", "momentum_y", "angular_momentum")

# All that goes between bodies.
PAIR_TREATMENTS = (KEEP_ENERGY + KEEP_MODIFIED_ENERGY +
                   [name for name in LOSE_ENERGY
                    if name != "Signorini multipliers"] +
                   ["standard normal compliance at midpoint"])


def by_turns(cases):
    """With assertions every other one: the release build runs all of them."""
    return cases[::2] if is_debug_build() else cases


class BodiesTest(ProgramTest):

    def check_parts(self, program, ledger):
        """The contributions of the parts add up to the whole, row by row."""
        first, second = PARTS[program]
        for name in ("kinetic_energy", "elastic_energy") + MOMENTA:
            parts = [ledger[f"{name}_{part}"] for part in (first, second)]
            scale = max(map(largest, parts))
            for whole, a, b in zip(ledger[name], *parts):
                self.assertLess(abs(whole - a - b), 1e-12 * scale, msg=name)
        # There is one contact, which takes all that contact takes.
        contact = {"colliding_disks": "disks", "stent_artery": "wall",
                   "sliding_block": "block"}[program]
        for name, kind in (("contact", "normal"), ("friction", "friction")):
            for whole, one in zip(ledger[f"{name}_work"],
                                  ledger[f"{kind}_work_{contact}"]):
                self.assertLess(abs(whole - one), 1e-9 * max(ledger["energy"]))
        # Exchange of energy: the sum given away by the parts is the dissipation of contact and
        # friction, and a part without other loads lacks the energy that it has given away.
        scale = max(ledger["energy"])
        works = [ledger[f"contact_work_{part}"] for part in (first, second)]
        for c, f, a, b in zip(ledger["contact_work"], ledger["friction_work"],
                              *works):
            self.assertLess(abs(c + f - a - b), 1e-9 * scale)
        free = {"colliding_disks": (first, second), "stent_artery": (first,),
                "sliding_block": ()}[program]
        if ledger["viscous_dissipation"][-1] > 0.:
            free = ()
        for part in free:
            whole = [k + e + w for k, e, w in
                     zip(ledger[f"kinetic_energy_{part}"],
                         ledger[f"elastic_energy_{part}"],
                         ledger[f"contact_work_{part}"])]
            self.assertLess(max(whole) - min(whole), 1e-9 * scale, msg=part)
            self.assertGreater(largest(ledger[f"contact_work_{part}"]),
                               1e-3 * scale)

    def check_balance(self, ledger, tolerance):
        """The residual is relative to the initial energy, or, where a displacement is
        imposed, to the largest energy so far. At the beginning that is nearly zero: these rows are
        relative to the largest of the run."""
        energy, so_far = ledger["energy"], 0.
        for residual, e in zip(ledger["balance_residual"], energy):
            so_far = max(so_far, e)
            weight = so_far / max(energy) if "imposed_work" in ledger.names else 1.
            self.assertLess(abs(residual) * weight, tolerance)

    def check_friction(self, ledger, friction):
        """Friction never adds energy, except for round-off of the largest terms of the run."""
        work = ledger["friction_work"]
        self.assertGreaterEqual(min(increments(work)),
                                -1e-12 * max(ledger["energy"]))
        self.assertEqual(work[-1] > 0., friction)

    def long_run(self):
        if is_debug_build():
            self.skipTest("takes long with assertions; other tests run the same")


class Disks(BodiesTest):

    def check_momenta(self, ledger):
        """No external loads. Relative to the momentum of either disk and, over the radius of 1 m,
        its moment."""
        scale = sum(abs(ledger[f"momentum_x_{part}"][0])
                    for part in PARTS["colliding_disks"])
        for name, tolerance in (("momentum_x", 1e-11), ("momentum_y", 1e-11),
                                ("angular_momentum", 1e-10)):
            drift = largest([p - ledger[name][0] for p in ledger[name]])
            self.assertLess(drift / scale, tolerance, msg=name)

    def check_energy(self, treatment, ledger, friction):
        scale = ledger["energy"][0]
        if treatment in KEEP_ENERGY:
            # The loss is the work of friction; contact itself does no work.
            kept = ledger["energy"]
            self.assertLess(largest(ledger["contact_work"]), 1e-9 * scale)
        else:
            kept = ledger["modified_energy"]
        total = [e + w for e, w in zip(kept, ledger["friction_work"])]
        if treatment in KEEP_ENERGY + KEEP_MODIFIED_ENERGY:
            self.assertLess(largest([e - scale for e in total]), 1e-9 * scale)
            if not friction:
                self.assertLess(largest([e - scale for e in kept]),
                                1e-9 * scale)
        elif treatment in LOSE_ENERGY:
            self.assertLess(max(increments(total)), 1e-11 * scale)
            # They do lose at the impact.
            self.assertLess(total[-1], (1. - 1e-4) * scale)
        # "at midpoint" neither keeps nor always loses; its balance closes.

    def test_every_treatment(self):
        short = ["Time/Final time=0.06"] if is_debug_build() else []
        cases = [((treatment, friction), "colliding_disks",
                  DISKS + short + [f"Contact/Treatment={treatment}",
                                   f"Contact/Friction coefficient={friction}"])
                 for treatment in PAIR_TREATMENTS for friction in (0, .2)]
        if is_debug_build():
            # Each treatment once, with friction and without by turns.
            cases = [pair[number % 2] for number, pair in
                     enumerate(zip(cases[::2], cases[1::2]))]
        for (treatment, friction), ledger in self.run_many(cases):
            with self.subTest(f"{treatment} {friction}"):
                # There was contact, of several points.
                self.assertGreater(max(ledger["contact_force_disks"]), 1e4)
                self.assertGreater(max(ledger["active_points_disks"]), 1)
                if not short:
                    self.assertEqual(ledger["contact_force_disks"][-1], 0.)
                self.assertEqual(ledger["step_halvings"][-1], 0)
                self.check_balance(ledger, 1e-9)
                self.check_energy(treatment, ledger, friction > 0)
                self.check_momenta(ledger)
                self.check_parts("colliding_disks", ledger)
                if treatment == "Signorini active set":
                    self.assertLess(max(ledger["penetration_disks"]), 1e-9)
                self.check_friction(ledger, friction > 0)

    def test_head_on(self):
        """Files as they are, with the finer meshes of the program. With improved
        normal compliance the gap at the end of a step has to be that at the beginning
        of the next one, also where a point passes a vertex."""
        for file in ("default.prm", "head_on_inc.prm"):
            with self.subTest(file):
                self.long_run()
                ledger = self.run_program("colliding_disks", NO_FIELDS,
                                          prm=FILES / "colliding_disks" / file)
                energy = ledger["modified_energy"]
                self.assertLess(largest([e - energy[0] for e in energy]),
                                1e-9 * energy[0])
                # They come to a rest, nearly, and part again.
                self.assertLess(min(ledger["kinetic_energy"]), .4 * energy[0])
                self.assertEqual(ledger["contact_force_disks"][-1], 0.)
                self.check_momenta(ledger)

    def test_slave_and_master(self):
        """Which disk is the slave matters less than the mesh: the velocities at the
        end differ by less than what they changed by from the next coarser mesh,
        for either slave. Steps are refined with the mesh: with all of them of 4 ms
        the two come no nearer to each other than 0.004 m/s, since persistent contact penetrates by
        the displacement of a point in the step in which it touches."""
        self.long_run()
        meshes = ((6, 5, 8e-3), (11, 9, 4e-3), (22, 18, 2e-3))
        cases = [((left, slave), "colliding_disks",
                  NO_FIELDS + ["Disks/Offset=1", f"Disks/Slave={slave}",
                               "Contact/Friction coefficient=0.2",
                               f"Disks/Rings of the left disk={left}",
                               f"Disks/Rings of the right disk={right}",
                               f"Time/Time step={step}"])
                 for left, right, step in meshes for slave in ("left", "right")]
        velocity = {}
        for name, ledger in self.run_many(cases):
            # Divided by the mass of each disk.
            velocity[name] = [
                ledger[f"momentum_{c}_{disk}"][-1] /
                abs(ledger[f"momentum_x_{disk}"][0])
                for disk in PARTS["colliding_disks"] for c in "xy"]
        between = [math.dist(velocity[mesh[0], "left"],
                             velocity[mesh[0], "right"]) for mesh in meshes]
        for n in (1, 2):
            self.assertLess(between[n], .5 * between[n - 1])
            for slave in ("left", "right"):
                change = math.dist(velocity[meshes[n][0], slave],
                                   velocity[meshes[n - 1][0], slave])
                self.assertLess(between[n], change)


class CutFaces(BodiesTest):
    """Linear elastic disks at small displacements: treatments that integrate over faces, with the
    time schemes that they have against rigid obstacles."""

    DISKS = NO_FIELDS + ["Material/Law=linear elastic",
                         "Contact/Coupling=cut faces",
                         "Disks/Rings of the left disk=6",
                         "Disks/Rings of the right disk=5"]

    # Treatment, theta, scheme, and what of the energy never grows.
    CASES = (("Nitsche-hybrid", 1, "midpoint", "modified_energy"),
             ("Nitsche", 1, "midpoint", "energy"),
             ("Nitsche", 0, "midpoint", "energy"),
             ("Nitsche", -1, "midpoint", "energy"),
             ("Nitsche", 1, "TR-BDF2", None),
             ("Nitsche", -1, "HHT", None),
             ("penalty", 1, "midpoint", "modified_energy"),
             ("penalty", 1, "Crank-Nicolson", None),
             ("proximal augmented Lagrangian", 1, "midpoint", "energy"),
             ("proximal augmented Lagrangian", 1, "HHT", None))

    @classmethod
    def parameters(cls, treatment, theta=1, scheme="midpoint"):
        own = {"penalty": ["Contact/Penalty epsilon0=1e-7"],
               "proximal augmented Lagrangian": ["Contact/Augmentation=2e7"]}
        return cls.DISKS + [f"Contact/Treatment={treatment}",
                            f"Time/Scheme={scheme}"] + own.get(
            treatment, ["Contact/Nitsche gamma0=2e7",
                        f"Contact/Nitsche theta={theta}"])

    def test_balance_and_momenta(self):
        runs = [(case, "colliding_disks", self.parameters(*case[:3]))
                for case in self.CASES[::3 if is_debug_build() else 1]]
        for (treatment, theta, scheme, kept), ledger in self.run_many(runs):
            with self.subTest(f"{treatment} {theta} {scheme}"):
                self.assertGreater(max(ledger["contact_force_disks"]), 1e4)
                self.assertEqual(ledger["contact_force_disks"][-1], 0.)
                energy = ledger["energy"]
                # With the same velocities as other methods: they bounce back.
                self.assertLess(min(ledger["kinetic_energy"]), .4 * energy[0])
                self.assertGreater(energy[-1], .97 * energy[0])
                self.assertLess(energy[-1], 1.0001 * energy[0])
                if scheme == "midpoint":
                    self.check_balance(ledger, 1e-11)
                if kept == "modified_energy":
                    self.assertLess(max(increments(ledger[kept])),
                                    1e-12 * energy[0])
                elif kept:
                    # From before the impact to after it.
                    self.assertLess(energy[-1], (1. - 1e-4) * energy[0])
                scale = abs(ledger["momentum_x_left"][0])
                for name in MOMENTA:
                    drift = largest([p - ledger[name][0] for p in ledger[name]])
                    self.assertLess(drift / scale, 1e-11, msg=name)

    def test_like_other_treatments(self):
        """They leave with the velocities that Signorini's condition on mortar gaps
        gives them, except for the error of meshes as coarse as these."""
        restitution = {}
        runs = [(name, "colliding_disks", parameters) for name, parameters in (
            ("mortar", NO_FIELDS + self.DISKS[1:2] +
             ["Contact/Coupling=mortar",
              "Contact/Treatment=Signorini active set"] + self.DISKS[-2:]),
            ("Nitsche", self.parameters("Nitsche")))]
        for name, ledger in self.run_many(runs):
            restitution[name] = (-ledger["momentum_x_left"][-1] /
                                 ledger["momentum_x_left"][0])
        self.assertLess(abs(restitution["mortar"] - restitution["Nitsche"]), .03)

    def test_what_is_refused(self):
        if is_debug_build():
            self.skipTest("is refused before anything is computed")
        for message, parameters in (
                ("acts in nodes and cannot be combined with Contact/Coupling = cut "
                 "faces", ["Contact/Treatment=persistent contact"]),
                ("is too small for theta = 1",
                 ["Contact/Treatment=Nitsche", "Contact/Nitsche gamma0=2e5"]),
                ("Stick = exact cannot be combined with Contact/Coupling = cut faces",
                 ["Contact/Treatment=penalty", "Contact/Stick=exact",
                  "Contact/Friction coefficient=0.2"]),
                ("cut faces is for linear elastic bodies",
                 ["Contact/Treatment=penalty",
                  "Material/Law=Saint Venant-Kirchhoff"])):
            code, out, err = self.attempt("colliding_disks",
                                          self.DISKS + parameters)
            self.assertEqual(code, 1, msg=out + err)
            self.assertIn(message, " ".join(err.split()))


class Stent(BodiesTest):

    def deploy(self, file, *parameters, **kwargs):
        return self.run_program("stent_artery", NO_FIELDS + list(parameters),
                                prm=FILES / "stent_artery" / file, **kwargs)

    def test_without_friction(self):
        """All work of the imposed displacement is stored."""
        self.long_run()
        ledger = self.deploy("default.prm")
        scale = max(ledger["energy"])
        self.check_balance(ledger, 1e-9)
        self.check_parts("stent_artery", ledger)
        self.check_friction(ledger, False)
        for energy, work in zip(ledger["energy"], ledger["imposed_work"]):
            self.assertLess(abs(energy - work), 1e-9 * scale)
        self.assertLess(largest(ledger["contact_work"]), 1e-9 * scale)
        # Half the nodes of the wall touch at the end. At first touch they penetrate by the
        # displacement of a step, and stay; a facet is 0.12 mm long.
        self.assertGreater(ledger["active_points_wall"][-1], 30)
        self.assertLess(max(ledger["penetration_wall"]), .015)

    def test_what_friction_and_viscosity_take(self):
        """Dissipation grows with either coefficient. Neither adds energy."""
        self.long_run()
        for column, files in (
                ("friction_work",
                 ("default.prm", "mu_0.1.prm", "mu_0.2.prm", "mu_0.4.prm")),
                ("viscous_dissipation",
                 ("default.prm", "eta_0.001.prm", "eta_0.01.prm"))):
            taken = []
            for file in files:
                with self.subTest(file):
                    ledger = self.deploy(file)
                    self.check_balance(ledger, 1e-9)
                    scale = max(ledger["energy"])
                    gain = max(e - ledger["energy"][0] - w for e, w in
                               zip(ledger["energy"], ledger["imposed_work"]))
                    self.assertLess(gain, 1e-9 * scale)
                    self.assertGreaterEqual(min(increments(ledger[column])),
                                            -1e-13 * scale)
                    taken.append(ledger[column][-1])
            self.assertEqual(taken[0], 0.)
            # Not by round-off. The largest coefficient of friction holds the wall
            # nearly everywhere, and then nothing slides: 0.47 and 0.54 mJ.
            for a, b in zip(taken, taken[1:]):
                self.assertGreater(b, a + .01)

    def test_every_treatment(self):
        """Coarse, with friction, until five struts press."""
        end = .3 if is_debug_build() else .6
        cases = [(treatment, "stent_artery",
                  COARSE_STENT + [f"Time/Final time={end}",
                                  "Contact/Friction coefficient=0.2",
                                  f"Contact/Treatment={treatment}"] +
                  SOFT_STENT.get(treatment, []))
                 for treatment in by_turns(PAIR_TREATMENTS)]
        for treatment, ledger in self.run_many(cases):
            with self.subTest(treatment):
                self.assertGreater(ledger["contact_force_wall"][-1], 0.)
                self.check_balance(ledger, 1e-9)
                self.check_parts("stent_artery", ledger)
                self.check_friction(ledger, True)
                scale = max(ledger["energy"])
                kept = (ledger["energy"] if treatment in KEEP_ENERGY
                        else ledger["modified_energy"])
                total = [e + f - w for e, f, w in
                         zip(kept, ledger["friction_work"],
                             ledger["imposed_work"])]
                if treatment in KEEP_ENERGY + KEEP_MODIFIED_ENERGY:
                    self.assertLess(largest(total), 1e-9 * scale)
                elif treatment in LOSE_ENERGY:
                    self.assertLess(max(increments(total)), 1e-9 * scale)


class Block(BodiesTest):
    """The motion of a rigid block of 500 kg. tan(beta) = 1/2."""

    MASS, GRAVITY = 500., 9.81
    SINE, COSINE = math.sqrt(.2), 2. * math.sqrt(.2)

    def slide(self, file, *parameters):
        ledger = self.run_program("sliding_block", NO_FIELDS + list(parameters),
                                  prm=FILES / "sliding_block" / file)
        self.check_balance(ledger, 1e-9)
        self.check_parts("sliding_block", ledger)
        self.check_friction(ledger, True)
        return ledger

    def acceleration(self, ledger):
        """That of the least-squares line through the momentum in the second half."""
        time = ledger["time"]
        first = len(time) // 2
        time = time[first:]
        velocity = [p / self.MASS for p in ledger["momentum_x_block"][first:]]
        middle = sum(time) / len(time)
        return (sum((t - middle) * v for t, v in zip(time, velocity)) /
                sum((t - middle)**2 for t in time))

    def test_on_the_level(self):
        exact = -.3 * self.GRAVITY
        for treatment in by_turns(by_turns(PAIR_TREATMENTS)):
            with self.subTest(treatment):
                ledger = self.slide("default.prm",
                                    f"Contact/Treatment={treatment}")
                self.assertAlmostEqual(self.acceleration(ledger) / exact, 1.,
                                       delta=.01)
                # Displacement, v t + a t^2/2, and the work of friction over it.
                self.assertAlmostEqual(ledger["slide_block"][-1],
                                       2. * .5 + .5 * exact * .25, delta=2e-3)
                self.assertAlmostEqual(
                    ledger["friction_work"][-1] /
                    (-self.MASS * exact * ledger["slide_block"][-1]), 1.,
                    delta=.01)

    def test_a_slope(self):
        self.long_run()
        sliding = self.acceleration(self.slide("slope_slides.prm"))
        exact = self.GRAVITY * (self.SINE - .49 * self.COSINE)
        self.assertAlmostEqual(sliding / exact, 1., delta=.03)
        sticking = self.slide("slope_sticks.prm")
        self.assertLess(abs(sticking["momentum_x_block"][-1]) / self.MASS, 1e-3)


class RestartAndRanks(BodiesTest):

    STENT = (["Time/Final time=0.4"], FILES / "stent_artery" / "mu_0.2.prm")

    def disks(self, treatment, end):
        return DISKS + ["Contact/Friction coefficient=0.2",
                        f"Contact/Treatment={treatment}",
                        f"Time/Final time={end}"]

    def pvd_entries(self, folder):
        """All but the comment, which holds the time of day."""
        return [line for line in (folder / "solution.pvd").read_text().split("\n")
                if "DataSet" in line]

    def stop_and_resume(self, program, parameters, stops, prm=None):
        """Compare a whole run to the last of @p stops with one that is stopped at
        each, in contact."""
        parameters = list(parameters) + ["Output/Fields every=5",
                                         "Output/Checkpoint every=1000"]
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.run_program(program, parameters + [f"Time/Final time={stops[-1]}"],
                         whole, prm=prm)
        options = []
        for time in stops:
            ledger = self.run_program(program,
                                      parameters + [f"Time/Final time={time}"],
                                      parts, options=options, prm=prm)
            options = ["--resume"]
            [force] = [name for name in ledger.names
                       if name.startswith("contact_force_")]
            self.assertGreater(ledger[force][-1], 0.)
            self.assertGreater(ledger["friction_work"][-1], 0.)
        self.assertEqual((whole / "energy.csv").read_text(),
                         (parts / "energy.csv").read_text())
        self.assertEqual(self.pvd_entries(whole), self.pvd_entries(parts))
        shutil.rmtree(parts)

    def test_stopped_in_contact(self):
        """Digit for digit."""
        cases = (("improved normal compliance", "points"),
                 ("persistent contact", "points"), ("persistent contact", "mortar"))
        if is_debug_build():
            cases = cases[1:2]
        else:
            self.stop_and_resume("stent_artery", [], [.36, .42, .46],
                                 FILES / "stent_artery" / "mu_0.2.prm")
        for treatment, coupling in cases:
            with self.subTest(f"{treatment} {coupling}"):
                self.stop_and_resume("colliding_disks",
                                     self.disks(treatment, .12) +
                                     [f"Contact/Coupling={coupling}"],
                                     [.06, .1, .12])

    def compare(self, one, other):
        """To 1e-9 of the largest value of each column; columns that are round-off are relative to
        the quantity that they are part of."""
        self.assertEqual(one.names, other.names)
        self.assertEqual(len(one["time"]), len(other["time"]))
        parts = [name for name in one.names
                 if name.startswith("momentum_x_")]
        # Disks fly, so mass times speed is what they bring; the stent is at rest before the run.
        momentum = sum(largest(one[name]) for name in parts)
        energy = largest(one["energy"])
        whole = {"momentum_x": momentum, "momentum_y": momentum,
                 "angular_momentum": momentum,
                 "contact_work": energy}
        for name in one.names:
            if name in NOISE:
                continue
            if all(math.isnan(a) and math.isnan(b)
                   for a, b in zip(one[name], other[name])):
                continue
            part_of = ("contact_work" if name.startswith("normal_work_") or
                       is_part_of_energy(name) else name)
            scale = max(largest(one[name]), whole.get(part_of, 0.)) or 1.
            difference = largest([a - b for a, b in zip(one[name], other[name])])
            self.assertLess(difference / scale, 1e-9, msg=name)

    def test_one_and_two_ranks(self):
        """Also a run that begins on one rank and goes on with two, in contact."""
        cases = (
                ("stent_artery", *self.STENT, .36),
                ("colliding_disks", self.disks("improved normal compliance", .12),
                 None, .08),
                ("colliding_disks", self.disks("persistent contact", .12),
                 None, .08),
                ("colliding_disks",
                 self.disks("improved normal compliance", .12) +
                 ["Contact/Coupling=mortar"], None, .08),
                ("colliding_disks",
                 CutFaces.parameters("Nitsche-hybrid") + ["Time/Final time=.12"],
                 None, .08))
        if is_debug_build():
            cases = cases[2:4]
        for program, parameters, prm, stop in cases:
            with self.subTest(f"{program} {parameters}"):
                parameters = NO_FIELDS + parameters
                one, two = (self.run_program(program, parameters,
                                             self.folder / f"{n}", n_ranks=n,
                                             prm=prm)
                            for n in (1, 2))
                self.compare(one, two)
                parts = self.folder / "parts"
                shutil.rmtree(parts, ignore_errors=True)
                parameters.append("Output/Checkpoint every=1000")
                self.run_program(program,
                                 parameters + [f"Time/Final time={stop}"], parts,
                                 prm=prm)
                resumed = self.run_program(program, parameters, parts, prm=prm,
                                           options=["--resume"], n_ranks=2)
                self.compare(one, resumed)


class BadBodies(ProgramTest):

    def setUp(self):
        super().setUp()
        if is_debug_build():
            self.skipTest("is refused before anything is computed")

    def refuse(self, program, messages, *parameters):
        code, out, err = self.attempt(program, parameters)
        self.assertEqual(code, 1, msg=out + err)
        text = " ".join(err.split())
        for message in messages:
            self.assertIn(message, text)
        for noise in ("Stacktrace", "dealii::", "terminate called", "violated"):
            self.assertNotIn(noise, err)
        self.assertLess(len(err.splitlines()), 24)
        self.assertFalse((self.folder / "run" / "energy.csv").exists())
        return text

    def test_overlap_at_the_start(self):
        self.refuse("colliding_disks",
                    ["At the start bodies overlap: the point (",
                     "of the contact 'disks'", "Move one of them away"],
                    "Disks/Distance=1.9")

    def test_time_schemes(self):
        """Conditions over a step, and gaps that are means over what is cut at its beginning."""
        for program in PARTS:
            for scheme in ("HHT", "TR-BDF2", "Crank-Nicolson", "ARKODE"):
                with self.subTest(f"{program} {scheme}"):
                    self.refuse(program,
                                ["cannot be combined with the time scheme "
                                 f"'{scheme}'", "midpoint"],
                                f"Time/Scheme={scheme}",
                                "Contact/Treatment=persistent contact")
        self.refuse("colliding_disks",
                    ["Contact/Coupling = mortar cannot be combined with the time "
                     "scheme 'HHT'", "Allowed with it: midpoint; or points"],
                    "Time/Scheme=HHT", "Contact/Treatment=Signorini active set",
                    "Contact/Coupling=mortar")

    def test_treatments_of_rigid_obstacles(self):
        """The sentence names what is allowed, and nothing else."""
        for program in PARTS:
            text = self.refuse(program,
                               ["The contact treatment 'Signorini multipliers'",
                                "Allowed"],
                               "Contact/Treatment=Signorini multipliers")
            allowed = text.split("Allowed")[1].split(": ")[1]
            self.assertEqual(sorted(allowed.rstrip(".").split(", ")),
                             sorted(PAIR_TREATMENTS))
            for treatment in ("Nitsche", "Nitsche-hybrid",
                              "proximal augmented Lagrangian"):
                with self.subTest(f"{program} {treatment}"):
                    self.refuse(program,
                                [f"the contact treatment '{treatment}' cannot be "
                                 "combined with Contact/Coupling = points",
                                 "Allowed with it: cut faces"],
                                f"Contact/Treatment={treatment}")

    def test_linear_solvers(self):
        self.refuse("colliding_disks",
                    ["Contact on cut faces cannot be condensed",
                     "direct, multigrid or automatic instead of condensed"],
                    *CutFaces.DISKS, "Contact/Treatment=Nitsche", "Contact/Nitsche gamma0=1e7",
                    "Linear solver/Type=condensed")

    def test_geometry(self):
        self.refuse("stent_artery",
                    ["The stent must not reach beyond the artery, from 0 to 20 mm",
                     "it lies from 9 to 21 mm"], "Geometry/Stent begin=9")
        self.refuse("stent_artery",
                    ["The gap between the stent and the artery must be positive"],
                    "Geometry/Gap=-0.01")
        self.refuse("stent_artery",
                    ["There must be at least 2 nodes along the artery; 1 were"],
                    "Geometry/Artery nodes along=1")
        for offset in (2.02, 3):
            self.refuse("colliding_disks",
                        [f"Disks/Offset = {offset} m must be smaller than "
                         "Disks/Distance = 2.02 m"], f"Disks/Offset={offset}")
        self.refuse("sliding_block",
                    ["The block would begin beyond the end of the strip",
                     "4.5 m is more than Strip/Length = 4 m"],
                    "Start/Position=3.5")

    def test_laws(self):
        self.refuse("colliding_disks",
                    ["'linear'", "does not go with the law", "Curnier"],
                    "Material/Viscosity=linear", "Material/Viscosity eta=1")

    def test_inverted_element_stops_the_run(self):
        """Pressed so hard that no step is short enough: all results up to then are
        there."""
        code, _, error = self.attempt(
            "stent_artery", COARSE_STENT + ["Deployment/Radial displacement=40",
                                            "Time/Maximum halvings=1"])
        self.assertEqual(code, 2, msg=error)
        text = " ".join(error.split())
        for message in ("The step from t = ", "after 1 halvings",
                        "turned inside out: det F = ", "in the cell around (",
                        "All results up to then are in the output folder"):
            self.assertIn(message, text)
        folder = self.folder / "run"
        self.assertGreaterEqual(len(Ledger(folder)["time"]), 2)
        for name in ("energy.h5", "checkpoint.bin", "log.txt"):
            self.assertTrue((folder / name).exists(), msg=name)


if __name__ == "__main__":
    main()
