# SPDX-License-Identifier: LGPL-2.1-or-later
"""Promises of contact treatments for the energy: kept where nodes meet nodes and ends meet ends; a
broken promise, a dropped point and a passage through a body are reported."""

import math
import sys
import warnings

from common import *

sys.path.insert(0, str(ROOT / "python"))

# Rows of equal blocks, whose nodes and ends meet, with gravity from the start.
BLOCKS = """
set Program   = ricochet
set Dimension = {dim}
{bodies}
{contacts}
{more}
subsection Time
  set Final time = {end}
  set Time step  = {step}
end
subsection Output
  set Fields every = 0
  set Log every    = 0
end
"""

BLOCK = """
subsection Body {name}
  set Shape         = {shape}
  set Size          = {size}
  set Cells along   = {cells}
  set Translation   = {place}
  set Velocity      = {velocity}
  set Law           = neo-Hookean
  set Young modulus = {young}
  set Density       = 1000
end
"""

CONTACT = """
subsection Contact {name}
  set Surface   = {first}
  set Against   = {second}
  set Treatment = {treatment}
end
"""

FOOT = """
subsection Condition foot
  set Boundary = {boundary}
  set Kind     = fixed
end
"""

GRAVITY = """
subsection Start
  set Gravity = {gravity}
end
"""


def block(name, place, velocity="0, 0", size="1, 1", cells="2, 2", young="1e6"):
    return BLOCK.format(name=name, place=place, velocity=velocity, size=size, cells=cells,
                        young=young, shape="rectangle" if size.count(",") == 1 else "block")


