# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction, viscosity and contact of bodies in every scheme with stages.

A block slides down a slope, an obstacle or another body, in 2D and 3D, with exact and with
regularised friction: as a rigid body it has the acceleration g (sin - mu cos). A bar that
vibrates in its first mode with Kelvin and Voigt's viscosity loses the part exp(-delta) of its
amplitude in a period. Two disks that collide off their centres keep their momentum, and lose
energy and angular momentum to the second order of the step only; ARKODE, which controls its
error, keeps both to its tolerance. A ball with top spin is accelerated by mu times the impulse of its
bounce. Exact stick is that of the active sets with multipliers and the proximal augmented Lagrangian,
and tends to it with penalty and Nitsche's method.
"""

import math

from common import *

SLOPE = """
set Program   = ricochet
set Dimension = {dim}
subsection Material rubber
  set Law           = {law}
  set Young modulus = 1e7
  set Poisson ratio = 0.3
  set Density       = 1000
  set Viscosity     = {viscosity}
  set Viscosity eta = 1e4
end
subsection Body block
  set Shape       = {shape}
  set Size        = {size}
  set Cells along = {cells}
  set Material    = rubber
end
{slope}
subsection Contact slope
  set Surface                  = block: lower
  set Against                  = {against}
  set Treatment                = {treatment}
  set Friction coefficient     = 0.3
  set Tangential compliance    = 1e6
end
subsection Probe block
  set Body = block
end
subsection Start
  set Gravity = {gravity}
end
subsection Time
  set Final time = 1
  set Time step  = 4e-3
end
subsection Output
  set Fields every = 0
end
"""

OBSTACLE = """subsection Obstacle slope
  set Shape = half space
end"""

# A plate that is held, longer than the path of the block.
PLATE = """subsection Body plate
  set Shape       = {shape}
  set Size        = {size}
  set Cells along = {cells}
  set Translation = {translation}
  set Material    = rubber
end
subsection Condition plate
  set Boundary = plate
  set Kind     = fixed
end"""

# Two disks; the compliance is so smooth that an order of the step can be seen.
DISKS = """
set Program   = ricochet
set Dimension = 2
subsection Material rubber
  set Law           = neo-Hookean
  set Young modulus = 1e5
  set Density       = 1000
end
subsection Body a
  set Shape         = disk
  set Radius        = 0.5
  set Nodes around  = 16
  set Velocity      = 1, 0
  set Material      = rubber
end
subsection Body b
  set Shape         = disk
  set Radius        = 0.5
  set Nodes around  = 16
  set Rotation      = 0.1
  set Translation   = 1, 0.3
  set Velocity      = -1, 0
  set Material      = rubber
end
subsection Contact disks
  set Surface             = a
  set Against             = b
  set Treatment           = standard normal compliance
  set Compliance exponent = 3
end
subsection Time
  set Final time = 0.2
end
subsection Output
  set Fields every = 0
end
"""

# A bar, held at its left end, under a force with the shape of its first mode.
BAR = """
set Program   = ricochet
set Dimension = 2
subsection Body bar
  set Shape         = rectangle
  set Size          = 1, 0.1
  set Cells along   = 20, 1
  set Law           = {law}
  set Young modulus = 1e6
  set Plane state   = plane stress
  set Poisson ratio = {poisson}
  set Density       = 1000
  set Viscosity     = {viscosity}
  set Viscosity eta = {eta}
  set Mass damping  = {damping}
  set Acceleration  = 1e-2*sin(pi*x/2); 0
end
subsection Obstacle far
  set Shape       = half space
  set Translation = 0; -10
end
subsection Contact far
  set Surface   = bar: lower
  set Against   = far
  set Treatment = penalty
end
subsection Condition held
  set Boundary = bar: left
  set Kind     = fixed
end
subsection Probe end
  set Point = 1, 0.05
  set Body  = bar
end
subsection Time
  set Final time = 0.07
  set Time step  = 5e-4
end
subsection Output
  set Fields every = 0
end
"""

# A block on a belt, held by a spring of 360 N/m: m = 10 kg, omega = 6/s.
BELT = """
set Program   = ricochet
set Dimension = 2
subsection Body block
  set Shape         = rectangle
  set Size          = 0.2, 0.05
  set Cells along   = 8, 2
  set Law           = linear elastic
  set Young modulus = 1e8
  set Density       = 1000
  set Viscosity     = linear
  set Viscosity eta = 1e6
