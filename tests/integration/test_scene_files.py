# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes as people write them: variables, sections that are like others, tables of loads, forces,
moments and vertices, bodies of one mesh file, and when fields are written.

Numbers are those of the same scene written out, or of statics by hand."""

import math
import re

from common import *

HEAD = """
set Program   = ricochet
set Dimension = {dimension}
"""

STATIC = """
subsection Time
  set Scheme     = static
  set Final time = 1
  set Time step  = 0.5
end
subsection Output
  set Fields every = 0
end
"""

# Poisson's ratio 0: pure bending is then a displacement of degree 2.
BEAM = """
subsection Body beam
  set Shape         = {shape}
  set Size          = 10, 1{depth}
  set Cells along   = 4, 2{cells}
  set Law           = linear elastic
  set Young modulus = 1000
  set Poisson ratio = 0
end
subsection Mesh
  set Degree = 2
end
subsection Condition foot
  set Boundary = beam: left
end
subsection Probe foot
  set Body     = beam: left
  set Quantity = force
end
subsection Probe tip
  set Body  = beam
  set Point = 10, 0.5{middle}
end
"""
PLANE_BEAM = HEAD.format(dimension=2) + BEAM.format(shape="rectangle", depth="", cells="",
                                                    middle="") + STATIC
BEAM_IN_SPACE = HEAD.format(dimension=3) + BEAM.format(shape="block", depth=", 1", cells=", 2",
                                                       middle=", 0.5") + STATIC

FALLING = HEAD.format(dimension=2) + """
subsection Body first
  set Shape         = rectangle
  set Size          = 0.1, 0.1
  set Cells along   = 2, 2
  set Translation   = 0, 0.01
  set Velocity      = 0, -0.5
  set Young modulus = 1e5
end
subsection Body second
  set Shape         = rectangle
  set Size          = 0.1, 0.1
  set Cells along   = 2, 2
  set Translation   = 0.2, 0.02
  set Velocity      = 0, -0.5
  set Young modulus = 2e5
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface = first: lower; second: lower
  set Against = floor
end
subsection Time
  set Final time = 0.05
  set Time step  = 1e-3
end
subsection Output
  set Fields every = 0
end
"""

FALLING_IN_SHORT = HEAD.format(dimension=2) + """
subsection Variables
  set speed = sqrt(2*h)
  set a     = 0.1
  set h     = 0.125
end
subsection Body second
  set Like          = first
  set Translation   = {2*a}, {a/5}
  set Young modulus = 2e5
end
subsection Body first
  set Shape         = rectangle
  set Size          = {a}, {a}
  set Cells along   = 2, 2
  set Translation   = 0, {a/10}
  set Velocity      = 0, {-speed}
  set Young modulus = 1e5
end
""" + FALLING[FALLING.index("subsection Obstacle"):]

# Two squares in one file, which share an edge.
SQUARES = """
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Point(5) = {2, 0, 0}; Point(6) = {2, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2};
Transfinite Curve {1:7} = 5; Transfinite Surface {1, 2}; Recombine Surface {1, 2};
Physical Surface("left square") = {1};
Physical Surface("right square") = {2};
Physical Curve("left end") = {4};
Physical Curve("right end") = {6};
"""


class SceneFiles(ProgramTest):
    def scene(self, text, name="scene"):
        file = self.folder / f"{name}.prm"
        file.write_text(text)
        return file

    def last(self, text, parameters=(), **kwargs):
        ledger = self.run_program("ricochet", parameters, prm=self.scene(text), **kwargs)
        return {name: ledger[name][-1] for name in ledger.names}

    def refused(self, text, *words, parameters=()):
        code, _, err = self.attempt("ricochet", parameters, prm=self.scene(text),
                                    options=["--validate"])
        self.assertEqual(code, 1, msg=err)
        for word in words:
            self.assertIn(word, err)

    def test_variables_and_likeness(self):
        """The same table as the scene written out, byte for byte, bodies being in the order of
        their names in the contact; a variable on the command line changes what follows from it."""
        self.run_program("ricochet", prm=self.scene(FALLING), folder=self.folder / "long")
        short = FALLING_IN_SHORT
        second = short[short.index("subsection Body second"):short.index("subsection Body first")]
        short = short.replace(second, "").replace("subsection Obstacle",
                                                  second + "subsection Obstacle")
        self.run_program("ricochet", prm=self.scene(short), folder=self.folder / "short")
        self.assertEqual(*((self.folder / name / "energy.csv").read_bytes()
                           for name in ("long", "short")))
        # The order of sections does not matter otherwise: speed needs h, which comes later.
        slow = self.last(FALLING_IN_SHORT, ["Variables/h=0.5*0.25^2", "Time/Final time=1e-3"])
        self.assertAlmostEqual(slow["kinetic_energy"], .5 * 2 * 10. * .25**2, delta=1e-10)

    def test_likeness_in_a_chain(self):
        """The third one has what the second one sets, and what it has from the first one; the
        command line counts for all of them."""
        text = FALLING_IN_SHORT + """
