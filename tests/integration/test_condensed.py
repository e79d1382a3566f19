# SPDX-License-Identifier: LGPL-2.1-or-later
"""Newton's method on contact alone: the same results as with the whole body, for two
solutions with the body's factorisation in each stage of a step."""

import math
import os
import re
from unittest import mock

from common import *

WHOLE = ["Linear solver/Type=direct"]
CONDENSED = NO_FIELDS + ["Linear solver/Type=condensed", "Output/Timing=true"]
COARSE = CONDENSED + ["Mesh/Mesh size=14", "Time/Final time=12"]
NODES = ["Mesh/Degree=1", "Mesh/Mesh size=9"]
OBLIQUE = ["Contact/Friction coefficient=0.3",
           "Start/Initial velocity=1, 0.4, 0"]


def distributed(parameters):
    """On all ranks, where condensed stages are on one."""
    return [entry for entry in parameters if entry != "Linear solver/Type=condensed"] + [
        "Linear solver/Distribute=true"]


# Dissipation is round-off by itself, and a multiplier that is zero up to round-off may count as a
# pressed point or not.
NOT_COMPARED = (*NOISE, "numerical_dissipation")


def case(program, treatment, scheme, *others):
    parameters = SCHEMES[scheme] + [f"Contact/Treatment={treatment}", *others]
    if program == "sphere":
        return program, COARSE + parameters
    return program, CONDENSED + ["Time/Final time=3"] + parameters


CASES = [
    case("sphere", "Nitsche", "CN"),
    case("sphere", "Nitsche", "CN", "Contact/Nitsche theta=-1"),
    case("sphere", "Nitsche", "TR-BDF2", "Contact/Nitsche theta=0"),
    case("sphere", "Nitsche-hybrid", "midpoint"),
    case("sphere", "penalty", "HHT 0.05"),
    case("sphere", "proximal augmented Lagrangian", "TR-BDF2"),
    case("sphere", "improved normal compliance", "midpoint", *NODES, *OBLIQUE),
    case("sphere", "Hauret-Le Tallec", "midpoint", *NODES, *OBLIQUE),
    case("sphere", "Signorini multipliers", "CN", *NODES),
    # Treatments that replace rows of the body.
    case("sphere", "Signorini active set", "TR-BDF2", *NODES),
    case("sphere", "persistent contact", "midpoint", *NODES, *OBLIQUE),
    case("sphere", "Ayyad-Barboteu two-step", "midpoint", *NODES, *OBLIQUE),
    # Where closed points differ by the equations of their multipliers.
    case("sphere", "Signorini multipliers", "midpoint", *NODES, *OBLIQUE),
    case("bar_ss", "Signorini active set", "HHT 0.05", "Time/Mass=redistributed"),
    case("bar_sd", "persistent contact", "midpoint"),
    case("bar_sd", "Nitsche", "TR-BDF2", "Time/Mass=redistributed"),
    case("bar_ss", "Nitsche", "HHT 0.05", "Time/Mass=redistributed"),
    case("bar_ss", "proximal augmented Lagrangian", "CN"),
    case("bar_ss", "standard normal compliance", "CN"),
    # The bar is clamped at one end: its matrix is not quite symmetric.
    case("bar_sd", "Signorini multipliers", "TR-BDF2"),
    case("bar_sd", "penalty", "midpoint"),
]

# Two bodies, each the slave of the other: contact acts on all unknowns of their surfaces.
DISKS = NO_FIELDS + ["Material/Law=linear elastic", "Output/Timing=true",
                     "Disks/Offset=0.3"]
SPHERES = NO_FIELDS + ["Material/Law=linear elastic", "Output/Timing=true",
                       "Spheres/Mesh size of the left sphere=0.6",
                       "Spheres/Mesh size of the right sphere=0.5"]
PAIRS = [
    ("colliding_disks", DISKS + ["Contact/Treatment=penalty"]),
    ("colliding_disks", DISKS + ["Contact/Treatment=persistent contact",
                                 "Contact/Coupling=dual mortar",
                                 "Contact/Friction coefficient=0.3"]),
    ("colliding_disks", DISKS + ["Contact/Treatment=Signorini active set",
                                 "Contact/Coupling=mortar"]),
    ("colliding_disks", DISKS + ["Contact/Treatment=Ayyad-Barboteu two-step"]),
    ("colliding_spheres", SPHERES + ["Contact/Treatment=improved normal compliance",
                                     "Contact/Friction coefficient=0.2"]),
    ("colliding_spheres", SPHERES + ["Contact/Treatment=persistent contact"]),
]

