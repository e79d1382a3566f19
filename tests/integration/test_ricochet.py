# SPDX-License-Identifier: LGPL-2.1-or-later
"""Users' scenes: the benchmarks as files, several contacts at once, units, materials, conditions,
ranks, restart, and refused input."""

import math
import unittest.mock

from common import *
from test_bad_input import Refusal

# A ball that spins hits the floor and a brick, which is pushed over the floor against a
# wall: four contacts, two of them constraints, with friction. Masses and moduli are in
# the braces, so that units can be changed.
SCENE = """
set Program   = ricochet
set Dimension = 2
subsection Time
  set Final time = {final_time}
  set Time step  = {time_step}
end
subsection Start
  set Gravity = 0, {gravity}
end
subsection Body ball
  set Shape         = disk
  set Radius        = {radius}
  set Nodes around  = 32
  set Velocity      = {fast}, {slow}
  set Spin          = {spin}
  set Density       = {density}
  set Young modulus = {young}
end
subsection Body brick
  set Shape         = rectangle
  set Size          = {length}, {radius}
  set Cells along   = 8, 4
  set Translation   = {right}, {down}
  set Density       = {density}
  set Young modulus = {stiff}
end
subsection Obstacle floor
  set Shape  = half space
  set Centre = 0, {floor}
end
subsection Obstacle wall
  set Shape     = half space
  set Centre    = {wall}, 0
  set Direction = -1, 0
end
subsection Contact ball on floor
  set Surface = ball
  set Against = floor
end
subsection Contact brick on ground
  set Surface              = brick: lower
  set Against              = floor
  set Friction coefficient = 0.3
end
subsection Contact brick at wall
  set Surface   = brick: right
  set Against   = wall
  set Treatment = improved normal compliance
end
subsection Contact ball and brick
  set Surface              = ball
  set Against              = brick: left, upper
  set Treatment            = improved normal compliance
  set Friction coefficient = 0.2
end
subsection Probe brick
  set Body     = brick
  set Quantity = stress
end
subsection Probe corner
  set Body  = brick
  set Point = {right}, {down}
end
"""


def scene(length=1., mass=1., time=1., steps=100):
    """The scene with units that are so many metres, kilograms and seconds smaller."""
    modulus = mass / length / time**2
    values = {"final_time": 5e-3 * steps * time, "time_step": 5e-3 * time,
              "gravity": -9.81 * length / time**2, "radius": .5 * length,
              "fast": 6. * length / time, "slow": -3. * length / time,
              "spin": 2. / time, "density": 1000. * mass / length**3,
              "young": 1e6 * modulus, "stiff": 3e6 * modulus, "length": 1. * length,
              "right": 1.2 * length, "down": -.59 * length, "floor": -.6 * length,
              "wall": 2.25 * length}
    return SCENE.format(**{name: repr(value) for name, value in values.items()})


# A sole of rubber under a plate of steel, as Gmsh meshes it.
SHOE = """
Point(1)={0,0,0}; Point(2)={2,0,0}; Point(3)={2,0.5,0}; Point(4)={0,0.5,0};
Point(5)={2,1,0}; Point(6)={0,1,0};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Line(5)={3,5};
Line(6)={5,6}; Line(7)={6,4};
Curve Loop(1)={1,2,3,4}; Plane Surface(1)={1};
Curve Loop(2)={-3,5,6,7}; Plane Surface(2)={2};
Physical Surface("soft",10)={1}; Physical Surface("hard",20)={2};
Physical Curve("sole",1)={1}; Physical Curve("sides",2)={2,4,5,7};
Physical Curve("top",3)={6};
"""
SHOE_SCENE = """
set Program   = ricochet
set Dimension = 2
set Units     = mm, t, s
subsection Body shoe
  set File          = shoe.geo
  set Mesh size     = 0.25
  set Materials     = hard: steel
  set Translation   = 0, 0.05
  set Velocity      = 100, -300
  set Density       = 1e-9
  set Young modulus = 10
end
subsection Material steel
  set Density       = 8e-9
  set Young modulus = 1000
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact sole
  set Surface              = shoe: sole
  set Against              = floor
  set Friction coefficient = 0.4
end
subsection Condition handle
  set Boundary   = shoe: top
  set Kind       = springs
  set Components = x
  set Stiffness  = 100
end
subsection Time
  set Final time = 5e-4
  set Time step  = 1e-5
end
"""

BLOCK = """
set Program   = ricochet
set Dimension = 2
subsection Body block
  set Shape       = rectangle
  set Size        = 2, 1
  set Cells along = 4, 2
  set Law         = linear elastic
  set Poisson ratio = 0
  set Young modulus = 1e4
end
subsection Time
  set Final time = 0.4
  set Time step  = 0.01
end
"""