subsection Body third
  set Like        = second
  set Translation = 0.5, 0.1
end
"""
        self.run_program("ricochet", ["Body first/Density=900", "Time/Final time=1e-3"],
                         prm=self.scene(text))
        parameters = (self.folder / "run" / "parameters.prm").read_text()
        third = parameters[parameters.index("subsection Body third"):]
        third = third[:third.index("\nend")]
        for name, value in (("Young modulus", "2e5"), ("Density", "900"), ("Size", "0.1, 0.1"),
                            ("Translation", "0.5, 0.1"), ("Velocity", "0, -0.5")):
            self.assertRegex(third, rf"set {name} += {value}(\s|$)")

    def test_variables_of_a_phase(self):
        text = FALLING_IN_SHORT.replace("  set Final time = 0.05\n", "  set Final time = {end}\n")
        text = text.replace("subsection Variables\n", "subsection Variables\n  set end = 0.002\n")
        text += """
subsection Phase fall
end
subsection Phase hit
  subsection Variables
    set end = 0.004
  end
end
"""
        ledger = self.run_program("ricochet", prm=self.scene(text))
        self.assertAlmostEqual(ledger["time"][-1], .006, delta=1e-12)

    def test_refused_variables(self):
        for before, after, words in (
                ("{2*a}", "{2*b}", ["no variable 'b'"]),
                ("{2*a}", "{2*a", ["brace is alone"]),
                ("{2*a}", "2*a}", ["brace is alone"]),
                ("{2*a}", "{}", ["cannot be read"]),
                ("{2*a}", "{2,a}", ["cannot be read"]),
                ("{2*a}", "{1/(a-a)}", ["not finite"]),
                ("{2*a}", "{rand()}", ["random numbers"]),
                ("set h     = 0.125", "set h = speed", ["needs itself"]),
                ("set h     = 0.125", "set t = 0.125", ["name of a variable", "'t'"]),
                ("Like          = first", "Like = fist", ["Is 'Body first' meant?"]),
                ("set Like          = first", "set Like = second", ["is like itself"])):
            with self.subTest(after):
                self.assertIn(before, FALLING_IN_SHORT)
                self.refused(FALLING_IN_SHORT.replace(before, after), *words)
        many = "".join(f"  set v{k} = v{k + 1}\n" for k in range(20000)) + "  set v20000 = 1\n"
        self.refused(FALLING_IN_SHORT.replace("  set h ", many + "  set h "), "more than 100")
        many = "".join(f"subsection Body b{k}\n  set Like = b{k + 1}\nend\n" for k in range(300))
        self.refused(FALLING_IN_SHORT + many + "subsection Body b300\nend\n", "too many in a row")
        self.refused(FALLING_IN_SHORT, "no variable 'hight'",
                     parameters=["Variables/hight=1"])
        # A mistake in a model is found there, and not in a section that is like it.
        self.refused(FALLING_IN_SHORT, "of 'Body first/Velocity' is not allowed",
                     parameters=["Body first/Velocity=1"])

    def test_forces_and_moments(self):
        """A moment M bends a beam of length L into M L^2/(2 E I); supports take what is
        applied."""
        condition = "subsection Condition load\n  set Boundary = beam: right\n  set Kind = {}\n" \
            "  set Value = {}\nend\n"
        bent = .2 * 10.**2 / (2. * 1000. / 12.)
        for name, beam, value in (("2D", PLANE_BEAM, "0.2*t"),
                                  ("3D", BEAM_IN_SPACE, "0; 0; 0.2*t")):
            with self.subTest(name):
                end = self.last(beam + condition.format("moment", value))
                self.assertAlmostEqual(end["tip_displacement_y"], bent, delta=1e-9 * bent)
                for c in "xyz"[:int(name[0])]:
                    self.assertAlmostEqual(end[f"foot_force_{c}"], 0., delta=1e-10)
        end = self.last(BEAM_IN_SPACE + condition.format("moment", "0; 0.2*t; 0"))
        self.assertAlmostEqual(end["tip_displacement_z"], -bent, delta=1e-9 * bent)
        end = self.last(BEAM_IN_SPACE + condition.format("force", "0.1*t; 0.2; -0.3"))
        for c, value in zip("xyz", (.1, .2, -.3)):
            self.assertAlmostEqual(end[f"foot_force_{c}"], -value, delta=1e-10)
        # In step with the elongation of a bar, F L/(E A).
        end = self.last(PLANE_BEAM + condition.format("force", "5; 0"))
        self.assertAlmostEqual(end["tip_displacement_x"], .05, delta=1e-10)
        two = condition.format("force", "5; 0").replace("right", "right, upper, lower")
        end = self.last(PLANE_BEAM + two)
        self.assertAlmostEqual(end["foot_force_x"], -5., delta=1e-9)
        self.refused(PLANE_BEAM + condition.format("moment", "0; 1"), "needs 1 expression")
        self.refused(PLANE_BEAM + condition.format("moment", "1") .replace(
            "  set Kind", "  set Point = 10, 0\n  set Kind"), "no effect",
                     parameters=["Condition load/Point=10, 0"])

    def test_vertices(self):
        """A plate that three components in two vertices hold is stretched without a reaction;
        a force in a vertex is all that the support takes, whatever the number of ranks."""
        text = HEAD.format(dimension=2) + """
