#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two linear bodies that meet head on, against one of them that meets the plane between
them: the same motion, except for the meshes. Disks with persistent contact in their nodes on
meshes of several sizes, and the soft sphere with a penalty in the points of its faces.
Besides, one of them that meets a round obstacle instead of the plane.
"""

import argparse
import functools
import pathlib
import tempfile

from measuring import measure

MESHES = pathlib.Path(__file__).resolve().parent.parent / "meshes"

DISK = """
  set Shape        = disk
  set Cells        = triangles or tetrahedra
  set Radius       = 1
  set Nodes around = {around}
  set Nodes        = {nodes}
  set Density       = 1000
  set Young modulus = 1e6
  set Poisson ratio = 0.3
"""
SPHERE = """
  set File = {meshes}/sphere_h4.msh
  set Density       = 1
  set Young modulus = 50
  set Poisson ratio = 0.25
"""
BODY = """
subsection Body {name}
  set Law         = linear elastic
  set Translation = {translation}
  set Velocity    = {velocity}
  set Rotation    = {rotation}
{body}end
"""
CONTACT = """
subsection Contact middle
  set Surface   = first
  set Against   = {other}
  set Treatment = {treatment}
end
"""
PLANE = """
subsection Obstacle plane
  set Shape = half space
end
"""
ROUND = """
subsection Obstacle plane
  set Shape  = {shape}
  set Centre = {centre}
  set Radius = {radius}
end
"""
PERSISTENT = "persistent contact\n  set Augmentation = 1e6"
PENALTY = "penalty\n  set Penalty epsilon0 = 1e-3"


def scene(dim, body, places, speed, treatment, steps, radius=None):
    """One body, or two: where they are along the last axis, and their speeds. With a
    radius the obstacle of one is round."""
    text = f"set Program = ricochet\nset Dimension = {dim}\n"
    axes = ["0"] * (dim - 1)
    # Nodes of disks are not to meet nodes. (The halves of the sphere's mesh differ.)
    angles = (0, 3 if dim == 2 else 0)
    for name, place, sign, angle in zip(("first", "second"), places, (-1, 1), angles):
        text += BODY.format(name=name, body=body,
                            translation=", ".join(axes + [str(place)]),
                            velocity=", ".join(axes + [str(sign * speed)]),
                            rotation=angle)
    is_alone = len(places) == 1
    if radius is not None:
        text += ROUND.format(shape="circle" if dim == 2 else "sphere", radius=radius,
                             centre=", ".join(axes + [str(-radius)]))
    elif is_alone:
        text += PLANE
    text += CONTACT.format(other="plane" if is_alone else "second",
                           treatment=treatment)
    time_step, n_steps = steps
    return text + (f"subsection Mesh\n  set Degree = {dim - 1}\nend\n"
                   f"subsection Time\n  set Time step = {time_step}\n"
                   f"  set Final time = {time_step * n_steps}\nend\n")


def disks(rings, n_bodies, radius=None):
    """The scene of disks with a number of rings of nodes, 200 steps of 1 ms."""
    body = DISK.format(around=6 * rings, nodes=3 * rings * (rings + 1) + 1)
    return scene(2, body, (1.01, -1.01)[:n_bodies], 1, PERSISTENT, (1e-3, 200), radius)


def spheres(n_bodies, radius=None):
    """The scene of soft spheres, 240 steps of 0.1 s."""
    # The mesh stands 2 m above the plane, the other one as much below it.
    return scene(3, SPHERE.format(meshes=MESHES), (0., -44.)[:n_bodies], 1, PENALTY,
                 (.1, 240), radius)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="build/release")
    parser.add_argument("--quick", action="store_true",
                        help="disks of at most 13 000 unknowns, no spheres")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of each run")
    parser.add_argument("--threads", type=int, default=1, help="threads of each rank")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.build_dir) / "ricochet")
    cases = [("disks", functools.partial(disks, rings), 5)
             for rings in ((20, 45) if arguments.quick else (20, 45, 90))]
    if not arguments.quick:
        cases.append(("spheres", spheres, 60))
    print("| bodies | unknowns of one | of two | s in steps, one | two | ratio "
          "| Newton iterations, one | two | s, one before a round obstacle "
          "| iterations |\n|---|---|---|---|---|---|---|---|---|---|")
    for name, scene_of, radius in cases:
        runs = []
        for n_bodies, of_obstacle in ((1, None), (2, None), (1, radius)):
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "scene.prm"
                file.write_text(scene_of(n_bodies=n_bodies, radius=of_obstacle))
                runs.append(measure(program, [], str(file), arguments.ranks,
                                    arguments.threads))
        one, two, before_round = runs
        print(f"| {name} | {one['unknowns']} | {two['unknowns']} "
              f"| {one['seconds']:.3g} | {two['seconds']:.3g} "
              f"| {two['seconds'] / one['seconds']:.2f} "
              f"| {one['iterations']:.0f} | {two['iterations']:.0f} "
              f"| {before_round['seconds']:.3g} | {before_round['iterations']:.0f} |",
              flush=True)


if __name__ == "__main__":
    main()
