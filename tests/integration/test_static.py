# SPDX-License-Identifier: LGPL-2.1-or-later
"""Static analyses, and runs that start from another one.

Numbers of other codes and of theory are in test_examples.py; here is what holds in each run: the
account, its order, and what is refused."""

import math

from common import *

STACK = ROOT / "examples" / "verification" / "stack.prm"
PATCH = ROOT / "examples" / "verification" / "patch_equal.prm"

STEPS = """
subsection Time
  set Scheme     = {scheme}
  set Final time = {end}
  set Time step  = {step}
end
subsection Output
  set Fields every     = 0
  set Checkpoint every = 1
end
"""

BLOCK = """
set Program   = ricochet
set Dimension = 2
subsection Body block
  set Shape         = rectangle
  set Size          = 1, 0.5
  set Cells along   = 8, 4
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 1000
end
{more}
""" + STEPS

FOOT = """
subsection Condition foot
  set Boundary = block: lower
  set Kind     = fixed
end
"""

PRESSED = FOOT + """
subsection Condition top
  set Boundary = block: upper
  set Kind     = displacement
  set Value    = 0; {value}
end
"""

RING = """
set Program   = ricochet
set Dimension = 2
subsection Body ring
  set Shape         = ring
  set Radius        = 2
  set Inner radius  = 1
  set Nodes around  = 48
  set Nodes across  = 9
  set Law           = neo-Hookean
  set Young modulus = 1000
  set Poisson ratio = 0.3
  set Density       = 1
end
subsection Condition inflation
  set Boundary = ring: inner
  set Kind     = pressure
  set Value    = t
end
subsection Probe inner
  set Body  = ring
  set Point = 1, 0
end
subsection Mesh
  set Degree = 2
end
subsection Time
  set Scheme     = {scheme}
  set Final time = {end}
  set Time step  = {step}
end
subsection Output
  set Fields every = 0
end
"""


PILE = """
set Program   = ricochet
set Dimension = 2
subsection Material rubber
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Body lower
  set Shape       = rectangle
  set Size        = 1, 0.5
  set Cells along = 8, 4
  set Material    = rubber
end
subsection Body upper
  set Shape       = rectangle
  set Size        = 1, 0.5
  set Cells along = 8, 4
  set Translation = 0, 0.5
  set Material    = rubber
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface   = lower: lower
  set Against   = floor
  set Treatment = {treatment}
end
subsection Contact joint
  set Surface   = upper: lower
  set Against   = lower: upper
  set Treatment = {treatment}
end
subsection Condition wall
  set Boundary   = lower: left; upper: left
  set Kind       = fixed
  set Components = x
end
subsection Start
  set Gravity = 0, -9.81
  {more}
end
""" + STEPS


# A shallow arch of thickness 0.02 whose middle line rises by 0.1 over a chord of 2.
ARCH_GEOMETRY = """
n = 20;
For k In {0:n}
  x = -1 + 2*k/n;
  Point(1 + k) = {x, 0.1*(1 - x*x) + 0.01, 0};
  Point(1001 + k) = {x, 0.1*(1 - x*x) - 0.01, 0};
  Line(2001 + k) = {1 + k, 1001 + k};
EndFor
For k In {1:n}
  Line(k) = {k, k + 1};
  Line(1000 + k) = {1000 + k, 1001 + k};
  Curve Loop(k) = {k, 2001 + k, -(1000 + k), -(2000 + k)};
  Plane Surface(k) = {k};
  Transfinite Surface {k};
  Recombine Surface {k};
EndFor
Transfinite Curve {1:n, 1001:1000 + n, 2001:2001 + n} = 2;
Physical Curve("top") = {1:n};
Physical Curve("feet") = {2001, 2001 + n};
Physical Surface("arch") = {1:n};
"""

ARCH = """
set Program   = ricochet
set Dimension = 2
subsection Body arch
  set File          = arch.geo
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Condition feet
  set Boundary = arch: feet
end
subsection Condition load
  set Boundary = arch: top
  set Kind     = traction
  set Value    = 0; -10*min(t,2-t)
end
subsection Probe middle
  set Body  = arch
  set Point = 0, 0.11
end
subsection Mesh
  set Degree = 2
end
subsection Output
  set Fields every = 0
end
"""