subsection Body plate
  set Shape         = rectangle
  set Size          = 2, 1
  set Cells along   = 4, 2
  set Law           = linear elastic
  set Young modulus = 1000
  set Poisson ratio = 0.25
  set Plane state   = plane stress
end
subsection Condition pin
  set Boundary = plate
  set Point    = 0, 0
end
subsection Condition roller
  set Boundary   = plate
  set Point      = 2.1, 0
  set Components = y
end
subsection Condition right
  set Boundary = plate: right
  set Kind     = traction
  set Value    = 10; 0
end
subsection Condition left
  set Boundary = plate: left
  set Kind     = traction
  set Value    = -10; 0
end
subsection Probe corner
  set Body  = plate
  set Point = 2, 1
end
""" + STATIC
        end = self.last(text)
        self.assertAlmostEqual(end["corner_displacement_x"], .02, delta=1e-12)
        self.assertAlmostEqual(end["corner_displacement_y"], -.0025, delta=1e-12)
        self.refused(text.replace("Point    = 0, 0", "Point    = 0"), "needs 2 numbers")
        moved = text + """
subsection Condition top
  set Boundary   = plate
  set Point      = 0, 1
  set Kind       = displacement
  set Components = x
  set Value      = 0.01*t; 0
end
"""
        turned = self.last(moved)
        load = PLANE_BEAM + """
subsection Condition tip
  set Boundary = beam
  set Point    = 10, 1
  set Kind     = force
  set Value    = 0.01*t; -0.02