end
subsection Obstacle belt
  set Shape       = half space
  set Translation = 0.3*t; 0
end
subsection Contact belt
  set Surface               = block: lower
  set Against               = belt
  set Treatment             = penalty
  set Friction law          = slip-rate dependent
  set Static coefficient    = 0.4
  set Dynamic coefficient   = 0.2
  set Slip-rate decay       = 1000
  set Tangential compliance = 1e7
end
subsection Condition spring
  set Boundary   = block: left
  set Kind       = springs
  set Components = x
  set Stiffness  = 7200
end
subsection Probe block
  set Body = block
end
subsection Start
  set Gravity = 0, -9.81
end
subsection Time
  set Final time = 3
  set Time step  = 5e-4
end
subsection Output
  set Fields every = 0
end
"""

# A block falls on a floor, or its right half, whose left side is a plane of symmetry.
FALLING = """
set Program   = ricochet
set Dimension = {dim}
subsection Body block
  set Shape         = {shape}
  set Size          = {size}
  set Cells along   = {cells}
  set Translation   = {translation}
  set Velocity      = {velocity}
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface              = block: lower
  set Against              = floor
  set Friction coefficient = 0.2
end
{mirror}
subsection Time
  set Final time = 0.02
  set Time step  = 2e-4
end
subsection Output
  set Fields every = 0
end
"""

# A ball of 1 m thrown on a floor, its lowest point at -18 m/s along it, or at -1 m/s.
TOP_SPIN = """
set Program   = ricochet
set Dimension = {dim}
subsection Body ball
  set Shape         = {shape}
  set Radius        = 1
  set Mesh size     = {size}
  set Translation   = {translation}
  set Velocity      = {velocity}
  set Spin          = {spin}
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 100
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface              = ball
  set Against              = floor
  set Friction coefficient = 0.2
  {treatment}
end
subsection Probe ball
  set Body = ball
end
subsection Time
  set Final time = {end}
  set Time step  = 1e-3
end
subsection Output
  set Fields every = 0
end
"""

# A block, pressed on a floor and pushed along it, so that its rear slips and its front sticks.
PUSHED = """
set Program   = ricochet
set Dimension = 2
subsection Body block
  set Shape         = rectangle
  set Size          = 1, 0.5
  set Cells along   = {twice}, {once}
  set Law           = linear elastic
  set Plane state   = plane strain
  set Young modulus = 1e6
  set Poisson ratio = 0.3
  set Density       = 1000
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface              = block: lower
  set Against              = floor
  set Friction coefficient = 0.3
  {treatment}
end
subsection Condition top
  set Boundary   = block: upper
  set Kind       = displacement
  set Components = x, y
  set Value      = 0.003*t; -0.005*t
end
subsection Probe top
  set Body     = block: upper
  set Quantity = force
end
subsection Time
  set Scheme     = static
  set Final time = 1
  set Time step  = 0.25
end
subsection Output
  set Fields every = 0
end
"""

MIRROR = """
subsection Condition mirror
  set Boundary   = block: left
  set Kind       = fixed
  set Components = x