# A ball rolls on a floor into another one, which is in front of a wall: four contacts.
SEVERAL = """
set Program   = ricochet
set Dimension = 2
subsection Time
  set Final time = 0.006
  set Time step  = 1e-4
end
subsection Body left
  set Shape         = disk
  set Radius        = 0.02
  set Nodes around  = {nodes}
  set Translation   = -0.041, 0
  set Velocity      = 1, -0.3
  set Law           = {law}
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Body right
  set Shape         = disk
  set Radius        = 0.02
  set Nodes around  = {nodes}
  set Rotation      = 0.1
  set Law           = {law}
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Obstacle floor
  set Shape  = half space
  set Centre = 0, -0.0201
end
subsection Obstacle wall
  set Shape     = half space
  set Centre    = 0.0202, 0
  set Direction = -1, 0
end
subsection Contact left on floor
  set Surface              = left
  set Against              = floor
  set Treatment            = {left_on_floor}
  set Friction coefficient = 0.3
end
subsection Contact right on floor
  set Surface   = right
  set Against   = floor
  set Treatment = penalty
end
subsection Contact right at wall
  set Surface   = right
  set Against   = wall
  set Treatment = {right_at_wall}
end
subsection Contact balls
  set Surface              = left
  set Against              = right
  set Treatment            = {treatment}
  set Friction coefficient = 0.2
end
"""

# Two disks that are mirror images of each other, so that each node meets a node. Points are at
# vertices, where full steps of Newton's method oscillate and shortened ones converge slowly.
NODES_BEFORE_NODES = "\n".join(["set Program = ricochet", "set Dimension = 2"] + [f"""
subsection Body {name}
  set Shape         = disk
  set Radius        = 1
  set Cells         = triangles or tetrahedra
  set Nodes around  = 270
  set Nodes         = 6211
  set Translation   = 0, {1.01 * side}
  set Velocity      = 0, {-side}
  set Law           = linear elastic
  set Density       = 1000
  set Young modulus = 1e6
end""" for name, side in (("upper", 1), ("lower", -1))] + ["""
subsection Contact between
  set Surface             = upper
  set Against             = lower
  set Treatment           = improved normal compliance
  set Compliance exponent = 3
end
subsection Time
  set Final time = 0.2
  set Time step  = 1e-3
end
"""])

# A ball that falls on another one, which moves and turns: directions of contact turn.
TURNING = """
set Program   = ricochet
set Dimension = {dim}
subsection Time
  set Final time = 0.006
  set Time step  = 1e-4
end
subsection Mesh
  set Degree = {degree}
end
subsection Body ball
{mesh}
  set Radius        = 0.02
  set Velocity      = {velocity}
  set Law           = linear elastic
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Obstacle round
{shape}
  set Radius          = 0.03
  set Rotation        = 20*t
end
subsection Contact below
  set Surface              = ball
  set Against              = round
end
"""
BALLS = {
    2: {"mesh": "  set Shape = disk\n  set Nodes around = 64", "degree": 1,
        "velocity": "0.3, -1",
        "shape": "  set Shape = circle\n  set Centre = 0.002, -0.0505\n"
                 "  set Rotation centre = 0.002, -0.0505\n"
                 "  set Translation = 0.2*t; 0.3*t"},
    3: {"mesh": "  set Shape = ball\n  set Mesh size = 0.006", "degree": 1,
        "velocity": "0.3, 0.1, -1",
        "shape": "  set Shape = sphere\n  set Centre = 0.002, 0.001, -0.0505\n"
                 "  set Rotation centre = 0.002, 0.001, -0.0505\n"
                 "  set Translation = 0.2*t; 0; 0.3*t"}}