end
"""
        ends = [self.last(load, n_ranks=n) for n in (1, 2)]
        self.assertGreater(turned["corner_displacement_x"], .02)
        for end in ends:
            self.assertAlmostEqual(end["foot_force_x"], -.01, delta=1e-10)
            self.assertAlmostEqual(end["foot_force_y"], .02, delta=1e-10)
        self.assertAlmostEqual(ends[0]["tip_displacement_y"], ends[1]["tip_displacement_y"],
                               delta=1e-10)

    def test_tables(self):
        """A table is the expression that it stands for, and constant beyond its ends."""
        (self.folder / "pull.csv").write_text("time, force\n# s, N\n0, 0\n0.25; 1\n0.75 2\n")
        condition = "subsection Condition load\n  set Boundary = beam: right\n" \
            "  set Kind = traction\n  set {} = {}\n  set {} = {}\nend\n"
        table = PLANE_BEAM + condition.format("Table", "pull.csv", "Value", "0.5; 3")
        steps = ["Time/Time step=0.125"]
        ledger = self.run_program("ricochet", steps, prm=self.scene(table))
        for t, force in zip(ledger["time"][1:], ledger["foot_force_x"][1:]):
            factor = 4. * t if t <= .25 else min(2., 1. + 2. * (t - .25))
            self.assertAlmostEqual(force, -.5 * factor, delta=1e-10)
        (self.folder / "pull.csv").write_text("0 0 0\n1 0.5 3\n")
        both = self.last(PLANE_BEAM + condition.format("Table", "pull.csv", "Value", ""))
        self.assertAlmostEqual(both["foot_force_x"], -.5, delta=1e-10)
        self.assertAlmostEqual(both["foot_force_y"], -3., delta=1e-10)
        for text, words in (("0 0\n", ["fewer than two rows"]),
                            ("0 0\n1 x\n", ["line 2"]),
                            ("0 0\n1 1\n1 2\n", ["line 3", "times have to grow"]),
                            ("0 0\n1 1 2\n", ["line 2", "another number"]),
                            ("0 0 0 0\n1 1 2 3\n", ["3 values"]),
                            ("", ["fewer than two rows"])):
            with self.subTest(text):
                (self.folder / "pull.csv").write_text(text)
                self.refused(table, "Table", *words)
        (self.folder / "pull.csv").unlink()
        self.refused(table, "pull.csv")

    def test_springs_with_displaced_ends(self):
        """A block on springs whose ends go to v hangs m g/(k A) below it; the account closes."""
        text = HEAD.format(dimension=2) + """
subsection Body block
  set Shape         = rectangle
  set Size          = 2, 1
  set Cells along   = 4, 2
  set Law           = linear elastic
  set Density       = 3
end
subsection Condition ground
  set Boundary  = block: lower
  set Kind      = springs
  set Stiffness = 100
  set Value     = 0; 0.1*t
end
subsection Probe foot
  set Body  = block
  set Point = 0, 0
end
subsection Start
  set Gravity = 0, -10
end
""" + STATIC
        end = self.last(text)
        self.assertAlmostEqual(end["foot_displacement_y"], .1 - 30. / 100., delta=1e-5)
        self.refused(text.replace("Stiffness = 100", "Damping = 100"), "those of dashpots")

    def test_interference(self):
        """A bore that is too narrow by 0.004, raised in a static phase, has Lame's pressure; in
        motion it stays; the work of the fit is the stored energy."""
        text = HEAD.format(dimension=2) + """
subsection Body tube
  set Shape         = ring
  set Radius        = 1
  set Inner radius  = 0.5
  set Nodes around  = 96
  set Nodes across  = 9
  set Law           = linear elastic
  set Young modulus = 1000
  set Density       = 1
end
subsection Body ring
  set Like         = tube
  set Radius       = 2
  set Inner radius = 1
  set Nodes across = 17
end
subsection Contact fit
  set Surface      = tube: outer
  set Against      = ring: inner
  set Treatment    = Signorini active set
  set Interference = 0.004*t
end
subsection Phase fit
  subsection Time
    set Scheme     = static
    set Final time = 1
    set Time step  = 0.5
  end
end
subsection Phase rest
  subsection Contact fit
    set Interference = 0.004
  end
  subsection Time
    set Final time = 0.05
    set Time step  = 0.01
  end
end
subsection Output
  set Fields every = 0