class Scenes(ProgramTest):

    def scene(self, text, *parameters, name="scene", **kwargs):
        file = self.folder / f"{name}.prm"
        file.write_text(text)
        return self.run_program("ricochet", [*NO_FIELDS, *parameters],
                                self.folder / name, prm=file, **kwargs)

    def test_benchmarks(self):
        """The ledgers of their own programs, to 1e-12 of the first energy."""
        files = ROOT / "parameter_files"
        cases = [
            ("elastic_ball",
             ["Mesh/Nodes=392", "Mesh/Boundary nodes=64", "Start/Initial gap=0.0155",
              "Time/Final time=0.02"],
             ["Body ball/Nodes=392", "Body ball/Nodes around=64",
              "Body ball/Translation=0, 10.0155", "Time/Final time=0.02"]),
            ("hyperelastic_ring",
             ["Mesh/Nodes around=64", "Mesh/Nodes across=4", "Start/Initial gap=0.155",
              "Time/Final time=0.2"],
             ["Body ring/Nodes around=64", "Body ring/Nodes across=4",
              "Body ring/Translation=0, 10.155", "Time/Final time=0.2"]),
            ("sphere", ["Time/Final time=3", "Start/Gravity=0, 0, -1"],
             ["Time/Final time=3", "Start/Gravity=0, 0, -1"])]
        for name, own, scenes in cases[:2] if is_debug_build() else cases:
            with self.subTest(name):
                a = self.run_program(name, NO_FIELDS + own, self.folder / "own",
                                     prm=files / name / "default.prm")
                b = self.run_program("ricochet", NO_FIELDS + scenes,
                                     self.folder / "scene",
                                     prm=files / "ricochet" / f"{name}.prm")
                self.assertGreater(max(a["contact_force_foundation"]), 0.)
                # The sphere begins at rest.
                scale = max(a["energy"][0], max(a["elastic_energy"]))
                for column in ("kinetic_energy", "elastic_energy", "contact_work",
                               "external_work"):
                    self.assertLess(largest([x - y for x, y in zip(a[column],
                                                                   b[column])]),
                                    1e-12 * scale, msg=column)

    def test_four_contacts(self):
        whole = self.scene(scene())
        for name in ("ball_on_floor", "brick_on_ground", "brick_at_wall",
                     "ball_and_brick"):
            self.assertGreater(max(whole[f"contact_force_{name}"]), 1e3, msg=name)
        self.assertLess(largest(whole["balance_residual"]), 1e-11)
        self.assertGreaterEqual(min(increments(whole["friction_work"])), -1e-9)
        # The energy is the sum of the works of loads, contacts and friction.
        for row in range(len(whole["time"])):
            self.assertAlmostEqual(
                whole["energy"][row] - whole["energy"][0],
                whole["external_work"][row] - whole["contact_work"][row] -
                whole["friction_work"][row], delta=1e-9 * whole["energy"][0])
        # The resultants of contacts, friction included, and gravity change momenta.
        for axis, weight in (("x", 0.), ("y", -9.81)):
            mass = math.pi / 4. * 1000. * math.sin(math.pi / 16.) / (math.pi / 16.)
            rate = [a + b + mass * weight for a, b in zip(
                whole[f"resultant_{axis}_ball_on_floor"],
                whole[f"resultant_{axis}_ball_and_brick"])]
            scale = largest(whole[f"momentum_{axis}_ball"])
            for change, force in zip(increments(whole[f"momentum_{axis}_ball"]), rate[1:]):
                self.assertAlmostEqual(change, 5e-3 * force, delta=1e-9 * scale)
        # The energies of the bodies add up to the whole.
        for row in range(len(whole["time"])):
            parts = sum(whole[f"{kind}_energy_{name}"][row]
                        for kind in ("kinetic", "elastic") for name in ("ball", "brick"))
            self.assertAlmostEqual(parts / whole["energy"][row], 1., delta=1e-11)

        # Two ranks, and a run in two parts.
        if is_debug_build():
            return
        def compare(other):
            for column in other.names:
                # Counts differ where a residual sits at the tolerance, and tangents are
                # renewed by counts.
                if column in NOISE:
                    continue
                scale = largest([x for x in whole[column] if not math.isnan(x)])
                difference = largest([a - b for a, b in
                                      zip(whole[column], other[column])
                                      if not math.isnan(a)])
                if scale > 1e-6:
                    self.assertLess(difference, 1e-9 * scale, msg=column)

        compare(self.scene(scene(), name="two", n_ranks=2))
        checkpoints = "Output/Checkpoint every=20"
        # Begun on two ranks, ended on one.
        self.scene(scene(steps=40), checkpoints, name="both", n_ranks=2)
        compare(self.scene(scene(), checkpoints, name="both", options=["--resume"]))
        self.scene(scene(steps=40), checkpoints, name="parts")
        self.scene(scene(), checkpoints, name="parts", options=["--resume"])
        self.assertEqual((self.folder / "scene" / "energy.csv").read_bytes(),
                         (self.folder / "parts" / "energy.csv").read_bytes())

    def test_units(self):
        """Default values follow from the bodies: the same digits in any units."""
        steps = 15 if is_debug_build() else 60
        si = self.scene(scene(steps=steps))
        for name, units in (("mm_t_s", (1e3, 1e-3, 1.)),
                            ("large", (1e3, 1e3, 1e3)))[:1 if is_debug_build() else 2]:
            other = self.scene(scene(*units, steps=steps), name=name)
            for column in si.names:
                scale = largest([x for x in si[column] if not math.isnan(x)] or [0.])
                factor = largest([x for x in other[column] if not math.isnan(x)]
                                 or [0.])
                # Zeros are round-off, and so is the number of the last iteration.
                if scale < 1e-6 or column in NOISE:
                    continue
                for a, b in zip(si[column], other[column]):
                    if not math.isnan(a):
                        self.assertAlmostEqual(a / scale, b / factor, delta=1e-9,
                                               msg=f"{name}: {column}")
        named = self.scene("set Units = mm, t, s\n" + scene(1e3, 1e-3, 1., steps=1),
                           name="named")
        units = dict(zip(named.names, named.units))
        self.assertEqual([units[name] for name in
                          ("energy", "contact_force_ball_on_floor", "time",
                           "contact_pressure_ball_on_floor", "momentum_x",
                           "brick_stress_xx")],
                         ["mJ", "N", "s", "MPa", "t mm/s", "MPa"])

    def test_materials_of_a_geometry(self):
        """A geometry that Gmsh meshes, of two materials, on springs."""
        (self.folder / "shoe.geo").write_text(SHOE)
        ledger = self.scene(SHOE_SCENE)
        # Areas and densities by hand.
        self.assertAlmostEqual(ledger["kinetic_energy"][0],
                               .5 * (1e-9 + 8e-9) * 1e5, delta=1e-15)
        self.assertAlmostEqual(ledger["momentum_x"][0], (1e-9 + 8e-9) * 100., delta=1e-17)
        self.assertGreater(max(ledger["contact_force_sole"]), 1e-3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-9)
        self.assertEqual(max(ledger["viscous_dissipation"]), 0.)
        # A dashpot only dissipates energy.
        damped = self.scene(SHOE_SCENE, "Condition handle/Damping=0.001",
                            name="damped")
        self.assertGreater(damped["viscous_dissipation"][-1],
                           .01 * damped["energy"][0])
        self.assertGreaterEqual(min(increments(damped["viscous_dissipation"])), 0.)
        self.assertLess(largest(damped["balance_residual"]), 1e-9)

    def test_geometries_that_gmsh_does_not_survive(self):
        """A script that ends its process, one that makes it crash or never be done."""
        for name, text, message in (
                ("exit", "Exit;\n", "Gmsh ended before the work was done"),
                ("cannot", "Point(1)={0,0,0};\n", "Gmsh cannot read"),
                ("crash", SHOE + "Mesh.Algorithm=8; Mesh.RecombineAll=1;\n"
                 "Point(7)={0,0,0}; Line(8)={1,7}; Line(9)={7,2}; Curve Loop(3)={8,9,-1};\n"
                 "Plane Surface(3)={3};\n", "Gmsh")):
            with self.subTest(name):
                (self.folder / "shoe.geo").write_text(text)
                scene_file = self.folder / "shoe.prm"
                scene_file.write_text(SHOE_SCENE)
                result = subprocess.run(
                    [program_path("ricochet"), str(scene_file), "--output-dir", "out"],
                    capture_output=True, text=True, cwd=self.folder)
                self.assertEqual(result.returncode, 1, msg=result.stdout + result.stderr)
                self.assertIn("cannot be taken", result.stderr)
                self.assertIn(message, result.stderr)

    def test_meshes_that_are_too_fine_or_find_no_place(self):
        """Temporary files have a folder, and their absence a sentence."""
        (self.folder / "shoe.geo").write_text(SHOE)
        scene_file = self.folder / "shoe.prm"
        scene_file.write_text(SHOE_SCENE)
        for folder, size, code, message in (
                (self.folder / "none", "0", 1, "TMPDIR"),
                (self.folder, "1e-12", 1, "the mesh would be too fine"),
                (self.folder, "0", 0, "")):
            with self.subTest(message):
                result = subprocess.run(
                    [program_path("ricochet"), str(scene_file), "--validate",
                     "--set", f"Body shoe/Mesh size={size}"],
                    capture_output=True, text=True, cwd=self.folder,
                    env={**os.environ, "TMPDIR": str(folder)})
                self.assertEqual(result.returncode, code,
                                 msg=result.stdout + result.stderr)
                self.assertIn(message, result.stderr)
                self.assertEqual(list(self.folder.glob("ricochet-*")), [])

    def test_contact_of_several_boundaries(self):
        """The force of a contact is that of all its boundaries: it pushes the block."""
        text = BLOCK.replace("  set Law ", "  set Velocity = 0, -1\n  set Law ", 1) + """
subsection Obstacle floor
  set Shape  = half space
  set Centre = 0, -0.005
end
subsection Contact floor
  set Surface = block
  set Against = floor
end
"""
        ledger = self.scene(text)
        times, force = ledger["time"], ledger["contact_force_floor"]
        impulse = sum((b - a) * f for a, b, f in zip(times, times[1:], force[1:]))
        self.assertGreater(impulse, 100.)
        self.assertAlmostEqual(ledger["momentum_y"][-1] - ledger["momentum_y"][0],
                               impulse, delta=1e-8 * impulse)

    def test_linear_body_of_two_materials(self):
        """Connected parts move as one; a bar of two materials in a row, end on against the floor,
        keeps its energy, and so does one that spins."""
        text = """
set Program = ricochet
set Dimension = 2
subsection Body row
  set Shape = generator
  set Generator = subdivided_hyper_rectangle
  set Generator arguments = 2, 2 : -1, -1 : 1, 1 : true
  set Law = linear elastic
  set Velocity = 0, -2
  set Spin = 0.1
  set Materials = 0: steel
end
subsection Material steel
  set Law = linear elastic
  set Young modulus = 1e7
end
subsection Obstacle floor
  set Shape  = half space
  set Centre = 0, -1.02
end
subsection Contact floor
  set Surface = row
  set Against = floor
end
subsection Time
  set Time step = 0.002
  set Final time = 0.06
end
"""
        ledger = self.scene(text)
        self.assertGreater(max(ledger["contact_force_floor"]), 1e3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-12)
        self.assertLess(largest([e - ledger["energy"][0] for e in ledger["energy"]]),
                        1e-11 * ledger["energy"][0])

    def test_boundaries_without_nodes_of_their_own(self):
        """All nodes of a boundary may count as those of its neighbours."""
        text = """
set Program = ricochet
set Dimension = 3
subsection Body a
  set Shape = block
  set Cells along = 2, 2, 1
  set Velocity = 0, 0, 2
end
subsection Body b
  set Shape = block
  set Cells along = 2, 2, 1
  set Translation = 0.1, 0.2, 1.001
end
subsection Contact c
  set Surface = a
  set Against = b: lower
end
subsection Time
  set Time step = 0.002
  set Final time = 0.01
end
"""
        ledger = self.scene(text)
        self.assertGreater(max(ledger["contact_force_c"]), 1e3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-12)

    def test_loads_by_hand(self):
        """A load that pushes a free block: momentum is force times time, and the work that of the
        momentum, except for the energy of waves."""
        load = BLOCK + """
subsection Condition push
  set Boundary = block: left, right
  set Kind     = traction
  set Value    = 300*sin(pi*t/0.4) * (1 + 0*y); 0
end
"""
        ledger = self.scene(load)
        mass = 2000.
        impulse = 2. * 300. * 1. * .4 * 2. / math.pi
        self.assertAlmostEqual(ledger["momentum_x"][-1], impulse, delta=2e-3 * impulse)
        self.assertAlmostEqual(ledger["external_work"][-1], ledger["energy"][-1],
                               delta=1e-9)
        self.assertGreater(ledger["energy"][-1], impulse**2 / 2. / mass * .99)
        # A block that spins about its middle, wherever it is.
        turn = "subsection Probe turn\n  set Body = block\n  set Quantity = rotation\nend\n"
        spinning = self.scene(BLOCK + turn, "Body block/Spin=1", "Body block/Translation=3, 5",
                              "Time/Final time=0.01", name="spinning")
        self.assertAlmostEqual(spinning["momentum_x"][0], 0., delta=1e-9)
        self.assertAlmostEqual(spinning["momentum_y"][0], 0., delta=1e-9)
        self.assertAlmostEqual(spinning["energy"][0], .5 * mass * (4. + 1.) / 12.,
                               delta=1e-9)
        self.assertAlmostEqual(spinning["turn_rotation"][0], 0., delta=1e-13)
        self.assertAlmostEqual(spinning["turn_rotation"][-1], .01, delta=1e-5)
        # The same as a force per mass.
        body = BLOCK + """
subsection Condition walls
  set Boundary   = block: lower, upper
  set Kind       = fixed
  set Components = y
end
"""
        ledger = self.scene(body, "Body block/Acceleration=0.3*sin(pi*t/0.4); 0",
                            name="body")
        impulse = mass * .3 * .4 * 2. / math.pi
        self.assertAlmostEqual(ledger["momentum_x"][-1], impulse, delta=2e-3 * impulse)
        self.assertAlmostEqual(ledger["energy"][-1],
                               ledger["momentum_x"][-1]**2 / 2. / mass,
                               delta=1e-9 * ledger["energy"][-1])

    def test_imposed_displacement(self):
        """A block that is stretched slowly and uniformly: stress and work by hand."""
        text = BLOCK + """
subsection Condition left
  set Boundary   = block: left
  set Kind       = fixed
  set Components = x
end
subsection Condition foot
  set Boundary   = block: lower
  set Kind       = fixed
  set Components = y
end
subsection Condition right
  set Boundary   = block: right
  set Kind       = displacement
  set Components = x
  set Value      = 0.01*x*(1 - cos(pi*t/400)); 0
end
subsection Probe stress
  set Body     = block
  set Quantity = stress
  set Point    = 1.1, 0.6
end
subsection Probe pull
  set Body     = block: right
  set Quantity = impulse
end
subsection Probe hold
  set Body     = block: left
  set Quantity = impulse
end
subsection Probe pulled
  set Body     = block: right
  set Quantity = force
end
"""
        ledger = self.scene(text, "Time/Time step=4", "Time/Final time=400")
        # The force is the stress over a side of 1 m; its integral over time, by hand.
        self.assertAlmostEqual(ledger["pull_impulse_x"][-1], 1e4 * .01 * 400.,
                               delta=1e-3 * 4e4)
        self.assertAlmostEqual(ledger["hold_impulse_x"][-1],
                               ledger["momentum_x"][-1] - ledger["pull_impulse_x"][-1],
                               delta=1e-6 * 4e4)
        # The force of each step is the increment of the impulse.
        self.assertEqual(ledger["pulled_force_x"][0], 0.)
        for force, grown in zip(ledger["pulled_force_x"][1:],
                                increments(ledger["pull_impulse_x"])):
            self.assertAlmostEqual(4. * force, grown, delta=1e-9 * 4e4)
        strain = .02
        self.assertAlmostEqual(ledger["pulled_force_x"][-1], 1e4 * strain, delta=.5)
        self.assertAlmostEqual(ledger["stress_stress_xx"][-1], 1e4 * strain, delta=.5)
        self.assertAlmostEqual(ledger["imposed_work"][-1], .5 * 1e4 * strain**2 * 2.,
                               delta=1e-3)
        self.assertLess(largest(ledger["balance_residual"]), 1e-10)

    def test_bars_in_space(self):
        """Two bars end on (examples/colliding_bars.prm): at rest with all energy stored
        when the waves have reached the far ends, parted after twice that time."""
        cells = 30 if is_debug_build() else 60
        ledger = self.run_program(
            "ricochet",
            NO_FIELDS + [f"Body {name}/Cells along={cells}, 1, 1"
                         for name in ("left", "right")],
            prm=ROOT / "examples" / "colliding_bars.prm")
        middle = min(range(len(ledger["time"])),
                     key=lambda n: abs(ledger["time"][n] - 1e-6))
        energy = ledger["energy"][0]
        self.assertAlmostEqual(energy, 1e-4, delta=1e-16)
        self.assertLess(ledger["kinetic_energy"][middle],
                        (.06 if is_debug_build() else .03) * energy)
        for name in ("left", "right"):
            self.assertAlmostEqual(ledger[f"elastic_energy_{name}"][middle], 5e-5,
                                   delta=3e-6 if is_debug_build() else 1.5e-6)
        self.assertAlmostEqual(ledger["left_stress_xx"][middle], -1e8, delta=6e6)
        self.assertAlmostEqual(ledger["motion_of_left_velocity_x"][-1], -100., delta=6.)
        # Accelerations are those of steps, and do not ring.
        for change, acceleration in zip(
                increments(ledger["motion_of_left_velocity_x"]),
                ledger["push_on_left_acceleration_x"][1:]):
            self.assertAlmostEqual(change, 1e-8 * acceleration, delta=1e-9)
        self.assertEqual(ledger["contact_force_ends"][-1], 0.)
        # With the energy stored at the corners of their ends.
        self.assertLess(largest([e - energy for e in ledger["modified_energy"]]),
                        1e-12 * energy)
        self.assertLess(largest([e - energy for e in ledger["energy"]]), .02 * energy)

    def test_points_at_vertices(self):
        """Disks of equal facets, where half of the points in contact are near vertices and each
        oscillates across its own: Newton's method took 861 iterations when points stayed only after
        the pattern of all of them had come back."""
        if is_debug_build():
            self.skipTest("takes long with assertions; other tests run the same")
        disk = """
subsection Body {name}
  set Law           = linear elastic
  set Shape         = disk
  set Cells         = triangles or tetrahedra
  set Radius        = 1
  set Nodes around  = 240
  set Nodes         = 4921
  set Translation   = 0, {place}
  set Velocity      = 0, {speed}
  set Rotation      = {angle}
  set Density       = 1000
  set Young modulus = 1e6
end
"""
        scene = "set Program = ricochet\nset Dimension = 2\n" + "".join(
            disk.format(name=name, place=1.01 * sign, speed=-sign, angle=angle)
            for name, sign, angle in (("first", 1, 0), ("second", -1, 2.2))) + """
subsection Contact middle
  set Surface   = first
  set Against   = second
  set Treatment = persistent contact
end
subsection Mesh
  set Degree = 1
end
subsection Time
  set Time step  = 6e-3
  set Final time = 0.2
end
"""
        # Round-off decides which points oscillate, and with it whether one step is halved: with the
        # kernels that OpenBLAS has for newer processors it is. The counts below are those of a
        # kernel that all processors have.
        with unittest.mock.patch.dict(os.environ, {"OPENBLAS_CORETYPE": "Nehalem"}):
            ledger = self.scene(scene, "Contact middle/Augmentation=1e6")
        self.assertLess(sum(ledger["newton_iterations"]), 600)
        self.assertLess(largest(ledger["balance_residual"]), 1e-12)
        # Points that stay bring gaps of their own, which are small against that of the
        # impact, the displacement of half a step.
        depth = ledger["penetration_middle"]
        self.assertLess(max(depth), 6e-3)
        self.assertLess(max(depth), 1.001 * depth[4])
        self.assertEqual(ledger["step_halvings"][-1], 0)

    def test_pressure_that_follows(self):
        """A ring that is blown up and flies: nothing pushes it as a whole, and the work is
        pressure times volume."""
        text = """
set Program   = ricochet
set Dimension = 2
subsection Body tube
  set Shape        = ring
  set Radius       = 1
  set Inner radius = 0.8
  set Nodes around = 48
  set Velocity     = 1, 2
  set Spin         = 3
end
subsection Condition air
  set Boundary = tube: inner
  set Kind     = pressure
  set Value    = 2e4*min(t/0.1, 1)
end
subsection Time
  set Final time = 0.3
  set Time step  = 5e-3
end
"""
        ledger = self.scene(text)
        energy = ledger["energy"]
        self.assertGreater(ledger["external_work"][-1], .02 * energy[0])
        for row in range(len(energy)):
            self.assertAlmostEqual(energy[row] - energy[0], ledger["external_work"][row],
                                   delta=1e-9 * energy[0])
        momentum = abs(ledger["momentum_x"][0])
        for name in ("momentum_x", "momentum_y"):
            self.assertLess(largest([p - ledger[name][0] for p in ledger[name]]),
                            1e-10 * momentum, msg=name)
        for more, message in (("Time/Scheme=ARKODE", "Allowed with it: Crank-Nicolson, HHT"),
                              ("Body tube/Law=linear elastic", "is for large strains")):
            file = self.folder / "scene.prm"
            code, _, error = self.attempt("ricochet", [more], prm=file,
                                          folder=self.folder / "no")
            self.assertEqual(code, 1)
            self.assertIn(message, " ".join(error.split()))

    def test_shared_material(self):
        """A material by its name is the same as the parameters in the body."""
        own = self.scene(scene(steps=10))
        text = scene(steps=10)
        said = "  set Density       = 1000.0\n  set Young modulus = 1000000.0\n"
        self.assertIn(said, text)
        shared = self.scene(
            text.replace(said, "  set Material = rubber\n", 1) +
            "subsection Material rubber\n" + said + "end\n", name="shared")
        self.assertEqual(own["energy"], shared["energy"])

    def test_advance(self):
        """Bodies that have flown for a while already: 3 m/s towards the floor."""
        a = self.scene(scene(steps=1))
        b = self.scene(scene(steps=1), "Start/Advance=0.01", name="later")
        gap = "smallest_gap_ball_on_floor"
        self.assertAlmostEqual(a[gap][0] - b[gap][0], .03, delta=1e-12)
        self.assertEqual(a["energy"][0], b["energy"][0])

    def test_what_is_found_is_written_down(self):
        self.scene(scene(steps=1))
        text = (self.folder / "scene" / "parameters.prm").read_text()
        log = (self.folder / "scene" / "log.txt").read_text()
        # Ten times (1 - nu) E / ((1 + nu) (1 - 2 nu)) over a cell: 1.346 times 1.697e8 Pa/m.
        self.assertIn("Contact brick at wall/Compliance coefficient = 2284", log)
        self.assertRegex(text, r"set Compliance coefficient = 2284\d+\.\d+")

    def test_what_is_found_for_flat_cells(self):
        """The depth of a cell counts and not its width. It is a tenth of that of the test above,
        which is a square; with the width, Nitsche's method would be refused as unstable."""
        flat = "Body brick/Cells along=160, 1"
        self.scene(scene(steps=1), flat)
        log = (self.folder / "scene" / "log.txt").read_text()
        self.assertRegex(log, r"Contact brick at wall/Compliance coefficient = 2284\d{6}")
        small_strains = ["Body brick/Law=linear elastic", "Body ball/Law=linear elastic"]
        self.scene(scene(steps=1), flat, *small_strains,
                   "Contact brick at wall/Treatment=Nitsche", name="Nitsche")
        log = (self.folder / "Nitsche" / "log.txt").read_text()
        # Twenty times the modulus 4.038e6, and that times the diameter 0.50004 over 0.017678.
        self.assertRegex(log, r"Contact brick at wall/Nitsche gamma0 = 2284\d{6}")