FRICTION = "Contact below/Friction coefficient=0.3"
TURNING_CASES = [
    (2, 1, "Nitsche", "Time/Scheme=TR-BDF2"),
    (2, 1, "Nitsche", "Contact below/Nitsche theta=-1"),
    (2, 2, "Nitsche-hybrid"),
    (2, 2, "penalty", FRICTION),
    (2, 1, "proximal augmented Lagrangian", "Time/Scheme=HHT"),
    (2, 1, "Signorini active set", "Time/Scheme=TR-BDF2"),
    (2, 1, "Signorini multipliers"),
    (3, 1, "penalty", FRICTION),
    (3, 1, "improved normal compliance", FRICTION),
    (3, 1, "Signorini active set"),
    (3, 1, "persistent contact", FRICTION),
    (3, 1, "Ayyad-Barboteu two-step", FRICTION),
    (3, 1, "Signorini multipliers", FRICTION),
]


class Condensed(ProgramTest):

    def compare(self, one, other, tolerance):
        self.assertEqual(one.names, other.names)
        for name in one.names:
            if name in NOT_COMPARED or name.startswith("active_points"):
                continue
            values = [(a, b) for a, b in zip(one[name], other[name])
                      if not (math.isnan(a) and math.isnan(b))]
            # Open points have a penetration of round-off only, and forces without work the
            # round-off of the energies.
            floor = (1e-2 * max(abs(energy) for energy in one["energy"])
                     if "work" in name or "momentum" in name or is_part_of_energy(name)
                     else 1e-4)
            scale = max([abs(a) for a, _ in values] + [floor])
            self.assertLess(max([abs(a - b) for a, b in values] + [0.]) / scale,
                            tolerance, msg=name)

    def substitutions(self, folder):
        return int(re.search(r"back-substitutions \S+ s \((\d+)\)",
                             (folder / "log.txt").read_text()).group(1))

    def factorisations(self, folder):
        return int(re.search(r"(\d+) factorisations",
                             (folder / "log.txt").read_text()).group(1))

    def test_same_results_with_two_solutions_a_stage(self):
        cases = CASES[1:11:3] if is_debug_build() else CASES
        runs = []
        for number, (program, parameters) in enumerate(cases):
            for way, more in (("condensed", []), ("whole", WHOLE)):
                runs.append((f"{number}-{way}", program, parameters + more))
        ledgers = dict(self.run_many(runs))
        for number, (program, parameters) in enumerate(cases):
            with self.subTest(f"{program} " + " ".join(parameters)):
                one, other = (ledgers[f"{number}-{way}"]
                              for way in ("condensed", "whole"))
                self.compare(one, other, 1e-9)
                self.assertEqual(set(other["solver"][1:]), {1.})
                if program != "sphere":
                    # One or two points that a stiff law presses deep at the guess:
                    # round-off there costs an iteration with the whole body.
                    continue
                self.assertLessEqual(set(one["solver"][1:]), {4., 4. + 32.})
                # One more for the initial acceleration, and few for stages whose
                # residual in the end was not small enough.
                stages = len(one["time"]) - 1
                if re.search("TR-BDF2|two-step", " ".join(parameters)):
                    stages *= 2
                spent, spent_before = (
                    self.substitutions(self.folder / f"case-{2 * number + k}")
                    for k in (0, 1))
                self.assertLessEqual(spent, 2 * stages + 1 + stages // 20)
                self.assertLess(spent, spent_before)

    def test_two_bodies_with_two_solutions_a_stage(self):
        pairs = PAIRS[1::4] if is_debug_build() else PAIRS
        runs = []
        for number, (program, parameters) in enumerate(pairs):
            for solver in ("condensed", "direct"):
                runs.append((f"{number}-{solver}", program,
                             parameters + [f"Linear solver/Type={solver}"]))
        ledgers = dict(self.run_many(runs))
        for number, (program, parameters) in enumerate(pairs):
            with self.subTest(f"{program} " + " ".join(parameters)):
                one, other = (ledgers[f"{number}-{solver}"]
                              for solver in ("condensed", "direct"))
                self.compare(one, other, 1e-8)
                # One solution in flight, two in contact, for each pass.
                passes = 2 if "two-step" in " ".join(parameters) else 1
                spent, spent_before = (
                    self.substitutions(self.folder / f"case-{2 * number + k}")
                    for k in (0, 1))
                self.assertLessEqual(spent, 2 * passes * (len(one["time"]) - 1))
                self.assertLess(spent, .6 * spent_before)

    def test_nodes_before_nodes(self):
        """Newton's method does not give up on contact alone: no stage needs the whole
        body's."""
        if is_debug_build():
            self.skipTest("a fine mesh, and the same code as elsewhere")
        scene = self.folder / "scene.prm"
        scene.write_text(NODES_BEFORE_NODES)
        ledger = self.run_program("ricochet", CONDENSED, self.folder / "out", prm=scene)
        self.assertLess(largest(ledger["balance_residual"]), 1e-12)
        # With sharp vertices there are steps with more than 30.
        self.assertLess(max(ledger["newton_iterations"]), 15)
        self.assertLessEqual(self.substitutions(self.folder / "out"),
                             len(ledger["time"]) - 1 + 2)

    def test_directions_that_turn(self):
        """Against curved obstacles that move, too; on two ranks, and resumed."""
        cases = TURNING_CASES[3:11:7] if is_debug_build() else TURNING_CASES
        for number, (dim, degree, treatment, *more) in enumerate(cases):
            with self.subTest(f"{dim}D, {treatment} " + " ".join(more)):
                scene = self.folder / f"{number}.prm"
                scene.write_text(TURNING.format(dim=dim, **{**BALLS[dim],
                                                            "degree": degree}))
                parameters = CONDENSED + more + [
                    f"Contact below/Treatment={treatment}", "Output/Checkpoint every=1000"]
                run = lambda name, parameters=parameters, **how: self.run_program(
                    "ricochet", parameters, self.folder / f"{number}-{name}", prm=scene,
                    **how)
                one, other = run("condensed"), run("whole", parameters + WHOLE)
                self.compare(one, other, 1e-9)
                self.assertLess(largest(one["balance_residual"]), 1e-12)
                self.assertGreater(max(one["contact_force_below"]), 0.)
                self.assertGreater(largest(one["obstacle_work"]), 0.)
                stages = len(one["time"]) - 1
                if re.search("TR-BDF2|two-step", " ".join([treatment, *more])):
                    stages *= 2
                self.assertLessEqual(
                    self.substitutions(self.folder / f"{number}-condensed"),
                    2 * stages + 1 + stages // 20)
                if number in (7, 10):
                    self.compare(one, run("ranks", distributed(parameters), n_ranks=2), 1e-9)
                    run("parts", parameters + ["Time/Final time=0.004"])
                    run("parts", options=["--resume"])
                    self.assertEqual(
                        *((self.folder / f"{number}-{name}" / "energy.csv").read_text()
                          for name in ("condensed", "parts")))

    def test_several_ranks(self):
        """One rank condenses and the others wait: the same digits as when it is alone. On
        all ranks the whole system: the same results. Points of one rank act on surfaces of
        others, and on three ranks one has a part of each."""
        cases = [(PAIRS[1], 3), (PAIRS[4], 2), (CASES[0], 2), (CASES[6], 2),
                 (CASES[10], 2), (CASES[12], 2), (CASES[20], 2)]
        for (program, parameters), n_ranks in cases[:2 if is_debug_build() else None]:
            with self.subTest(" ".join(parameters)):
                one, all_ranks = (
                    self.run_program(program, more, self.folder / f"{n}", n_ranks=n)
                    for n, more in ((1, parameters), (n_ranks, distributed(parameters))))
                self.compare(one, all_ranks, 1e-8)
        together = self.folder / "together"
        self.run_program(program, parameters, together, n_ranks=n_ranks)
        self.assertEqual(*((folder / "energy.csv").read_text()
                           for folder in (self.folder / "1", together)))
        self.assertIn("1 MPI rank(s): the others wait", (together / "log.txt").read_text())
        self.assertIn("2 MPI rank(s)\n", (self.folder / "2" / "log.txt").read_text())

    def test_one_rank_that_fails(self):
        """The others end with its exit code, and a signal is its own."""
        program, parameters = PAIRS[1]
        for more, exit_code in ((["Limits/Memory=1e-9"], 1),
                                (["Newton/Maximum iterations=1",
                                  "Time/Maximum halvings=0"], 2)):
            code, out, err = self.attempt(program, parameters + more, n_ranks=2,
                                          options=["--overwrite"])
            self.assertEqual(code, exit_code, msg=out + err)
            self.assertEqual(err.count(f"{program}: "), 1, msg=err)

    def test_same_digits_on_two_threads(self):
        """Solutions of bodies, factorisations of dense systems, and search and evaluation of points
        by one thread or by two. The rings of the disks are so many that their matrices are cut."""
        disks = ["Disks/Rings of the left disk=20", "Disks/Rings of the right disk=23"]
        spheres = ["Spheres/Offset=0.3", "Time/Final time=0.1"]
        cases = [PAIRS[4], (PAIRS[3][0], PAIRS[3][1] + disks),
                 ("colliding_spheres", PAIRS[5][1] + spheres +
                  ["Contact/Friction coefficient=0.3"]),
                 ("colliding_spheres", NO_FIELDS + spheres +
                  ["Contact/Treatment=penalty"])]
        for number, (program, parameters) in enumerate(
                cases[:1] if is_debug_build() else cases):
            with self.subTest(f"{program} " + " ".join(parameters)):
                texts = []
                for n_threads in ("1", "2"):
                    folder = self.folder / f"{number}-{n_threads}"
                    with mock.patch.dict(os.environ, OMP_NUM_THREADS=n_threads):
                        ledger = self.run_program(program, parameters, folder)
                    texts.append((folder / "energy.csv").read_text())
                penetration = next(name for name in ledger.names
                                   if name.startswith("penetration"))
                self.assertGreater(max(ledger[penetration]), 0.)
                self.assertEqual(*texts)

    def test_resumed_digit_for_digit(self):
        for number, (program, parameters), middle in ((2, CASES[2], "8"),
                                                      (6, CASES[6], "8"),
                                                      (10, CASES[10], "8"),
                                                      (16, PAIRS[1], "0.1")):
            parameters = parameters + ["Output/Checkpoint every=100"]
            whole = self.folder / f"whole-{number}"
            parts = self.folder / f"parts-{number}"
            self.run_program(program, parameters, whole)
            self.run_program(program, parameters + [f"Time/Final time={middle}"],
                             parts)
            self.run_program(program, parameters, parts, options=["--resume"])
            self.assertEqual((whole / "energy.csv").read_text(),
                             (parts / "energy.csv").read_text())
            if is_debug_build():
                break

    def test_several_contacts(self):
        """Contact dofs of several contacts, one list behind the other: linear bodies with at most
        two solutions a stage, nonlinear ones with one factorisation a step."""
        compliance, persistent = "improved normal compliance", "persistent contact"
        two_step = "Ayyad-Barboteu two-step"
        cases = [("linear elastic", 32, compliance, compliance, compliance),
                 ("linear elastic", 32, persistent, compliance, compliance),
                 # These take rows in which others act.
                 ("linear elastic", 32, compliance, persistent, persistent),
                 ("linear elastic", 32, "penalty", persistent, two_step),
                 ("Saint Venant-Kirchhoff", 64, "penalty", compliance, compliance),
                 ("Saint Venant-Kirchhoff", 64, "penalty", persistent, persistent)]
        for number, (law, nodes, treatment, left, right) in enumerate(cases):
            if is_debug_build() and number != 2:
                continue
            with self.subTest(f"{law}, {treatment}, {left}, {right}"):
                scene = self.folder / f"{number}.prm"
                scene.write_text(SEVERAL.format(law=law, nodes=nodes,
                                                treatment=treatment,
                                                left_on_floor=left,
                                                right_at_wall=right))
                parameters = NO_FIELDS + ["Output/Timing=true"]
                if law == "linear elastic":
                    parameters.append("Linear solver/Type=condensed")
                one, other = (self.run_program("ricochet", parameters + more,
                                               self.folder / f"{number}-{way}",
                                               prm=scene)
                              for way, more in (("condensed", []), ("whole", WHOLE)))
                self.compare(one, other, 1e-9)
                for contact in ("left_on_floor", "right_on_floor", "right_at_wall",
                                "balls"):
                    self.assertGreater(max(one[f"contact_force_{contact}"]), 0.)
                folder = self.folder / f"{number}-condensed"
                if number in (0, 4):
                    other = self.run_program("ricochet", distributed(parameters),
                                             self.folder / f"{number}-ranks", prm=scene,
                                             n_ranks=2)
                    self.compare(one, other, 1e-8)
                steps = len(one["time"]) - 1
                if law == "linear elastic":
                    passes = 2 if right == two_step else 1
                    self.assertLessEqual(self.substitutions(folder),
                                         2 * passes * steps + 1 + steps // 20)
                else:
                    self.assertLessEqual(self.factorisations(folder), steps + 1)

    def test_bodies_with_large_strains(self):
        """One tangent for some steps: the same results, and the same digits when resumed,
        wherever a tangent began to serve."""
        ring = NO_FIELDS + ["Linear solver/Type=condensed", "Output/Timing=true",
                            "Mesh/Nodes around=64", "Mesh/Nodes across=4",
                            "Start/Initial gap=0.15", "Output/Checkpoint every=1000"]
        cases = [["Contact/Compliance exponent=3", "Contact/Friction coefficient=0.2"],
                 ["Contact/Treatment=Signorini multipliers"]]
        for number, case in enumerate(cases[1:] if is_debug_build() else cases):
            with self.subTest(" ".join(case)):
                run = lambda name, end, *more, **how: self.run_program(
                    "hyperelastic_ring", ring + case + [f"Time/Final time={end}", *more],
                    self.folder / f"{number}-{name}", **how)
                one = run("one", .2)
                self.compare(one, run("whole", .2, *WHOLE), 1e-9)
                self.assertLess(self.factorisations(self.folder / f"{number}-one"),
                                .75 * len(one["time"]))
                run("parts", .1)
                for stop in (.11, .12, .2):
                    run("parts", stop, options=["--resume"])
                self.assertEqual(*((self.folder / f"{number}-{name}" / "energy.csv")
                                   .read_text() for name in ("one", "parts")))

    def test_bodies_with_large_strains_on_two_ranks(self):
        """All of the tangent: the same results, and the same digits when resumed."""
        ring = NO_FIELDS + ["Linear solver/Type=condensed", "Output/Timing=true",
                            "Mesh/Nodes around=64", "Mesh/Nodes across=4",
                            "Start/Initial gap=0.15", "Output/Checkpoint every=1000"]
        cases = [["Contact/Compliance exponent=3", "Contact/Friction coefficient=0.2"],
                 ["Contact/Treatment=persistent contact"]]
        for number, case in enumerate(cases[:1] if is_debug_build() else cases):
            with self.subTest(" ".join(case)):
                run = lambda name, end, ring=ring, **how: self.run_program(
                    "hyperelastic_ring", ring + case + [f"Time/Final time={end}"],
                    self.folder / f"{number}-{name}", **how)
                both = distributed(ring)
                one, two = run("one", .2), run("two", .2, both, n_ranks=2)
                self.compare(one, two, 1e-9)
                self.assertGreater(max(one["active_points_foundation"]), 0)
                run("parts", .12, both, n_ranks=2)
                run("parts", .2, both, n_ranks=2, options=["--resume"])
                self.assertEqual(*((self.folder / f"{number}-{name}" / "energy.csv")
                                   .read_text() for name in ("two", "parts")))

    def test_two_bodies_with_large_strains(self):
        """Each the slave of the other: one factorisation a step, the same results as with
        the whole tangents, on two ranks too, and the same digits when resumed."""
        disks = NO_FIELDS + ["Output/Timing=true", "Disks/Offset=0.3",
                             "Output/Checkpoint every=1000"]
        cases = [["Contact/Treatment=persistent contact"],
                 ["Contact/Treatment=penalty", "Contact/Friction coefficient=0.3"]]
        end = ["Time/Final time=0.08"]
        for number, case in enumerate(cases[:1] if is_debug_build() else cases):
            with self.subTest(" ".join(case)):
                name = str(self.folder / f"disks-{number}")
                one = self.run_program("colliding_disks", disks + case + end,
                                       self.folder / f"{name}-one")
                for more, ranks in (WHOLE, 1), (distributed([]), 2):
                    self.compare(one, self.run_program(
                        "colliding_disks", disks + case + end + more,
                        self.folder / f"{name}-whole-{ranks}", n_ranks=ranks), 1e-8)
                self.assertLess(max(abs(b) for b in one["balance_residual"]), 1e-11)
                log = (self.folder / f"{name}-one" / "log.txt").read_text()
                self.assertIn("condensed to contact", log)
                self.assertLessEqual(self.factorisations(pathlib.Path(f"{name}-one")),
                                     len(one["time"]))
                parts = self.folder / f"{name}-parts"
                self.run_program("colliding_disks",
                                 disks + case + ["Time/Final time=0.04"], parts)
                self.run_program("colliding_disks", disks + case + end, parts,
                                 options=["--resume"])
                self.assertEqual(
                    (self.folder / f"{name}-one" / "energy.csv").read_text(),
                    (parts / "energy.csv").read_text())


if __name__ == "__main__":
    main()