end
"""
        ledger = self.run_program("ricochet", prm=self.scene(text))
        sides = (1. + .25) / (1. - .25) + (4. + 1.) / (4. - 1.)
        pressure = .004 * 1000. / (1. - .3**2) / sides
        fit = [k for k, phase in enumerate(ledger["phase"]) if phase == 1]
        self.assertAlmostEqual(ledger["contact_pressure_fit"][fit[-1]], pressure,
                               delta=2e-3 * pressure)
        # Half of the pressure times the interference, on the circumference.
        stored = math.pi * pressure * .004
        self.assertAlmostEqual(ledger["elastic_energy"][fit[-1]], stored, delta=5e-3 * stored)
        self.assertAlmostEqual(ledger["contact_work"][fit[-1]], -ledger["elastic_energy"][fit[-1]],
                               delta=1e-9 * stored)
        self.assertAlmostEqual(ledger["elastic_energy"][-1], ledger["elastic_energy"][fit[-1]],
                               delta=1e-6 * stored)
        self.assertLess(ledger["kinetic_energy"][-1], 1e-9 * stored)
        self.assertAlmostEqual(ledger["contact_pressure_fit"][-1], pressure, delta=2e-3 * pressure)
        for before, after, words in (
                ("set Interference = 0.004\n", "set Interference = 0.004*t\n", "needs Time/Scheme"),
                ("0.004*t", "0.004*s", "cannot be read"),
                ("set Against      = ring: inner", "set Against = itself", "between bodies only")):
            with self.subTest(after):
                self.assertIn(before, text)
                self.refused(text.replace(before, after), words)
        alone = text[:text.index("subsection Phase fit")]
        self.refused(alone.replace("0.004*t", "0.004"), "a static phase raise it")

    def test_bodies_of_one_file(self):
        """Two groups of a mesh file, which share an edge, are two bodies: with a gap between them
        they meet as two squares of their own do."""
        (self.folder / "squares.geo").write_text(SQUARES)
        bodies = """
subsection Body left
  {}
  set Velocity = 1, 0
end
subsection Body right
  {}
  set Translation = {}, 0
  set Velocity    = -1, 0
end
subsection Contact joint
  set Surface = left: {}
  set Against = right: {}
end
subsection Time
  set Final time = 0.05
  set Time step  = 1e-3
end
subsection Output
  set Fields every = 0
end
"""
        group = "set File = squares.geo\n  set Group = {} square"
        square = "set Shape = rectangle\n  set Size = 1, 1\n  set Cells along = 4, 4"
        of_file = self.scene(HEAD.format(dimension=2) + bodies.format(
            group.format("left"), group.format("right"), .01, 0, 0))
        own = self.scene(HEAD.format(dimension=2) + bodies.format(
            square, square, 1.01, "right, lower, upper", "left, lower, upper"), "own")
        a, b = (self.run_program("ricochet", prm=file, folder=self.folder / file.stem)
                for file in (of_file, own))
        self.assertGreater(max(a["contact_force_joint"]), 0.)
        for name in ("kinetic_energy", "elastic_energy", "contact_force_joint"):
            scale = max(map(abs, b[name]))
            for x, y in zip(a[name], b[name]):
                self.assertAlmostEqual(x, y, delta=1e-9 * scale)
        text = of_file.read_text()
        self.refused(text.replace("= left square", "= lift square"), "left square")
        self.refused(HEAD.format(dimension=2) + bodies.format(
            square, square, 1.01, "right", "left"), "no effect",
                     parameters=["Body left/Group=1"])

    def test_two_rotations(self):
        """About x, then about z, by right angles: (1, 2, 3) has its corner at (3, 1, 2)."""
        text = HEAD.format(dimension=3) + """
subsection Body block
  set Shape                = block
  set Size                 = 1, 2, 3
  set Cells along          = 1, 1, 1
  set Rotation             = {pi/2}
  set Rotation axis        = 1, 0, 0
  set Second rotation      = {pi/2}
  set Second rotation axis = 0, 0, 2
end
subsection Time
  set Final time = 0.01
end
subsection Output
  set Fields every = 1