class Static(ProgramTest):

    def compute(self, text, folder="run", parameters=(), code=0, ranks=1):
        path = text
        if isinstance(text, str):
            path = self.folder / f"{folder}.prm"
            path.write_text(text, encoding="utf-8")
        found, out, err = self.attempt("ricochet", parameters, self.folder / folder, prm=path,
                                       options=["--overwrite"], n_ranks=ranks)
        self.assertEqual(found, code, msg=out + err)
        return Ledger(self.folder / folder) if code == 0 else " ".join(err.split())

    def test_the_account_of_a_path(self):
        """The works of a nonlinear body are those of the trapezoidal rule, whose error is the column of
        the numerical dissipation and falls with the square of the step; the energy balance is closed, and
        without it the work of the motion is the stored energy."""
        errors = []
        for step in (.25, .125):
            ledger = self.compute(PATCH, parameters=[
                "Condition top/Value=0; 0; -0.4*t", f"Time/Time step={step}",
                "Output/Fields every=0"])
            self.assertLess(largest(ledger["balance_residual"]), 1e-9)
            self.assertEqual(largest(ledger["kinetic_energy"]), 0.)
            stored = ledger["elastic_energy"][-1]
            errors.append(ledger["numerical_dissipation"][-1] / stored)
            self.assertAlmostEqual(ledger["imposed_work"][-1] / stored, 1. + errors[-1], places=9)
        self.assertLess(errors[0], .01)
        self.assertAlmostEqual(errors[0] / errors[1], 4., delta=.1)

    def test_pressures_that_follow(self):
        """A thick ring (Lame): its inner radius grows by 1.907e-3 for each unit of pressure at E = 1000, and
        a little more as it becomes thinner; in motion the work of the pressure closes the balance."""
        ledger = self.compute(RING.format(scheme="static", end=1, step=.5))
        self.assertAlmostEqual(ledger["inner_displacement_x"][-1] / 1.907e-3, 1., delta=5e-3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-9)
        # Newton's method with the right tangent.
        self.assertLess(max(ledger["newton_iterations"]), 30)
        for scheme in ("HHT", "TR-BDF2"):
            ledger = self.compute(RING.format(scheme=scheme, end=.2, step=.02))
            self.assertLess(largest(ledger["balance_residual"]), 1e-9)
            self.assertGreater(ledger["external_work"][-1], 0.)
            self.assertLess(max(ledger["newton_iterations"]), 12)

    def test_what_is_refused(self):
        block = BLOCK.format(more=FOOT, scheme="static", end=1, step=1)
        self.assertIn("has a velocity at the start",
                      self.compute(block, parameters=["Body block/Velocity=0, -1"], code=1))
        for more, name in (("", "Start/Gravity=0, -9.81"), (FOOT, None)):
            text = BLOCK.format(more=more, scheme="static", end=1, step=1)
            if name:
                message = self.compute(text, parameters=[name], code=2)
                self.assertIn("No support holds 'block'", message)
                self.assertIn("springs", message)
            else:
                self.compute(text)
        self.assertIn("in which nothing has inertia",
                      self.compute(STACK, parameters=["Time/Mass=redistributed"], code=1))
        self.assertIn("A condition over the whole step needs",
                      self.compute(STACK, parameters=["Contact floor/Treatment=persistent contact"],
                                   code=1))

    def test_rest_goes_on(self):
        """Bodies that a static analysis has brought to rest stay at rest, whatever scheme and treatment go on,
        on one rank and on two."""
        self.compute(STACK, "settled", ["Output/Checkpoint every=1"])
        names = ("floor", "lower joint", "upper joint")
        for scheme, ranks in (("midpoint", 1), ("midpoint", 2), ("TR-BDF2", 1), ("static", 1)):
            with self.subTest(scheme=scheme, ranks=ranks):
                ledger = self.compute(STACK, parameters=[
                    f"Start/From={self.folder / 'settled'}", f"Time/Scheme={scheme}",
                    "Time/Time step=2e-3", "Time/Final time=0.02"], ranks=ranks)
                self.assertLess(max(ledger["kinetic_energy"]), 1e-12)
                for name, mass in zip(names, (1500., 1000., 500.)):
                    for force in ledger[f"resultant_z_{name.replace(' ', '_')}"]:
                        self.assertAlmostEqual(force / (9.81 * mass), 1., places=6)

    def test_rest_goes_on_with_conditions(self):
        """The same with Signorini's condition, of a block on another one on a floor, and then persistent
        contact: multipliers and contact forces go on, and gaps of round-off do not release."""
        text = PILE.format(treatment="Signorini active set", scheme="static", step=1, end=1, more="")
        self.compute(text, "settled")
        # Conditions in 2D see rounded vertices at instants, and sharp ones over a step.
        for scheme, treatment, energy, force_off in (
                ("midpoint", "persistent contact", 1e-5, 1e-2),
                ("midpoint", "Signorini active set", 1e-5, 1e-2),
                ("TR-BDF2", "Signorini active set", 1e-12, 1e-6)):
            with self.subTest(scheme=scheme, treatment=treatment):
                ledger = self.compute(PILE.format(
                    treatment=treatment, scheme=scheme, step=2e-3, end=.02,
                    more=f"set From = {self.folder / 'settled'}"))
                self.assertLess(max(ledger["kinetic_energy"]), energy)
                for name, mass in (("floor", 1000.), ("joint", 500.)):
                    for force in ledger[f"resultant_y_{name}"]:
                        self.assertAlmostEqual(force / (9.81 * mass), 1., delta=force_off)

    def test_pressed_held_and_released(self):
        """A block is pressed, held as it is, and released: then it vibrates with the stored energy."""
        pressed = self.compute(BLOCK.format(more=PRESSED.format(value="-0.05*t"), scheme="static",
                                            end=1, step=.5), "pressed")
        stored = pressed["elastic_energy"][-1]
        before = [f"Start/From={self.folder / 'pressed'}"]
        held = self.compute(BLOCK.format(more=FOOT + FOOT.replace("foot", "top").replace(
            "lower", "upper"), scheme="midpoint", end=.01, step=1e-3), "held", before)
        for energy in held["energy"]:
            self.assertAlmostEqual(energy / stored, 1., places=10)
        self.assertLess(max(held["kinetic_energy"]), 1e-12 * stored)
        released = self.compute(BLOCK.format(more=FOOT, scheme="midpoint", end=.05, step=1e-3),
                                "released", before)
        for energy in released["energy"]:
            self.assertAlmostEqual(energy / stored, 1., places=10)
        self.assertGreater(max(released["kinetic_energy"]), .5 * stored)
        # Pressed on from where it is, or from elsewhere.
        on = self.compute(BLOCK.format(more=PRESSED.format(value="-0.05-0.05*t"), scheme="static",
                                       end=1, step=1), "on", before)
        self.assertGreater(on["elastic_energy"][-1], 3. * stored)
        self.assertIn("Begin its Value with the latter", self.compute(
            BLOCK.format(more=PRESSED.format(value="-0.02"), scheme="static", end=1, step=1),
            "elsewhere", before, code=1))
        self.assertIn("another Mesh/Degree", self.compute(
            BLOCK.format(more=FOOT, scheme="static", end=1, step=1), "other",
            before + ["Mesh/Degree=2"], code=1))
        self.assertIn("belongs to other bodies", self.compute(
            BLOCK.format(more=FOOT, scheme="static", end=1, step=1), "other",
            before + ["Body block/Cells along=4, 4"], code=1))
        self.assertIn("does not exist", self.compute(
            BLOCK.format(more=FOOT, scheme="static", end=1, step=1), "other",
            [f"Start/From={self.folder / 'nowhere'}"], code=1))

    def test_snap_through(self):
        """A shallow arch under a dead load that it cannot bear: the last resort finds the
        inverted state, in which the arch also comes to rest in motion with damping; without load
        it snaps back, and what was lost is the work of the load."""
        (self.folder / "arch.geo").write_text(ARCH_GEOMETRY)
        scene = self.folder / "arch.prm"
        scene.write_text(ARCH)
        static = self.run_program("ricochet", ["Time/Scheme=static", "Time/Final time=2",
                                               "Time/Time step=0.5"], prm=scene)
        there, back = static["time"].index(1.), len(static["time"]) - 1
        middle = static["middle_displacement_y"]
        self.assertLess(middle[there], -.1)
        self.assertAlmostEqual(middle[back], 0., delta=1e-9)
        self.assertIn(512, [int(value) & 512 for value in static["solver"]])
        self.assertGreater(static["external_work"][back], .1)
        self.assertAlmostEqual(static["numerical_dissipation"][back],
                               static["external_work"][back], delta=1e-9)
        moving = self.run_program(
            "ricochet", ["Time/Scheme=midpoint", "Time/Final time=9", "Time/Time step=0.05",
                         "Body arch/Mass damping=3", "Condition load/Value=0; -10"],
            prm=scene, folder=self.folder / "moving")
        self.assertAlmostEqual(moving["middle_displacement_y"][-1], middle[there], delta=1e-5)

    def test_resumed_digit_for_digit(self):
        text = BLOCK.format(more=PRESSED.format(value="-0.05*t"), scheme="static", end=1, step=.25)
        self.compute(text, "whole")
        self.compute(text, "parts", ["Time/Final time=0.5"])
        code, out, err = self.attempt("ricochet", (), self.folder / "parts",
                                      prm=self.folder / "whole.prm", options=["--resume"])
        self.assertEqual(code, 0, msg=out + err)
        self.assertEqual((self.folder / "whole" / "energy.csv").read_text(),
                         (self.folder / "parts" / "energy.csv").read_text())


if __name__ == "__main__":
    main()