class Promises(ProgramTest):

    def scene(self, bodies, contacts, more="", dim=2, end=1., step=4e-3):
        file = self.folder / "scene.prm"
        file.write_text(BLOCKS.format(dim=dim, bodies="".join(bodies),
                                      contacts="".join(contacts), more=more, end=end,
                                      step=step))
        return file

    def run_scene(self, file, code=0, parameters=()):
        found, out, err = self.attempt("ricochet", parameters, prm=file,
                                       options=["--overwrite"])
        self.assertEqual(found, code, msg=out + err)
        return Ledger(self.folder / "run"), err

    def contact(self, treatment, first="upper: lower", second="lower: upper", name="joint"):
        return CONTACT.format(name=name, first=first, second=second, treatment=treatment)

    def test_stacks_of_equal_blocks(self):
        """Three equal blocks on each other gained 231 kJ as their border nodes were released and
        captured again; a treatment must keep 1e-9 of its largest energy, about 2e4 J."""
        bodies = [block(f"b{k}", f"0, {.5 * k}", size="1, 0.5", cells="4, 2")
                  for k in range(3)]
        for treatment in ("improved normal compliance", "standard normal compliance",
                          "Signorini active set"):
            with self.subTest(treatment=treatment):
                contacts = [self.contact(treatment, f"b{k}: lower", f"b{k - 1}: upper",
                                         f"c{k}") for k in (1, 2)]
                file = self.scene(bodies, contacts, FOOT.format(boundary="b0: lower") +
                                  GRAVITY.format(gravity="0, -9.81"), end=.4)
                ledger, _ = self.run_scene(file)
                self.assertLess(max(ledger["promise_residual"]), 1e-9)
                self.assertGreater(max(ledger["contact_force_c1"]), 100.)

    def test_a_stack_comes_to_rest(self):
        """With viscosity what lies on a joint is its force: by hand 5000 N and 10000 N on two blocks
        of 500 kg with 10 m/s2. With the consistent mass it alternates from step to step."""
        bodies = [block(f"b{k}", f"0, {.5 * k}", size="1, 0.5", cells="8, 4").replace(
            "set Velocity", "set Viscosity = Curnier\n  set Viscosity eta = 1e4\n  set Velocity")
            for k in range(3)]
        contacts = [self.contact("persistent contact", f"b{k}: lower", f"b{k - 1}: upper",
                                 f"c{k}") for k in (1, 2)]
        file = self.scene(bodies, contacts, FOOT.format(boundary="b0: lower") +
                          GRAVITY.format(gravity="0, -10"), end=4., step=1e-2)
        found, out, err = self.attempt("ricochet", ["Time/Mass=redistributed"], prm=file,
                                       options=["--overwrite"])
        self.assertEqual(found, 0, msg=out + err)
        ledger = Ledger(self.folder / "run")
        self.assertLess(max(ledger["promise_residual"]), 1e-9)
        for number, weight in ((1, 1e4), (2, 5e3)):
            self.assertLess(abs(ledger[f"contact_force_c{number}"][-1] / weight - 1.), 1e-6)

    def test_cubes_that_meet_face_to_face(self):
        """Nodes that meet nodes, and nodes that meet the diagonals of quadrilaterals: equal cubes
        went apart with 1097 of 1000 J, and with sharp edges 2e-6 of it still changed; against a
        wider cube Newton's method failed. By hand it is 1000 J, and the velocities are exchanged."""
        size, cells = "1, 1, 1", "3, 3, 3"
        for other, place, momentum in (("1, 1, 1", "1.01, 0, 0", 1000.),
                                       ("1, 1.5, 1.5", "1.01, -0.25, -0.25", 2250.)):
            with self.subTest(other):
                bodies = [block("a", "0, 0, 0", "1, 0, 0", size, cells),
                          block("b", place, "-1, 0, 0", other, cells)]
                contacts = [self.contact("improved normal compliance", "a: right", "b: left")]
                ledger, _ = self.run_scene(
                    self.scene(bodies, contacts, dim=3, end=.12, step=2e-3))
                self.assertLess(max(ledger["promise_residual"]), 1e-11)
                self.assertEqual(ledger["step_halvings"][-1], 0)
                self.assertAlmostEqual(ledger["momentum_x_b"][0], -momentum, places=6)
                self.assertAlmostEqual(ledger["momentum_x_a"][-1] + ledger["momentum_x_b"][-1],
                                       1000. - momentum, places=6)
                self.assertLess(ledger["momentum_x_a"][-1], 0.)

    def test_a_broken_promise_is_told(self):
        """A disk that is shot at the outside of a ring from within enters behind its facets, with a
        potential without work done for it."""
        file = self.folder / "wrong_side.prm"
        file.write_text("""
set Program   = ricochet
set Dimension = 2
subsection Body ring
  set Shape        = ring
  set Radius       = 1
  set Inner radius = 0.9
  set Nodes around = 64
  set Nodes across = 3
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Body disk
  set Shape        = disk
  set Radius       = 0.3
  set Nodes around = 32
  set Velocity     = 3, 0
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Contact wrong side
  set Surface   = disk
  set Against   = ring: outer
  set Treatment = improved normal compliance
end
subsection Time
  set Final time = 0.29
  set Time step  = 5e-3
end
subsection Output
  set Fields every = 0
end
""")
        ledger, err = self.run_scene(file, code=4)
        self.assertIn("THE PROMISE IS BROKEN", err)
        self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-9)
        log = (self.folder / "run" / "log.txt").read_text()
        self.assertRegex(log, r"note: the promise is broken at t = \S+ s by the contact "
                              r"'wrong_side', which keeps: in this step it has made \S+ J.*"
                              r"undeformed body 'disk'.*behind a facet: \d+")
        self.assertGreater(ledger["entered_points_wrong_side"][-1], 0.)
        self.check_python_package(file)
        # All that the total gains is of this contact.
        gain = ledger["contact_gain_wrong_side"][-1]
        self.assertAlmostEqual(gain / (ledger["total_energy"][-1] -
                                       ledger["total_energy"][0]), 1., places=6)

    def check_python_package(self, file):
        try:
            import ricochet
        except ImportError:
            return
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            run = ricochet.run(program_path("ricochet"), file,
                               output=self.folder / "package")
        self.assertTrue(run.is_open)
        self.assertEqual([w.category for w in caught if w.category is ricochet.OpenRun],
                         [ricochet.OpenRun])
        self.assertGreater(run.summary().largest_promise_residual, 1e-3)

    def test_the_documentation_has_the_table(self):
        code, out, _ = self.attempt_without_folder("--promises")
        self.assertEqual(code, 0)
        page = (ROOT / "doc" / "methods" / "promises.md").read_text()
        self.assertIn(out, page)
        self.assertIn("| improved normal compliance | keeps |", out)

    def attempt_without_folder(self, *words):
        result = subprocess.run([program_path("ricochet"), *words], capture_output=True,
                                text=True, timeout=60)
        return result.returncode, result.stdout, result.stderr

    def test_what_is_dropped_is_counted(self):
        """A block slides off the end of another one: nodes with a constraint are released while
        pressed."""
        bodies = [block("lower", "0, 0", size="1, 0.25", cells="4, 1"),
                  block("upper", "0.5, 0.25", "2, 0", size="0.5, 0.25", cells="2, 1")]
        file = self.scene(bodies, [self.contact("persistent contact")],
                          FOOT.format(boundary="lower: lower") +
                          GRAVITY.format(gravity="0, -9.81"), end=.2)
        ledger, _ = self.run_scene(file)
        self.assertGreater(ledger["dropped_points_joint"][-1], 0.)
        self.assertLess(max(ledger["promise_residual"]), 1e-9)

    def test_over_the_end_of_a_table(self):
        """A block slides off a table, or onto another one that is a little lower, and a table of
        nodes comes out from under it: a law loses and gains its points with no energy (with a
        point that counts up to half a facet of overhang, 0.2 of it were made in ironing). In the
        air the block falls as by hand, at -9.81 m/s^2, and keeps its angular momentum."""
        def sized(numbers, dim):
            return ", ".join(numbers if dim == 3 else (numbers[0], numbers[2]))

        for dim, treatment, way in ((2, "improved normal compliance", "off"),
                                    (2, "penalty", "on"),
                                    (3, "improved normal compliance", "on"),
                                    (3, "standard normal compliance", "out")):
            with self.subTest(dim=dim, treatment=treatment, way=way):
                def table(name, place, dim=dim):
                    return block(name, sized(place, dim), sized("000", dim),
                                 sized(("1", "1", "0.25"), dim), sized("431", dim))

                bodies = [table("left", "000"),
                          block("sled", sized((".6", ".03", ".251"), dim), sized("200", dim),
                                sized((".5", ".5", ".25"), dim), sized("321", dim))]
                first, second, held = "sled: lower", "left: upper", "left: lower"
                if way == "on":
                    bodies.append(table("right", ("1.2", "0", "-.005")))
                    second, held = "left: upper; right: upper", held + "; right: lower"
                elif way == "out":
                    first, second = second, first
                file = self.scene(bodies, [self.contact(treatment, first, second)],
                                  FOOT.format(boundary=held) +
                                  GRAVITY.format(gravity=sized(("0", "0", "-9.81"), dim)),
                                  dim=dim, end=.45, step=3e-3)
                ledger, _ = self.run_scene(file)
                self.assertLess(max(ledger["promise_residual"]), 1e-11)
                self.assertEqual(ledger["step_halvings"][-1], 0)
                self.assertEqual(ledger["dropped_points_joint"][-1], 0)
                self.assertEqual(ledger["entered_points_joint"][-1], 0)
                self.assertGreater(max(ledger["contact_force_joint"]), 100.)
                force = ledger["contact_force_joint"][-10:]
                if way == "on":
                    self.assertGreater(max(force), 0.)
                    continue
                self.assertEqual(set(force), {0.})
                mass, up = 1000. * .125 * (.5 if dim == 3 else 1.), "xyz"[dim - 1]
                momentum = ledger[f"momentum_{up}_sled"]
                self.assertAlmostEqual((momentum[-1] - momentum[-10]) /
                                       (-9.81 * mass * 9 * 3e-3), 1., places=10)

    def test_corners_between_nodes(self):
        """A small block falls onto the middle of one cell of a plate, whose nodes are the points of
        the contact and are beside it: its corners (and, in 3D, edges) meet the cell. Its
        upward momentum after the impact is at least half of the one before, and the columns
        count all forces, once."""
        for dim, treatment, more in ((2, "Signorini active set", ()),
                                     (2, "persistent contact",
                                      ("Contact joint/Friction coefficient=0.2",)),
                                     (2, "persistent contact",
                                      ("Contact joint/Coupling=mortar",)),
                                     (3, "persistent contact", ()),
                                     (3, "penalty", ())):
            with self.subTest(dim=dim, treatment=treatment, more=more):
                size = 0.3
                bodies = [block("plate", "0, -0.25" if dim == 2 else "0, 0, -0.25",
                                size="1, 0.25" if dim == 2 else "1, 1, 0.25",
                                cells="1, 1" if dim == 2 else "1, 1, 1", young="1e7",
                                velocity="0, 0" if dim == 2 else "0, 0, 0"),
                          block("block", "0.3, 0.005" if dim == 2 else "0.3, 0.32, 0.005",
                                "0, -1" if dim == 2 else "0, 0, -1",
                                f"{size}, {size}" if dim == 2 else f"{size}, {size}, {size}",
                                "2, 2" if dim == 2 else "2, 2, 2")]
                file = self.scene(bodies, [self.contact(treatment, "plate: upper",
                                                        "block: lower")],
                                  FOOT.format(boundary="plate: lower"), dim=dim, end=.06,
                                  step=1e-3)
                ledger, _ = self.run_scene(file, parameters=more)
                self.assertLess(max(ledger["promise_residual"]), 1e-9)
                self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-9)
                momentum = ledger["momentum_" + "xyz"[dim - 1] + "_block"]
                mass = 1000. * size ** dim
                self.assertAlmostEqual(momentum[0], -mass, places=6)
                self.assertGreater(momentum[-1], .5 * mass)
                # Force and penetration of corners are in the columns of the contact.
                self.assertGreater(max(ledger["contact_force_joint"]), 100.)
                self.assertGreater(max(ledger["penetration_joint"]), 0.)
                self.assertLess(max(ledger["penetration_joint"]), .02)
                # On the plate, so that it is minus the change of the block's momentum.
                impulse = ledger["impulse_" + "xyz"[dim - 1] + "_joint"][-1]
                self.assertAlmostEqual(impulse / (momentum[0] - momentum[-1]), 1., places=9)
                # The normal forces of corners are counted once.
                normal = sum(ledger["contact_force_joint"]) * 1e-3
                self.assertAlmostEqual(normal / -impulse, 1., places=2)

    def test_edges_that_cross(self):
        """Two square bars cross each other at a right angle, edge towards edge, between their
        nodes: they passed through each other. The one that comes with 1 m/s is nearly
        stopped, and the other one, of the same mass, set off."""
        def bar(name, along, angle, axis, height, velocity):
            size = ", ".join("0.3" if k == along else "0.1" for k in range(3))
            cells = ", ".join("3" if k == along else "1" for k in range(3))
            place = ", ".join(str(x) for x in [-.15 if k == along else 0. for k in range(2)] +
                              [height])
            return block(name, place, velocity, size, cells, "1e7").replace(
                "end\n", f"  set Rotation = {angle}\n  set Rotation axis = {axis}\nend\n")

        half = .1 * math.sqrt(.5)
        bodies = [bar("below", 0, .25 * math.pi, "1, 0, 0", -half, "0, 0, 0"),
                  bar("above", 1, -.25 * math.pi, "0, 1, 0", half + .002, "0, 0, -1")]
        file = self.scene(bodies, [self.contact("persistent contact", "above", "below")], dim=3,
                          end=.03, step=5e-4)
        ledger, _ = self.run_scene(file)
        self.assertLess(max(ledger["promise_residual"]), 1e-9)
        self.assertAlmostEqual(ledger["momentum_z"][-1], -3., places=9)
        self.assertLess(ledger["momentum_z_below"][-1], -2.5)
        self.assertEqual(ledger["contact_force_joint"][-1], 0.)
        ledger, _ = self.run_scene(file, parameters=("Contact joint/Corners=false",
                                                     "Time/Final time=0.015"))
        self.assertEqual(ledger["momentum_z_below"][-1], 0.)

    def test_a_disk_hits_a_corner(self):
        """A stiff disk falls onto the corner of a held plate, 30 degrees off its middle, with a
        facet whose normal is 30.94 degrees off the vertical: as a billiard ball off a point
        it leaves at twice this angle."""
        file = self.folder / "corner.prm"
        file.write_text("""
set Program   = ricochet
set Dimension = 2
subsection Body disk
  set Shape        = disk
  set Radius       = 0.1
  set Nodes around = 64
  set Translation  = 0.05, 0.0867
  set Velocity     = 0, -1
  set Law           = neo-Hookean
  set Young modulus = 1e9
  set Poisson ratio = 0.3
  set Density       = 1000
end
subsection Body plate
  set Shape       = rectangle
  set Size        = 0.5, 0.1
  set Cells along = 10, 2
  set Translation = -0.5, -0.1
  set Law           = neo-Hookean
  set Young modulus = 1e11
  set Density       = 1000
end
subsection Condition held
  set Boundary = plate
  set Kind     = fixed
end
subsection Contact corner
  set Surface = disk
  set Against = plate
end
subsection Time
  set Final time = 1.6e-3
  set Time step  = 2e-5
end
subsection Output
  set Fields every = 0
end
""")
        ledger, _ = self.run_scene(file, parameters=("Contact corner/Treatment="
                                                     "persistent contact",))
        self.assertLess(max(ledger["promise_residual"]), 1e-9)
        self.assertEqual(ledger["contact_force_corner"][-1], 0.)
        x, y = ledger["momentum_x_disk"][-1], ledger["momentum_y_disk"][-1]
        self.assertAlmostEqual(math.degrees(math.atan2(x, y)), 2. * 30.94, delta=2.)
        self.assertGreater(math.hypot(x, y) / abs(ledger["momentum_y_disk"][0]), .95)

    def test_nothing_is_gone_through(self):
        """A fast block and a thin plate: it passes through in a step of 50 ms, and in its middle
        the block is still in front, so that there is no pressure."""
        bodies = [block("plate", "-1, -0.1", size="2, 0.1", cells="20, 2", young="1e7"),
                  block("block", "-0.1, 0.3", "0, -10", "0.2, 0.2", "4, 4", "1e7")]
        contacts = [self.contact("persistent contact", "block: lower", "plate: upper",
                                 "hit")]
        file = self.scene(bodies, contacts, FOOT.format(boundary="plate: left, right"),
                          end=.1, step=5e-2)
        ledger, _ = self.run_scene(file)
        self.assertGreater(ledger["passing_halvings"][-1], 0.)
        self.assertEqual(ledger["passed_points_hit"][-1], 0.)
        # -400 kg m/s before.
        self.assertGreater(ledger["momentum_y_block"][-1], -100.)
        _, err = self.run_scene(file, 2, ["Time/Maximum halvings=0"])
        self.assertIn("go through the contact 'hit' without touching it", err)

    def test_no_post_is_gone_through(self):
        """As above with a thin rigid post, at rest and moving towards the block."""
        post = """
subsection Obstacle post
  set Shape       = circle
  set Radius      = 0.02
  set Centre      = {centre}
  set Translation = {motion}
end
subsection Contact hit
  set Surface   = block
  set Against   = post
  set Treatment = penalty
end
"""
        for velocity, motion in (("0, -10", "0; 0"), ("0, 0", "0; 10*t")):
            with self.subTest(motion=motion):
                file = self.scene([block("block", "-0.1, 0.1", velocity, "0.2, 0.2", "4, 4",
                                         "1e7")], [],
                                  post.format(centre="0, 0", motion=motion),
                                  end=.1, step=5e-2)
                ledger, _ = self.run_scene(file,
                                           parameters=["Time/Maximum halvings=8"])
                self.assertGreater(ledger["passing_halvings"][-1], 0.)
                self.assertEqual(ledger["passed_points_hit"][-1], 0.)

    def test_held_boundaries_stay_where_they_are(self):
        """Iterative solvers left their tolerance in clamped unknowns: a rubber ring (nu =
        0.4995) on its hub did 0.5 % of its energy as work that was in no balance."""
        file = self.folder / "roller.prm"
        file.write_text("""
set Program   = ricochet
set Dimension = 2
set Units     = mm, t, s
subsection Body roller
  set Shape        = ring
  set Radius       = 40
  set Inner radius = 20
  set Nodes around = 128
  set Nodes across = 9
  set Translation  = 0, 40
  set Law           = neo-Hookean
  set Young modulus = 1.4
  set Poisson ratio = 0.4995
  set Density       = 1.2e-9
  set Viscosity     = Curnier
  set Viscosity eta = 1e-3
end
subsection Obstacle floor
  set Shape       = half space
  set Translation = 0; 4*(1-cos(pi*t/0.1))/2
end
subsection Contact floor
  set Surface   = roller: outer
  set Against   = floor
  set Treatment = improved normal compliance
end
subsection Condition hub
  set Boundary = roller: inner
  set Kind     = fixed
end
subsection Probe hub
  set Body  = roller
  set Point = 20, 40
end
subsection Time
  set Final time = 4e-3
  set Time step  = 1e-3
end
subsection Output
  set Fields every = 0
end
""")
        ledger, _ = self.run_scene(file)
        self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-7)
        for axis in "xy":
            self.assertEqual(set(ledger[f"hub_displacement_{axis}"]), {0.})

    def test_held_first_surfaces_touch(self):
        """A block fell through a floor that is held as a whole and is the first surface of
        the contact. It comes back with 1000 of 1000 J, whichever points the treatment
        has; two nodes at one place between the pieces are one constraint twice."""
        bodies = [block("block", "-0.5, 0.01", "0, -1", cells="3, 3"),
                  block("ice", "-1, -0.5", size="1, 0.5", cells="4, 2"),
                  block("tar", "0, -0.5", size="1, 0.5", cells="4, 2")]
        held = FOOT.format(boundary="ice; tar")
        floor = "ice: upper; tar: upper"
        for treatment, coupling in (("Signorini active set", "points"),
                                    ("persistent contact", "points"),
                                    ("persistent contact", "mortar"),
                                    ("Hauret-Le Tallec", "points")):
            with self.subTest(treatment=treatment, coupling=coupling):
                file = self.scene(bodies, [self.contact(treatment, floor, "block: lower")],
                                  held, end=.12, step=4e-3)
                ledger, _ = self.run_scene(
                    file, parameters=(f"Contact joint/Coupling={coupling}",))
                self.assertLess(max(ledger["promise_residual"]), 1e-9)
                self.assertAlmostEqual(ledger["momentum_y_block"][0], -1000., places=6)
                self.assertGreater(ledger["momentum_y_block"][-1], 300.)
        held = FOOT.format(boundary="ice; tar; block")
        file = self.scene(bodies, [self.contact("persistent contact", floor,
                                                "block: lower")], held)
        code, _, err = self.attempt("ricochet", prm=file, options=["--overwrite"])
        self.assertEqual(code, 1, msg=err)
        self.assertIn("The contact 'joint' can do nothing: all nodes of its surfaces are held",
                      err)

    def test_a_node_in_several_contacts(self):
        """A block slides over the seam between two floors, each a contact with its own friction,
        and stops where a rigid block does by hand, whose pressure leans forward; a block is
        thrown into a corner of two or three walls, each with its own contact, with friction."""
        def stop(v, cm, length, first, second):
            """Displacement of the block until it stops; its front is 0.2 m away from the seam."""
            x, dx = 0., 1e-5
            while v > 0.:
                front = min(max(x - .2, 0.), length)
                share = front / length
                # The part of the force on the second floor grows with the moment of friction.
                lean = 6. * cm * front * (length - front) / length**3
                mean = first + (second - first) * share
                mu = mean / (1. - (second - first) * lean)
                v2 = v * v - 2. * 9.81 * mu * dx
                x, v = x + dx, math.sqrt(v2) if v2 > 0. else 0.
            return x

        soft = "  set Viscosity     = Curnier\n  set Viscosity eta = 5e3\nend"
        bodies = [block("block", "-.4, 0", "1.5, 0", "0.2, 0.05", "12, 3", "1e7"),
                  block("ice", "-.6, -.1", size="0.6, 0.1", cells="25, 4", young="1e7"),
                  block("tar", "0, -.1", size="0.6, 0.1", cells="25, 4", young="1e7")]
        bodies = [body.replace("\nend", "\n" + soft) for body in bodies]
        for treatment in ("persistent contact", "Signorini active set"):
            with self.subTest(treatment):
                joints = [self.contact(treatment, "block: lower", f"{floor}: upper", name=floor)
                          .replace("\nend", f"\n  set Friction coefficient = {mu}\nend")
                          for floor, mu in (("ice", .1), ("tar", .4))]
                probe = "subsection Probe block\n  set Body = block\nend\n"
                file = self.scene(bodies, joints, FOOT.format(boundary="ice; tar") + probe +
                                  GRAVITY.format(gravity="0, -9.81"), end=.8, step=2e-3)
                ledger, _ = self.run_scene(file)
                self.assertLess(max(ledger["promise_residual"]), 1e-10)
                self.assertAlmostEqual(ledger["block_displacement_x"][-1],
                                       stop(1.5, .025, .2, .1, .4), delta=2e-3)

        for dim, treatment in ((2, "Signorini active set"), (2, "Ayyad-Barboteu two-step"),
                               (3, "persistent contact")):
            with self.subTest(dim=dim, treatment=treatment):
                def sized(numbers, dim=dim):
                    return ", ".join(numbers[:dim])

                bodies = [block("block", sized((".01", ".005", ".007")),
                                sized(("-1", "-.7", "-.8")), sized(("0.1", "0.1", "0.1")),
                                sized("333"))]
                joints = []
                sides = [("left", "right"), ("front", "back"), ("lower", "upper")]
                if dim == 2:
                    del sides[1]
                for c, (first, second) in enumerate(sides):
                    size, cells, place = ["0.4"] * 3, ["6"] * 3, ["0"] * 3
                    size[c], cells[c], place[c] = "0.1", "2", "-0.1"
                    bodies.append(block(f"wall_{c}", sized(place), sized("000"), sized(size),
                                        sized(cells)))
                    # Inertia resists as stiffness does: E + rho h^2 / dt^2 = 4.3e6 Pa in 3D. With
                    # E alone round-off decides whether one of the steps is halved.
                    joints.append(self.contact(treatment, f"block: {first}",
                                               f"wall_{c}: {second}", name=f"on_{c}")
                                  .replace("\nend", "\n  set Friction coefficient = 0.3\n"
                                                    "  set Augmentation = 4e6\nend"))
                walls = "; ".join(f"wall_{c}" for c in range(dim))
                file = self.scene(bodies, joints, FOOT.format(boundary=walls), dim=dim, end=.04,
                                  step=1e-3)
                ledger, _ = self.run_scene(file)
                self.assertLess(max(ledger["promise_residual"]), 1e-10)
                self.assertEqual(ledger["step_halvings"][-1], 0)
                for c in range(dim):
                    self.assertGreater(max(ledger[f"contact_force_on_{c}"]), 10.)
                    self.assertGreater(ledger[f"momentum_{'xyz'[c]}_block"][-1], 0.)

    def test_a_block_in_a_corner_of_obstacles(self):
        """A node between two rigid obstacles, whose rows both replace, like that between two held
        bodies, which have multipliers; walls at an angle, that are round, that move, and three in
        3D: Newton's method needs no more than elsewhere."""
        def thrown(dim, joints, more):
            return self.scene(
                [block("block", ", ".join((".0075", ".005", ".007")[:dim]),
                       ", ".join(("-1", "-.7", "-.8")[:dim]), ", ".join(["0.1"] * dim),
                       "6, 6" if dim == 2 else "3, 3, 3")], joints, more, dim=dim, end=.06, step=5e-4)

        def joint(treatment, side, wall, friction):
            return self.contact(treatment, f"block: {side}", wall, name=wall.split(":")[0]).replace(
                "\nend", f"\n  set Friction coefficient = {friction}\nend")

        def obstacle(name, *lines):
            return "\n".join([f"subsection Obstacle {name}", *lines, "end\n"])

        plane = obstacle("floor", "  set Shape = half space")
        walls = {
            "upright": ("  set Shape = half space", "  set Direction = 1, 0"),
            "leaning": ("  set Shape = half space", "  set Direction = 1, 0.5"),
            "round": ("  set Shape = circle", "  set Radius = 0.5", "  set Centre = -0.5, 0.05"),
            "moving": ("  set Shape = half space", "  set Direction = 1, 0",
                       "  set Translation = 0.3*t; 0")}
        for treatment, name, friction in (("Signorini active set", "upright", 0.),
                                          ("persistent contact", "leaning", 0.),
                                          ("Ayyad-Barboteu two-step", "round", .2),
                                          ("persistent contact", "moving", .2)):
            with self.subTest(wall=name, treatment=treatment):
                joints = [joint(treatment, side, wall, friction)
                          for side, wall in (("lower", "floor"), ("left", "wall"))]
                ledger, _ = self.run_scene(thrown(2, joints, plane + obstacle("wall",
                                                                              *walls[name])))
                self.assertLess(max(ledger["promise_residual"]), 1e-11)
                # Two-step contact has two passes.
                self.assertLessEqual(max(ledger["newton_iterations"]), 16)
                self.assertEqual(ledger["step_halvings"][-1], 0)
                for wall in ("floor", "wall"):
                    self.assertGreater(max(ledger[f"contact_force_{wall}"]), 100.)
                # The forces are those that stop the block, each along its own normal.
                for c in "xy":
                    momentum = ledger[f"momentum_{c}"]
                    self.assertAlmostEqual(
                        sum(ledger[f"impulse_{c}_{wall}"][-1] for wall in ("floor", "wall")),
                        momentum[-1] - momentum[0], places=9)
                if friction == 0. and name == "leaning":
                    self.assertAlmostEqual(
                        ledger["impulse_y_wall"][-1] / ledger["impulse_x_wall"][-1], .5,
                        places=9)
                    self.assertAlmostEqual(ledger["impulse_x_floor"][-1], 0., places=9)
                if name != "upright":
                    continue
                held = [block("floor", "0, -.1", size="0.6, 0.1", cells="25, 4"),
                        block("wall", "-.1, 0", size="0.1, 0.5", cells="4, 21")]
                joints = [joint(treatment, side, wall, friction).replace(
                    "\nend", "\n  set Corners = false\nend") for side, wall in
                    (("lower", "floor: upper"), ("left", "wall: right"))]
                file = self.scene([block("block", ".0075, .005", "-1, -.7", "0.1, 0.1", "6, 6")] +
                                  held, joints, FOOT.format(boundary="floor; wall"), end=.06,
                                  step=5e-4)
                bodies, _ = self.run_scene(file)
                self.assertLess(max(abs(a - b) for a, b in zip(ledger["kinetic_energy"],
                                                               bodies["kinetic_energy"])), 1e-8)
        three = "".join(obstacle(name, "  set Shape = half space", f"  set Direction = {n}")
                        for name, n in (("a", "1, 0, 0"), ("b", "0.2, 1, 0"), ("c", "0, 0, 1")))
        for friction, code in ((0., 0), (.2, 1)):
            joints = [joint("Signorini active set", "left", "a; b; c", friction)
                      .replace("block: left", "block").replace("a; b; c\nsub", "a\nsub")]
            joints[0] = joints[0].replace("Contact a; b; c", "Contact walls")
            file = thrown(3, joints, three.replace("0.2, 1, 0", "0.2, 1, 0\n  set Centre = "
                                                   "0.02, 0, 0"))
            if code:
                found, _, err = self.attempt("ricochet", prm=file, options=["--overwrite"])
                self.assertEqual(found, 1)
                self.assertIn("in 3D without friction", err)
                continue
            ledger, _ = self.run_scene(file)
            self.assertLess(max(ledger["promise_residual"]), 1e-11)
            self.assertLess(max(ledger["penetration_walls"]), 1e-15)
            self.assertGreater(max(ledger["contact_force_walls"]), 100.)

    def test_a_wrong_stored_energy_is_noticed(self):
        """With schemes of instants the work of the body's forces is integrated by itself:
        the balance closes only if the stored energy belongs to them."""
        for scheme in ("Crank-Nicolson", "TR-BDF2"):
            with self.subTest(scheme=scheme):
                ledger = self.run_program("hyperelastic_ring", RING + NO_FIELDS + [
                    "Contact/Treatment=penalty", "Time/Final time=0.3",
                    "Time/Mass=consistent", f"Time/Scheme={scheme}"])
                self.assertGreater(max(ledger["elastic_energy"]), .05 * ledger["energy"][0])
                self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-9)

    def test_work_of_bodies_is_that_of_the_scheme(self):
        """Two linear blocks on cut faces: with each scheme the energy exchanged between the bodies
        is the work of contact, and the resultant on the first one is that of the law, including the
        forces of Nitsche's method behind the surface."""
        bodies = [block("lower", "0, 0").replace("neo-Hookean", "linear elastic"),
                  block("upper", "0, 1.001", "0, -1",
                        cells="3, 3").replace("neo-Hookean", "linear elastic")]
        contact = self.contact("Nitsche").replace("end", "  set Coupling = cut faces\nend")
        file = self.scene(bodies, [contact], FOOT.format(boundary="lower: lower"), end=.03,
                          step=1e-3)
        for scheme in ("Crank-Nicolson", "TR-BDF2", "midpoint"):
            with self.subTest(scheme=scheme):
                ledger, _ = self.run_scene(file, parameters=[f"Time/Scheme={scheme}"])
                work = ledger["contact_work"][-1]
                largest = max(map(abs, ledger["contact_work"]))
                self.assertGreater(largest, 1.)
                both = (ledger["contact_work_lower"][-1] +
                        ledger["contact_work_upper"][-1])
                self.assertLess(abs(both - work) / largest, 1e-10)
                # Newton: the force on the upper block is the rate of its momentum.
                n = max(range(len(ledger["time"])),
                        key=lambda k: ledger["contact_force_joint"][k])
                self.assertGreater(ledger["resultant_y_joint"][n], 0.)
                if scheme == "midpoint":
                    impulse = sum(ledger["resultant_y_joint"]) * 1e-3
                    change = (ledger["momentum_y_upper"][-1] -
                              ledger["momentum_y_upper"][0])
                    self.assertLess(abs(impulse - change) / abs(change), 1e-9)


if __name__ == "__main__":
    main()