end
"""
        self.run_program("ricochet", prm=self.scene(text))
        sys.path.insert(0, str(ROOT / "python"))
        from ricochet import Run
        grid = Run(self.folder / "run").fields(0)
        bounds = grid.GetBounds()
        for found, expected in zip(bounds, (0., 3., 0., 1., 0., 2.)):
            self.assertAlmostEqual(found, expected, delta=1e-12)
        self.refused(text.replace("0, 0, 2", "0, 0, 0"), "Second rotation axis")

    def test_when_fields_are_written(self):
        ledger = self.run_program(
            "ricochet", ["Output/Fields at=0, 0.0301, 0.05",
                         "Output/Fields when=contact_force_floor > 0"],
            prm=self.scene(FALLING))
        due = {0, 31, 50} | {k for k, force in enumerate(ledger["contact_force_floor"]) if force > 0.}
        self.assertGreater(len(due), 5)
        self.assertLess(len(due), 40)
        found = {int(file.stem.split("-")[1])
                 for file in (self.folder / "run" / "solution").glob("step-*.vtu")}
        self.assertEqual(found, due)
        for parameter, words in (("Output/Fields at=0.2", "not in the run"),
                                 ("Output/Fields when=force >", "cannot be read"),
                                 ("Output/Fields when=contact_force_flor > 0",
                                  "Is 'contact_force_floor' meant?")):
            code, _, err = self.attempt("ricochet", [parameter], self.folder / "refused",
                                        prm=self.scene(FALLING))
            self.assertEqual(code, 1)
            self.assertIn(words, err)


    def test_meshes_of_others(self):
        """A universal file with its groups, by number and name; the body within the triangles of a file of
        stereolithography; and what is refused with a command."""
        def nodes(x, y, z):
            return 1 + 4 * x + 2 * y + z

        def around(x, height=None):
            corners = [nodes(x + a, b, 0) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            return corners if height is None else corners + [each + 1 for each in corners]

        elements = [(115, around(x, 1)) for x in (0, 1)] + [(94, around(x)) for x in (0, 1)]
        groups = {"body": (1, 2), "lower left": (3,), "lower right": (4,)}
        text = "    -1\n  2411\n"
        for x in range(3):
            for y, z in ((0, 0), (0, 1), (1, 0), (1, 1)):
                text += f"{nodes(x, y, z):10d}         1         1        11\n"
                text += "".join(f"{value:25.16E}" for value in (x, y, z)) + "\n"
        text += "    -1\n    -1\n  2412\n"
        for number, (kind, corners) in enumerate(elements, 1):
            text += "".join(f"{k:10d}" for k in (number, kind, 1, 1, 7, len(corners))) + "\n"
            text += "".join(f"{k:10d}" for k in corners) + "\n"
        text += "    -1\n    -1\n  2467\n"
        for number, (name, members) in enumerate(groups.items(), 1):
            text += "".join(f"{k:10d}" for k in (number, *6 * [0], len(members))) + f"\n{name}\n"
            text += "".join(f"{k:10d}" for m in members for k in (8, m, 0, 0)) + "\n"
        scene = ("set Program = ricochet\nset Dimension = 3\nsubsection Body part\n  set File = {file}\n"
                 "end\nsubsection Obstacle floor\n  set Shape = half space\nend\n"
                 "subsection Contact floor\n  set Surface = part: {surface}\n  set Against = floor\nend\n")
        (self.folder / "bar.unv").write_text(text + "    -1\n")
        file = self.folder / "scene.prm"

        def validate(name, surface):
            file.write_text(scene.format(file=name, surface=surface))
            return self.attempt("ricochet", prm=file, options=["--validate"])

        code, out, err = validate("bar.unv", "lower left")
        self.assertEqual((code, err), (0, ""))
        self.assertIn("2 cells, 12 vertices, volume 2,", out)
        self.assertIn("boundary 2 (lower left): area 1,", out)
        self.assertIn("boundary 3 (lower right): area 1,", out)
        self.assertIn("boundary 0: area 8,", out)
        (self.folder / "twice.unv").write_text(text.replace(
            "         8         4         0         0", "         8         3         0         0") +
            "    -1\n")
        code, out, err = validate("twice.unv", "1")
        self.assertEqual(code, 1)
        self.assertIn("element 3 is in two groups", err)
        # A unit cube: two triangles on each of its faces.
        corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        with open(self.folder / "cube.stl", "w") as stl:
            stl.write("solid cube\n")
            for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2),
                               (1, 3, 7, 5)):
                for triangle in ((a, b, c), (a, c, d)):
                    stl.write("facet normal 0 0 0\nouter loop\n" + "".join(
                        "vertex {} {} {}\n".format(*corners[k]) for k in triangle) +
                        "endloop\nendfacet\n")
            stl.write("endsolid cube\n")
        code, out, err = validate("cube.stl", "2")
        self.assertEqual((code, err), (0, ""))
        self.assertIn("volume 1, mass 1000 kg, middle (0.5, 0.5, 0.5)", out)
        areas = [float(area) for area in re.findall(r"boundary \d+: area ([0-9.e-]+)", out)]
        self.assertAlmostEqual(sum(areas), 6, 9)
        (self.folder / "part.inp").write_text("*NODE\n")
        code, out, err = validate("part.inp", "1")
        self.assertEqual(code, 1)
        self.assertIn(f"meshio convert '{self.folder / 'part.inp'}' mesh.msh", err)


if __name__ == "__main__":
    main()