end
"""

WITH_STAGES = {name: values for name, values in SCHEMES.items() if name != "HHT -0.02"}

MATERIALS = (("linear elastic", "linear"), ("neo-Hookean", "Curnier"))


class EveryScheme(ProgramTest):

    def scene(self, name, text, **values):
        path = pathlib.Path(self.folder) / (name.replace(" ", "_") + ".prm")
        path.write_text(text.format(**values), encoding="utf-8")
        return path

    def slopes(self):
        """Scenes of a slope with tan = 1/2, linear in 2D and nonlinear in 3D; the slope is an
        obstacle or a body."""
        angle = math.atan(.5)
        along, down = 9.81 * math.sin(angle), -9.81 * math.cos(angle)
        shapes = {2: {"shape": "rectangle", "size": "1, 0.5", "cells": "4, 2",
                      "gravity": f"{along}, {down}"},
                  3: {"shape": "block", "size": "1, 0.5, 0.5", "cells": "3, 2, 2",
                      "gravity": f"{along}, 0, {down}"}}
        plates = {2: PLATE.format(shape="rectangle", size="3.3, 0.1", cells="11, 1",
                                  translation="-0.1, -0.1"),
                  3: PLATE.format(shape="block", size="3.3, 0.9, 0.1", cells="11, 3, 1",
                                  translation="-0.1, -0.2, -0.1")}
        for dim, shape in shapes.items():
            for treatment in ("Signorini active set", "penalty", "Signorini multipliers"):
                for is_body in (False, True):
                    if is_body and (treatment == "Signorini multipliers" or
                                    is_debug_build() and dim == 3):
                        continue
                    law, viscosity = MATERIALS[dim - 2]
                    name = f"{dim} {treatment} {law}" + " on a body" * is_body
                    yield name, self.scene(
                        name, SLOPE, dim=dim, treatment=treatment, law=law,
                        viscosity=viscosity, slope=plates[dim] if is_body else OBSTACLE,
                        against="plate: upper" if is_body else "slope", **shape)

    def runs(self, scenes, schemes=tuple(WITH_STAGES)):
        """(name, ledger) of each scene with each scheme."""
        def run(case):
            (name, scene), scheme = case
            return f"{name}, {scheme}", self.run_program(
                "ricochet", NO_FIELDS + WITH_STAGES[scheme],
                self.folder / f"{name}, {scheme}", prm=scene)
        with ThreadPoolExecutor(max_workers=2) as pool:
            yield from pool.map(run, ((scene, scheme) for scene in scenes
                                      for scheme in schemes))

    def check_run(self, ledger):
        self.assertLess(largest(ledger["balance_residual"]), 1e-9)
        self.assertEqual(ledger["step_halvings"][-1], 0)

    def test_slope(self):
        """A rigid block slides by 1/2 g (sin - mu cos) t^2, and friction takes mu m g cos
        times that."""
        angle = math.atan(.5)
        slides = .5 * 9.81 * (math.sin(angle) - .3 * math.cos(angle))
        for name, ledger in self.runs(self.slopes()):
            with self.subTest(name):
                self.check_run(ledger)
                self.assertAlmostEqual(ledger["block_displacement_x"][-1] / slides, 1.,
                                       delta=.01)
                mass = 250 if name.startswith("3") else 500
                self.assertAlmostEqual(
                    ledger["friction_work"][-1] /
                    (.3 * mass * 9.81 * math.cos(angle) * slides), 1., delta=.01)

    def test_damped_bar(self):
        """The first overshoot of an oscillator with the damping ratio eta omega / (2 E); with the
        elasticity tensor tau omega / 2, and in proportion to the mass alpha / (2 omega)."""
        omega, ratio = .5 * math.pi * math.sqrt(1e3), .1
        largest_displacement = 1e-2 / omega**2 * (
            1. + math.exp(-math.pi * ratio / math.sqrt(1. - ratio**2)))
        eta, none = 2e6 * ratio / omega, {"viscosity": "none", "eta": 0}
        # Curnier's power density is that of eta C_dot^2 = 4 eta strain_rate^2; tau is
        # eta (1 + nu) / E, whatever the strain across the bar.
        cases = {"linear": {"viscosity": "linear", "eta": eta},
                 "Curnier": {"viscosity": "Curnier", "eta": eta / 4., "law": "neo-Hookean"},
                 "elasticity tensor": {"viscosity": "Kelvin-Voigt", "eta": eta / 1.3,
                                       "poisson": .3},
                 "mass": {**none, "damping": 2. * ratio * omega, "poisson": .3},
                 "mass, large strains": {**none, "damping": 2. * ratio * omega,
                                         "law": "neo-Hookean"}}
        scenes = [(name, self.scene(name, BAR, **{"law": "linear elastic", "poisson": 0,
                                                  "damping": 0, **values}))
                  for name, values in cases.items()]
        for name, ledger in (*self.runs(scenes[:2]),
                             *self.runs(scenes[2:], ("midpoint", "TR-BDF2"))):
            with self.subTest(name):
                self.check_run(ledger)
                self.assertAlmostEqual(
                    max(ledger["end_displacement_x"]) / largest_displacement, 1., delta=.005)
                self.assertGreater(ledger["viscous_dissipation"][-1], 0.)

    def top_spin(self, name, dim, spin, treatment, end):
        axis, top = ("z", "0, 0, 1.02") if dim == 3 else ("y", "0, 1.02")
        return self.scene(
            name, TOP_SPIN, dim=dim, shape="ball" if dim == 3 else "disk",
            size=.5 if dim == 3 else .3, translation=top, end=end, treatment=treatment,
            velocity="2, 0, -4" if dim == 3 else "2, -4",
            spin=f"0, {spin}, 0" if dim == 3 else -spin), axis

    def test_top_spin(self):
        """While it slips, friction has mu times the impulse of the floor and the lever of the
        radius. In 3D points beside the lowest one do not slip along the plane of the ball's path,
        and CN and HHT, which let nodes jump on the floor, leave them in any direction."""
        for dim, treatment in ((2, "Signorini active set"), (2, "penalty"),
                               (3, "Signorini active set"), (3, "penalty")):
            name = f"spin {dim} {treatment}"
            scene, axis = self.top_spin(name, dim, 20, f"set Treatment = {treatment}", .1)
            schemes = tuple(WITH_STAGES) if dim == 2 else ("midpoint", "TR-BDF2")
            for scheme, ledger in self.runs([(name, scene)], schemes):
                with self.subTest(scheme):
                    self.check_run(ledger)
                    self.assertEqual(ledger["contact_force_floor"][-1], 0.)
                    along, across = (ledger[f"momentum_{c}"][-1] - ledger[f"momentum_{c}"][0]
                                     for c in ("x", axis))
                    self.assertAlmostEqual(along / across, .2, delta=1e-6 if dim == 2 else 1e-3)
                    # Angular momentum about the centre, from that about the origin.
                    sign = 1 if dim == 2 else -1
                    angular = ledger["angular_momentum" + "_y" * (dim == 3)]
                    spin = [sign * angular[n] - x * ledger[f"momentum_{axis}"][n] +
                            (1.02 + ledger[f"ball_displacement_{axis}"][n]) *
                            ledger["momentum_x"][n]
                            for n, x in ((k, ledger["ball_displacement_x"][k]) for k in (0, -1))]
                    self.assertAlmostEqual((spin[1] - spin[0]) / along, 1.,
                                           delta=.05 if dim == 2 else .15)

    def test_chattering_ball(self):
        """Nodes of a ball jump on the floor with CN, and cells become nearly flat: the work of their
        forces is integrated as exactly as that of others."""
        name = "chattering"
        scene, _ = self.top_spin(name, 3, 20, "set Treatment = Signorini active set", .12)
        for _, ledger in self.runs([(name, scene)], ("CN",)):
            self.assertLess(largest(ledger["balance_residual"]), 1e-11)

    def pushed(self, treatment, n):
        settings = f"set Treatment = {treatment}" + (
            "" if "active" in treatment else "\n  set Stick = exact")
        scene = self.scene(f"pushed {treatment} {n}", PUSHED, twice=2 * n, once=n,
                           treatment=settings)
        ledger = self.run_program("ricochet", [], scene.with_suffix(""), prm=scene)
        self.assertEqual(ledger["step_halvings"][-1], 0)
        return [ledger[name][-1] for name in ("top_force_x", "top_force_y", "friction_work")]

    def test_exact_stick(self):
        """Multipliers and the proximal augmented Lagrangian have the forces of active sets in nodes;
        the others tend to them with the size of the cells."""
        errors = {"Nitsche": [], "penalty": []}
        for n in (4, 8, 16):
            exact = self.pushed("Signorini active set", n)
            for treatment in ("Signorini multipliers", "proximal augmented Lagrangian",
                              *errors):
                with self.subTest(f"{treatment}, {n}"):
                    relative = [abs(value / right - 1.) for value, right in
                                zip(self.pushed(treatment, n), exact)]
                    if treatment in errors:
                        errors[treatment].append(relative)
                    else:
                        self.assertLess(max(relative), 1e-9)
        for treatment, of_sizes in errors.items():
            orders = [math.log2(coarse / fine) for coarse, fine in
                      zip(of_sizes[0], of_sizes[2]) if fine > 1e-4]
            print(treatment, of_sizes, orders)
            with self.subTest(treatment):
                # Over two halvings of the cells: 2 for forces, and 1 and 2 for the work of
                # friction at the ends of contact.
                self.assertGreater(min(orders), .9)

        for spin in (3, 20):
            ledgers = {}
            for treatment in ("Signorini active set", "Signorini multipliers"):
                name = f"dynamic {spin} {treatment}"
                scene, _ = self.top_spin(
                    name, 2, spin, f"set Treatment = {treatment}" +
                    ("" if "active" in treatment else "\n  set Stick = exact"), .04)
                for scheme, ledger in self.runs([(name, scene)], ("midpoint", "TR-BDF2")):
                    self.check_run(ledger)
                    ledgers[treatment, scheme.split(", ")[1]] = ledger
            for scheme in ("midpoint", "TR-BDF2"):
                one, other = (ledgers[treatment, scheme] for treatment in
                              ("Signorini active set", "Signorini multipliers"))
                for column in ("kinetic_energy", "friction_work", "impulse_x_floor"):
                    self.assertLess(max(abs(a - b) for a, b in zip(one[column], other[column])),
                                    1e-9 * max(map(abs, one[column])), msg=f"{spin} {scheme}")

    def falling(self, dim, is_half):
        """The scene, the block 0.2 wide or its right half."""
        width, left = (.1, 0.) if is_half else (.2, -.1)
        n = (4 if is_half else 8) if dim == 2 else (2 if is_half else 4)
        values = {2: {"shape": "rectangle", "size": f"{width}, 0.1", "cells": f"{n}, 4",
                      "translation": f"{left}, 0.001", "velocity": "0, -1"},
                  3: {"shape": "block", "size": f"{width}, 0.1, 0.1", "cells": f"{n}, 2, 2",
                      "translation": f"{left}, 0, 0.001", "velocity": "0, 0, -1"}}[dim]
        return self.scene(f"falling {dim} {is_half}", FALLING, dim=dim,
                          mirror=MIRROR if is_half else "", **values)

    def test_what_friction_gives_back(self):
        """With forces at instants friction can do work on the body, and the run says so."""
        parameters = BALL + NO_FIELDS + [
            "Start/Initial velocity=6, -10", "Contact/Treatment=Signorini active set",
            "Contact/Friction coefficient=0.3", "Time/Final time=0.1"]
        for scheme, gives_back in (("HHT 0.05", True), ("midpoint", False)):
            with self.subTest(scheme):
                code, out, error = self.attempt("elastic_ball", parameters + SCHEMES[scheme],
                                                self.folder / scheme.replace(" ", "_"))
                self.assertEqual(code, 0, msg=error)
                self.assertEqual("friction and viscosity gave back at most" in out,
                                 gives_back, msg=out)
                work = Ledger(self.folder / scheme.replace(" ", "_"))["friction_work"]
                falls = max(a - b for a, b in zip(work, work[1:]))
                self.assertEqual(falls > 1e-9 * max(work), gives_back)

    def test_half_of_a_symmetric_body(self):
        """Nodes in contact that a plane of symmetry holds across: half of the whole."""
        treatments = KEEP_ENERGY + ["improved normal compliance", "Signorini active set",
                                    "Signorini multipliers", "standard normal compliance"]
        for dim in (2, 3):
            for treatment in treatments:
                whole, half = (
                    self.run_program("ricochet",
                                     NO_FIELDS + [f"Contact floor/Treatment={treatment}"],
                                     prm=self.falling(dim, is_half))
                    for is_half in (False, True))
                for name in ("elastic_energy", "kinetic_energy", "friction_work",
                             "contact_force_floor"):
                    with self.subTest(f"{dim} {treatment} {name}"):
                        scale = largest(whole[name])
                        self.assertGreater(scale, 0.)
                        self.assertLess(largest(
                            [2. * a - b for a, b in zip(half[name], whole[name])]),
                            1e-9 * scale)

    def test_stick_slip(self):
        """A coefficient that falls with the slip rate makes jerks, whose period is that
        of the closed solution for a static and a dynamic coefficient."""
        velocity, omega = .3, 6.
        force = (.4 - .2) * 10. * 9.81
        ratio = force * omega / (360. * velocity)
        period = (2. * force / (360. * velocity) +
                  2. * (math.pi - math.atan(ratio)) / omega)
        cases = [("midpoint", ["Contact belt/Treatment=improved normal compliance"]),
                 ("HHT 0.05", []), ("BDF2", [])]
        for scheme, treatment in cases[1:2] if is_debug_build() else cases:
            with self.subTest(scheme):
                ledger = self.run_program("ricochet",
                                          NO_FIELDS + SCHEMES[scheme] + treatment,
                                          prm=self.scene("belt", BELT))
                self.assertLess(largest(ledger["balance_residual"]), 1e-9)
                # Where the coefficient falls steeply a step may have no solution near by.
                self.assertLessEqual(ledger["step_halvings"][-1], 4)
                u, t = ledger["block_displacement_x"], ledger["time"]
                peaks = [t[k] for k in range(1, len(u) - 1)
                         if u[k - 1] < u[k] >= u[k + 1] > .1]
                self.assertGreaterEqual(len(peaks), 2)
                for first, second in zip(peaks, peaks[1:]):
                    self.assertAlmostEqual((second - first) / period, 1., delta=.01)

    def test_small_strains_beside_large_ones(self):
        """A linear elastic disk hits a hyperelastic one: total energy and momentum are kept, on two
        ranks, too, and with slow disks and small strains it is what two linear ones do, or two of
        Saint Venant and Kirchhoff's."""
        def with_laws(first, second):
            text = DISKS.replace("set Law           = neo-Hookean",
                                 "set Law           = " + second)
            return text.replace("  set Velocity      = 1, 0\n  set Material      = rubber",
                                "  set Velocity      = 1, 0\n  set Material      = other") + (
                "subsection Material other\n  set Law           = " + first +
                "\n  set Young modulus = 1e5\n  set Density       = 1000\nend\n")
        kept = ["Contact disks/Treatment=improved normal compliance"]
        mixed = self.scene("mixed", with_laws("linear elastic", "neo-Hookean"))
        one = self.run_program("ricochet", NO_FIELDS + kept, self.folder / "mixed", prm=mixed)
        def changes(column):
            return [value - one[column][0] for value in one[column]]
        self.assertLess(largest(changes("total_energy")), 1e-11 * one["total_energy"][0])
        self.assertLess(largest(one["balance_residual"]), 1e-11)
        self.assertLess(largest(changes("momentum_x")), 1e-9)
        self.assertGreater(max(one["contact_force_disks"]), 0.)
        self.assertEqual(one["step_halvings"][-1], 0)
        two = self.run_program("ricochet", NO_FIELDS + kept, self.folder / "two", prm=mixed,
                               n_ranks=2)
        self.assertLess(largest([a - b for a, b in zip(one["kinetic_energy"],
                                                       two["kinetic_energy"])]),
                        1e-9 * one["total_energy"][0])
        slow = kept + ["Body a/Velocity=1e-3, 0", "Body b/Velocity=-1e-3, 0",
                       "Body b/Translation=1.0001, 0"]
        laws = ("linear elastic", "Saint Venant-Kirchhoff")
        energies = [
            self.run_program("ricochet", NO_FIELDS + slow, self.folder / f"slow-{n}",
                             prm=self.scene(f"slow-{n}", with_laws(*pair)))["kinetic_energy"]
            for n, pair in enumerate((laws, (laws[0],) * 2, (laws[1],) * 2))]
        for others in energies[1:]:
            self.assertLess(largest([a - b for a, b in zip(energies[0], others)]),
                            1e-3 * energies[0][0])

    def test_colliding_disks(self):
        scene = self.scene("disks", DISKS)

        def run(scheme, step):
            ledger = self.run_program(
                "ricochet", NO_FIELDS + scheme + [f"Time/Time step={step}"],
                self.folder / f"{scheme[0]} {step}".replace("/", " "), prm=scene)
            self.assertEqual(ledger["step_halvings"][-1], 0)
            return ledger

        def change(ledger, column):
            return abs(ledger[column][-1] - ledger[column][0]) / abs(ledger[column][0])

        exact = run(["Time/Scheme=ARKODE"], 2e-3)
        # Both are larger than what the schemes below lose of them.
        self.assertLess(min(exact["kinetic_energy"]), .8 * exact["kinetic_energy"][0])
        for column in ("total_energy", "angular_momentum"):
            self.assertLess(change(exact, column), 1e-9)
        for name, scheme in WITH_STAGES.items():
            # It keeps both, except for the energy that standard normal compliance takes.
            if name == "midpoint":
                continue
            coarse, fine = run(scheme, 2e-3), run(scheme, 1e-3)
            for ledger in (coarse, fine):
                self.assertLess(max(largest(ledger["momentum_x"]),
                                    largest(ledger["momentum_y"])), 1e-9 * 785.)
                self.assertLess(largest(ledger["balance_residual"]), 1e-11)
            for column in ("total_energy", "angular_momentum"):
                with self.subTest(f"{name} {column}"):
                    self.assertLess(change(fine, column), 5e-3 if "momentum" in column
                                    else 2e-4)
                    self.assertGreater(change(coarse, column), 3. * change(fine, column))
            for column in ("kinetic_energy_a", "elastic_energy_b"):
                self.assertAlmostEqual(fine[column][-1] / exact[column][-1], 1., delta=.01)


if __name__ == "__main__":
    main()