class BadScenes(Refusal):

    def refused_at_once(self):
        if is_debug_build():
            self.skipTest("is refused before anything is computed")

    def refuse_scene(self, old, new, *messages, text=None):
        text = text or scene(steps=1)
        self.assertIn(old, text)
        return self.refuse(*messages, program="ricochet",
                           prm=self.write(text.replace(old, new, 1)))

    def test_names(self):
        self.refused_at_once()
        for old, new, *messages in (
                ("Body ball", "Bdy ball", "line 11: there is no section 'Bdy ball'",
                 "Is 'Body ball' meant?"),
                ("Obstacle wall", "Obstacle", "should be 'Obstacle NAME'"),
                ("Obstacle wall", "Obstacle wa/ll", "should be 'Obstacle NAME'"),
                ("Obstacle wall", "Obstacle ball", "a body is called 'ball', too"),
                ("Contact ball and brick", "Contact brick_at wall",
                 "would be the same in the energy table"),
                ("set Dimension = 2", "", "set Dimension = 2"),
                ("set Dimension = 2", "set Dimension = 4",
                 "Dimension is 2 or 3, not '4'"),
                ("set Surface = ball", "set Surface = bal",
                 "Contact ball on floor/Surface: there is no body 'bal'",
                 "Is 'ball' meant?"),
                ("brick: lower", "brick: lowr", "has no boundary 'lowr'",
                 "Is 'lower' meant?", "left, lower, right, upper"),
                ("set Against = floor", "set Against = flor",
                 "neither a body nor an obstacle 'flor'", "Is 'floor' meant?"),
                ("set Against = floor", "", "has to say what the surface may touch"),
                ("set Against = floor", "set Against = brick; floor",
                 "names bodies and obstacles"),
                ("set Against              = brick: left, upper",
                 "set Against = ball", "for that say 'itself'"),
                ("set Body     = brick", "set Body     = brik", "there is no body"),
                ("brick: lower", "brick:", "names no boundary of the body 'brick'"),
                ("modulus = 3000000.0", "modulus = 1e308",
                 "cannot be found from moduli, density and mesh size"),
                ("set Surface = ball", "set Surface = ball; ball",
                 "the boundary 0 (outer) of the body 'ball' is named twice"),
                ("set Against = floor", "set Against = floor; floor",
                 "names the obstacle 'floor' twice"),
                ("Obstacle wall", "Obstacle itself",
                 "'itself' means something else in contacts"),
                ("Treatment = improved", "Treatment = Nitsche\n  # improved",
                 "Contact brick at wall: The contact treatment 'Nitsche'")):
            with self.subTest(new):
                text = scene(steps=1).replace("Surface = ball", "Surface = ball")
                self.refuse_scene(old if old in text else old.replace(" = ", "   = "),
                                  new, *messages, text=text)

    def test_meshes_and_conditions(self):
        self.refused_at_once()
        for old, new, *messages in (
                ("  set Shape       = rectangle\n", "",
                 "needs either a Body block/File or a Body block/Shape"),
                ("Shape       = rectangle", "File = none.msh", "none.msh"),
                ("Shape       = rectangle", "File = none.xyz", "should end with .msh"),
                ("Shape       = rectangle", "Shape = generator\n"
                 "  set Generator = hyper_bowl", "cannot make 'hyper_bowl'"),
                # deal.II would crash.
                ("Shape       = rectangle", "Shape = generator\n"
                 "  set Generator = cylinder_shell\n"
                 "  set Generator arguments = 1 : 0.5 : 1 : 8 : 2",
                 "cannot make 'cylinder_shell'"),
                ("Shape       = rectangle", "Shape = generator\n"
                 "  set Generator = simplex\n  set Generator arguments = 0, 0",
                 "cannot make 'simplex'"),
                ("Shape       = rectangle", "File = none.inp", "should end with .msh"),
                ("Cells along = ", "Cells along = 100000, 100000 #",
                 "This run has 2e+10 unknowns"),
                ("Size        = 2, 1", "Size        = 2, -1", "2 positive numbers"),
                ("  set Law ", "  set Materials = 3: steel\n  set Law ",
                 "has no cells '3'. There is: 0"),
                ("  set Law ", "  set Materials = 0:\n  set Law ",
                 "'0:' should be 'number or name of the cells"),
                ("  set Law ", "  set Materials = 0: steel; 0: iron\n  set Law ",
                 "gives the cells '0' two materials"),
                ("  set Law ", "  set Materials = 0: steel\n  set Law ",
                 "there is no section 'Material steel'"),
                ("  set Law ", "  set Material = steel\n  set Law ",
                 "Body block/Material: there is no section 'Material steel'"),
                ("subsection Time", "subsection Condition a\n"
                 "  set Boundary = block: left\n  set Kind = traction\n"
                 "  set Value = 1; 2; 3\nend\nsubsection Time",
                 "needs 2 expressions"),
                ("subsection Time", "subsection Condition a\n"
                 "  set Boundary = block: left\n  set Kind = traction\n"
                 "  set Value = 1; z +\nend\nsubsection Time",
                 "cannot be read", "functions of x,y,z and the time t"),
                ("  set Law ", "  set Acceleration = 1,2; 0\n  set Law ",
                 "Body block/Acceleration cannot be read"),
                ("  set Law ", "  set Acceleration = x = 3; 0\n  set Law ",
                 "Body block/Acceleration cannot be read"),
                ("  set Law ", 11 * "subsection a\n" + "  set Law ",
                 "more than ten subsections in each other"),
                ("subsection Time", "subsection Condition a\n"
                 "  set Boundary = block: left\n  set Kind = springs\n"
                 "end\nsubsection Time",
                 "have neither Condition a/Stiffness nor Condition a/Damping"),
                ("subsection Time", "subsection Condition a\n"
                 "  set Boundary = block: left\n  set Components = z\n"
                 "end\nsubsection Time", "'z' is no direction"),
                ("subsection Time", "subsection Condition a\n"
                 "  set Boundary = block: left\nend\n"
                 "subsection Condition b\n  set Boundary = block: left\n"
                 "  set Components = y\nend\nsubsection Time",
                 "prescribes what another one prescribes already, in direction y"),
                ("set Program ", "set Units = mm, t\nset Program ",
                 "Units are those of length, mass and time")):
            with self.subTest(messages[0]):
                self.refuse_scene(old, new, *messages, text=BLOCK)

    def test_two_constraints_on_a_surface(self):
        corner = BLOCK + """
subsection Obstacle floor
  set Shape = half space
end
subsection Obstacle wall
  set Shape = half space
  set Direction = 1, 0
end
subsection Contact both
  set Surface = block
  set Against = floor; wall
end
"""
        self.refuse("are constraints on the same nodes", "penalty", program="ricochet",
                    prm=self.write(corner.replace(
                        "floor; wall\n",
                        "floor; wall\n  set Treatment = Signorini multipliers\n")))
        law = corner.replace("floor; wall\n",
                             "floor; wall\n  set Treatment = penalty\n")
        law = law.replace("  set Law ", "  set Velocity = -1, -1\n  set Law ")
        law = law.replace("modulus = 1e4", "modulus = 1e6")
        ledger = self.run_program("ricochet", NO_FIELDS, prm=self.write(law))
        self.assertGreater(max(ledger["contact_force_both"]), 1.)
        self.assertLess(largest(ledger["balance_residual"]), 1e-11)
        # The ball comes back from both.
        self.assertGreater(ledger["momentum_x"][-1], 0.)
        self.assertAlmostEqual(ledger["momentum_x"][-1] / ledger["momentum_x"][0],
                               -1., delta=.7)

    def test_names_with_all_signs(self):
        """Names with _ and . ended with "an error that should not happen"."""
        self.refused_at_once()
        text = scene(steps=1)
        for old, new in (("Contact ball on floor", "Contact on_the.floor-2"),
                         ("Obstacle floor", "Obstacle bar_CD.20"), ("= floor", "= bar_CD.20")):
            self.assertIn(old, text)
            text = text.replace(old, new)
        result = self.validate(self.write(text))
        self.assertEqual(result.returncode, 0, msg=result.stderr)
        self.assertIn("Contact on_the.floor-2: persistent contact", result.stdout)

    def test_what_is_said_twice_or_without_end(self):
        """Each was misread silently, or never ended."""
        self.refused_at_once()
        self.refuse_scene("", "subsection Obstacle floor\n  set Shape = half space\nend\n",
                          "'Obstacle floor' exists already, in ")
        self.refuse_scene("", "set Time/Final time = 1\n",
                          "line 1: the name 'Time/Final time' has a '/'", "'subsection Time'")
        self.refuse_scene("", "subsection Time\n", "line 1: the subsection", "never closed")
        self.refuse_scene("", "subsection Condition push\n  set Boundary = ball\n"
                          "  set Kind = traction\n  set Value = rand(); 0\nend\n",
                          "has random numbers")
        for k in range(20):
            (self.folder / f"{k}.prm").write_text(f"include {k + 1}.prm\n" * 2)
        (self.folder / "20.prm").write_text("\n")
        self.refuse_scene("", f"include {self.folder}/0.prm\n",
                          "is one of more than 1000 that are included")
        for k in range(120):
            (self.folder / f"{k}.prm").write_text(f"include {k + 1}.prm\n")
        self.refuse_scene("", f"include {self.folder}/0.prm\n",
                          "is included by more than 100 files in each other")

    def test_meshes_without_end(self):
        """Meshes that are never finished, and meshes that no memory holds."""
        self.refused_at_once()
        block = "  set Size        = 2, 1\n  set Cells along = 4, 2\n"
        shape = "  set Shape       = rectangle\n"
        self.assertIn(shape + block, BLOCK)
        os.mkfifo(self.folder / "pipe.geo")
        (self.folder / "loop.geo").write_text("For i In {0:1e9}\n a = i;\nEndFor\n")
        with open(self.folder / "holes.msh", "wb") as file:
            file.truncate(1 << 40)
        generator = "  set Shape = generator\n  set Generator = "
        for mesh, *messages in (
                ("  set File = pipe.geo\n", "pipe.geo' cannot be read"),
                ("  set File = loop.geo\n", "did not come to an end within 2 s",
                 "Limits/Meshing time"),
                ("  set File = holes.msh\n", "holes.msh' has 1099", "memory"),
                (generator + "subdivided_hyper_cube\n"
                 "  set Generator arguments = 40000 : 0 : 1 : false\n",
                 "GridGenerator (Body block/Generator)"),
                (generator + "general_cell\n"
                 "  set Generator arguments = 0, 0; 1, 0 : false\n",
                 "cannot make 'general_cell'")):
            with self.subTest(mesh):
                return self.refuse(*messages, program="ricochet",
                            parameters=["Limits/Meshing time=2"],
                            prm=self.write(BLOCK.replace(shape + block, mesh)))

    def test_messages_for_people(self):
        """Not the words and numbers of compilers; names that begin as the given one."""
        self.refused_at_once()
        for old, new, *messages in (
                ("set Time step  = 0.01", "set Time step = 0",
                 "Allowed: A number above 0"),
                ("set Poisson ratio = 0", "set Poisson ratio = x", "Allowed: A number"),
                ("set Cells along = 4, 2", "set Cells along = 4, x",
                 "Allowed: Any number of values, each a whole number"),
                ("set Poisson ratio = 0", "set Poisson = 0",
                 "The nearest valid names are: Body block/Poisson ratio"),
                ("set Law         = linear elastic", "set File = plate#2.msh",
                 "line 8: a '#' begins a comment, and has a space before it")):
            with self.subTest(new):
                error = self.refuse_scene(old, new, *messages, text=BLOCK)
                self.assertNotRegex(error, "MAX_DOUBLE|2147483647|4294967295")
        # Values that are not finite at the start are an error of the input.
        load = """
subsection Condition pull
  set Boundary = block: right
  set Kind     = traction
  set Value    = 1/t; 0
end
"""
        result = self.validate(self.write(BLOCK + load))
        self.assertEqual(result.returncode, 1, msg=result.stderr)
        self.assertIn("is not finite at t = 0", result.stderr)

    def test_many_contacts(self):
        """More than fit into a byte."""
        self.refused_at_once()
        text = BLOCK
        for k in range(260):
            text += (f"subsection Obstacle o{k}\n  set Shape = half space\n"
                     f"  set Centre = 0, {-1 - k}\nend\nsubsection Contact c{k}\n"
                     f"  set Surface = block\n  set Against = o{k}\n"
                     "  set Treatment = penalty\nend\n")
        self.run_program("ricochet", ["Time/Final time=0.01"] + NO_FIELDS,
                         prm=self.write(text))

    def test_geometries_can_only_read(self):
        """A geometry is a script of Gmsh, and ran commands and wrote files already with
        --validate; options beside it, or in the user's home, made another mesh."""
        self.refused_at_once()
        text = BLOCK.replace("  set Shape       = rectangle\n", "  set File = plate.geo\n")
        text = text.replace("  set Size        = 2, 1\n  set Cells along = 4, 2\n", "")
        plate = 'SetFactory("OpenCASCADE");\nRectangle(1) = {0, 0, 0, 2, 1};\n'
        mark = self.folder / "mark"
        options = self.folder / "plate.geo.opt"
        for script, message in (
                (f'SystemCall "touch {mark}";\n', "a script of geometry may not do"),
                (f'NonBlockingSystemCall "touch {mark}";\n', "may not do"),
                (f'Printf("hello") > "{mark}";\n', "may not do"),
                (f'Mesh 2; Save "{mark}.msh";\n', "may not do"),
                ('Physical Curve("end", 1) = {1}; Physical Curve("end", 2) = {2};\n'
                 'Physical Curve("end", 3) = {3};\n', None),
                ('Physical Curve("2", 1) = {1}; Physical Curve("right", 2) = {2};\n',
                 "calls its physical group 1 '2'")):
            with self.subTest(script=script):
                (self.folder / "plate.geo").write_text(plate + script)
                result = self.validate(self.write(text))
                if message:
                    self.assertEqual(result.returncode, 1, msg=result.stdout)
                    self.assertIn(message, " ".join(result.stderr.split()))
                self.assertEqual(list(self.folder.glob("mark*")), [])
        (self.folder / "plate.geo").write_text(plate)
        home = self.folder / "home"
        home.mkdir()
        (home / ".gmshrc").write_text("Mesh.MeshSizeMax = 0.02;\n")
        (home / ".gmsh-options").write_text("Mesh.MeshSizeMax = 0.02;\n")
        file = self.write(text)
        at_home = subprocess.run([program_path("ricochet"), str(file), "--validate"],
                                 capture_output=True, text=True, cwd=ROOT,
                                 env={**os.environ, "HOME": str(home)})
        self.assertEqual(at_home.stdout, self.validate(file).stdout)
        options.write_text("Mesh.MeshSizeMax = 0.02;\n")
        refused = self.validate(file)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("which Gmsh would follow without a word", refused.stderr)

    def test_what_fails_on_one_rank_ends_all(self):
        """A load that is no number at one end of a block left the other ranks waiting without
        end."""
        text = BLOCK + ("subsection Condition push\n  set Boundary = block: left\n"
                        "  set Kind = traction\n"
                        "  set Value = sqrt(0.1 - t); 0\nend\n")
        for n_ranks in (1, 3):
            code, out, err = self.attempt("ricochet", prm=self.write(text),
                                          n_ranks=n_ranks, options=["--overwrite"])
            self.assertEqual(code, 2, msg=out + err)
            self.assertIn("Condition push/Value is not finite at t = ", err)

    def test_overlap(self):
        self.refused_at_once()
        text = scene(steps=1).replace("set Centre = 0, -0.6", "set Centre = 0, -0.4")
        self.refuse("overlaps with the obstacle of the contact 'ball on floor'",
                    program="ricochet", prm=self.write(text))

    def two_rectangles(self, sizes, places, cells=("3, 1", "3, 1"), more=("", "")):
        """A scene of two bodies that may touch everywhere."""
        text = "set Program = ricochet\nset Dimension = 2\n"
        for name, size, place, along, own in zip("ab", sizes, places, cells, more):
            text += (f"subsection Body {name}\n  set Shape = rectangle\n"
                     f"  set Size = {size}\n  set Cells along = {along}\n"
                     f"  set Translation = {place}\n{own}end\n")
        return self.write(text + "subsection Contact touch\n  set Surface = a\n"
                          "  set Against = b\nend\n")

    def validate(self, file):
        return subprocess.run([program_path("ricochet"), str(file), "--validate"],
                              capture_output=True, text=True, cwd=ROOT)

    def test_overlaps_that_no_node_shows(self):
        """Bodies that cross, one body twice, and one that is smaller by 1e-9 began with the
        energy of their overlap."""
        self.refused_at_once()
        for sizes, places, cells in (
                (("3, 0.3", "0.3, 3"), ("-1.5, -0.15", "-0.15, -1.5"), ("3, 1", "1, 3")),
                (("3, 0.3", "3, 0.3"), ("0, 0", "0, 0"), ("3, 1", "3, 1")),
                (("3, 0.3", "2.999999998, 0.299999998"), ("0, 0", "1e-9, 1e-9"),
                 ("3, 1", "3, 1"))):
            with self.subTest(sizes=sizes):
                result = self.validate(self.two_rectangles(sizes, places, cells))
                self.assertEqual(result.returncode, 1, msg=result.stdout)
                self.assertIn("At the start bodies overlap", result.stderr)

    def test_a_shaft_in_a_bore_of_its_size(self):
        """Facets of two circles of one radius overlap by what chords are off their arc, at most
        R (1 - cos(pi/n)): such a fit was refused. It begins without force and turns in its
        play, whatever the treatment; a larger overlap, and mortar, are refused."""
        def fit(radius, rest):
            text = "set Program = ricochet\nset Dimension = 2\n"
            for name, outer, inner, nodes in (("shaft", radius, .01, 48), ("hub", .03, .02, 40)):
                text += (f"subsection Body {name}\n  set Shape = ring\n"
                         f"  set Radius = {outer}\n  set Inner radius = {inner}\n"
                         f"  set Nodes around = {nodes}\n  set Nodes across = 4\n"
                         "  set Young modulus = 1e9\n  set Density = 1000\n"
                         + ("  set Spin = 200\n" if name == "shaft" else "") + "end\n")
            return self.write(
                text + "subsection Contact seat\n  set Surface = shaft: outer\n"
                f"  set Against = hub: inner\n{rest}end\n"
                "subsection Condition held\n  set Boundary = hub: outer\nend\n"
                "subsection Time\n  set Final time = 2e-3\n  set Time step = 4e-5\nend\n")

        for treatment in ("persistent contact", "penalty", "improved normal compliance"):
            with self.subTest(treatment=treatment):
                ledger = self.run_program("ricochet", NO_FIELDS, prm=fit(
                    .02, f"  set Treatment = {treatment}\n"))
                self.assertEqual(ledger["contact_force_seat"][1], 0.)
                self.assertLess(max(ledger["promise_residual"]), 1e-9)
                spin = ledger["angular_momentum_shaft"]
                self.assertAlmostEqual(spin[-1] / spin[0], 1., places=2)
        note = self.validate(fit(.02, "")).stdout
        self.assertIn("the surfaces overlap by up to", note)
        depth = float(note.split("overlap by up to ")[1].split()[0])
        self.assertLessEqual(depth, .02 * (1. - math.cos(math.pi / 40.)) * (1. + 1e-6))
        for radius, rest in ((.0202, ""), (.02, "  set Coupling = mortar\n")):
            result = self.validate(fit(radius, rest))
            self.assertEqual(result.returncode, 1, msg=result.stdout)
            self.assertIn("At the start bodies overlap", result.stderr)

    def test_gap_and_notes_at_the_start(self):
        """The gap is that of facets, whose nodes are 1 m apart; cells that lock and a linear
        elastic body that turns are named."""
        self.refused_at_once()
        lock = "  set Law = linear elastic\n  set Poisson ratio = 0.4995\n" \
               "  set Plane state = plane strain\n"
        turn = "  set Law = linear elastic\n  set Spin = 2\n"
        result = self.validate(self.two_rectangles(
            ("2, 1", "2, 1"), ("0, 0", "1, 1.0012"), ("1, 1", "1, 1"), (lock, turn)))
        self.assertEqual(result.returncode, 0, msg=result.stderr)
        for text in ("gap at the start 0.0012", "cells of degree 1 are much too stiff",
                     "turns by 2 rad if nothing stops it"):
            self.assertIn(text, result.stdout)

    def test_notes_of_what_is_forgotten(self):
        """Units, a body without contact, a mesh in pieces; where boundaries are, by hand."""
        self.refused_at_once()
        (self.folder / "two.geo").write_text(
            'SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 10, 20};'
            "Rectangle(2) = {0, 21, 0, 10, 5};\n")
        text = """
set Program = ricochet
set Dimension = 2
set Units = mm, t, s
subsection Body part
  set File = two.geo
  set Mesh size = 5
  set Translation = 0, 1
  set Density = 7850
  set Young modulus = 2.1e5
end
subsection Body other
  set Shape = rectangle
  set Cells = triangles or tetrahedra
  set Translation = 30, 1
  set Density = 7.85e-9
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface = part
  set Against = floor
end
subsection Time
  set Final time = 1e-4
  set Time step = 1e-5
end
"""
        result = self.validate(self.write(text))
        self.assertEqual(result.returncode, 0, msg=result.stderr)
        out = result.stdout
        for words in ("the density of 'part' is 7.85e+15 kg/m^3 in Units = mm, t, s, in which that "
                      "of steel is 7.85e-09.",
                      "the mesh of the body 'part' has 2 pieces",
                      "the body 'other' touches nothing",
                      "(right): length 1, middle (31, 1.5), normal (1, 0)"):
            self.assertIn(words, out)
        self.assertNotIn("density of 'other'", out)
        # One of the two; in units of its own the density is right, and too much for the waves.
        text = text.replace("set File = two.geo", "set File = two.geo\n  set Group = 2")
        out = self.validate(self.write(text.replace("set Units = mm, t, s\n", ""))).stdout
        self.assertIn("area 50, mass", out)
        self.assertNotIn("pieces", out)
        self.assertIn("Are its density and Young's modulus in consistent units?", out)
        self.assertNotIn("steel", out)
        # Gmsh would leave out the second rectangle.
        geometry = self.folder / "two.geo"
        geometry.write_text(geometry.read_text().rstrip("\n"))
        self.assertIn("does not end with a new line", self.validate(self.write(text)).stderr)

    def test_validate(self):
        self.refused_at_once()
        result = self.validate(self.write(scene(steps=1)))
        self.assertEqual(result.returncode, 0, msg=result.stderr)
        # Input that a run refuses.
        outside = self.write(BLOCK + "subsection Probe stress\n  set Body = block\n"
                             "  set Quantity = stress\n  set Point = 9, 9\nend\n")
        refused = self.validate(outside)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("Probe stress/Point is not within the body", refused.stderr)
        for line in ("Body brick: 32 cells, 45 vertices, area 0.5, mass 500 kg, middle "
                     "(1.7, -0.34)", "boundary 2 (lower): length 1",
                     "Contact ball on floor: persistent contact, gap at the start 0.1"):
            self.assertIn(line, result.stdout)
        # With a folder, the same beside a mesh, and a picture with the names.
        look = self.folder / "look"
        file = self.write(scene(steps=1))
        result = subprocess.run([program_path("ricochet"), str(file), "--validate",
                                 "--output-dir", str(look)],
                                capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(result.returncode, 0, msg=result.stderr)
        self.assertIn("(lower): length 1, middle (1.7, -0.59), normal (0, -1), number 3 in setup.vtk",
                      (look / "setup.txt").read_text())
        result = subprocess.run([sys.executable, ROOT / "python/bin/ricochet-plot", look],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, msg=result.stderr)
        self.assertGreater((look / "setup.png").stat().st_size, 5000)


# A ring of rubber cord, cut through at one side, falls onto a floor: the slit closes.
SPLIT_RING_GEO = """
SetFactory("OpenCASCADE");
radius = 0.03;
slit   = 0.003;
Torus(1) = {0, 0, 0, radius, 0.005, 2 * Pi - slit / radius};
Rotate {{0, 0, 1}, {0, 0, 0}, slit / radius / 2} { Volume{1}; }
Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 2} { Volume{1}; }
MeshSize{PointsOf{Volume{1};}} = 0.005;
Physical Volume("ring")  = {1};
Physical Surface("skin") = Boundary{Volume{1};};
"""
SPLIT_RING = """
set Program   = ricochet
set Dimension = 3
subsection Body ring
  set File          = split_ring.geo
  set Translation   = 0, 0, 0.0351
  set Velocity      = 0, 0, -3
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact on floor
  set Surface = ring: skin
  set Against = floor
end
subsection Contact ends
  set Surface = ring: skin
  set Against = itself
end
subsection Time
  set Final time = 0.012
  set Time step  = 2e-4
end
"""


class OneThatTouchesItself(ProgramTest):
    """In 3D: self-contact changes neither the energy nor the momenta of a body; the floor does."""

    def run_split_ring(self, *parameters):
        if is_debug_build():
            self.skipTest("a long run")
        (self.folder / "split_ring.geo").write_text(SPLIT_RING_GEO)
        scene = self.folder / "split_ring.prm"
        scene.write_text(SPLIT_RING)
        return self.run_program("ricochet", NO_FIELDS + list(parameters), prm=scene)

    def check_alone(self, ledger):
        """Where the ends touch and the floor does not."""
        energy, momentum = ledger["energy"], ledger["momentum_z"]
        spin, n_alone = ledger["angular_momentum_y"], 0
        for n in range(1, len(momentum)):
            self.assertLess(abs(ledger["balance_residual"][n]), 1e-11)
            if ledger["contact_force_on_floor"][n] > 0.:
                continue
            n_alone += ledger["contact_force_ends"][n] > 0.
            self.assertLess(abs(energy[n] / energy[n - 1] - 1.), 1e-9)
            self.assertLess(abs(momentum[n] - momentum[n - 1]),
                            1e-11 * abs(momentum[0]))
            self.assertLess(abs(spin[n] - spin[n - 1]), 1e-11 * .03 * abs(momentum[0]))
        self.assertGreater(n_alone, 5)

    def test_split_ring(self):
        ledger = self.run_split_ring()
        self.check_alone(ledger)
        # Persistent contact with the floor dissipates no energy either.
        first = ledger["energy"][0]
        for energy in ledger["energy"]:
            self.assertLess(abs(energy / first - 1.), 1e-9)
        # The impulse of the floor is the change of the momentum.
        momentum = ledger["momentum_z"]
        given = sum(2e-4 * force for force in ledger["contact_force_on_floor"])
        self.assertLess(abs(given / (momentum[-1] - momentum[0]) - 1.), 1e-9)

    def test_split_ring_of_degree_2(self):
        """Nodes between vertices touch, too. The floor acts in points of faces."""
        self.check_alone(self.run_split_ring("Mesh/Degree=2",
                                             "Contact on floor/Treatment=penalty",
                                             "Time/Final time=0.0102"))


if __name__ == "__main__":
    main()
