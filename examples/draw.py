#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the pictures of examples/README.md from runs that check.py has made.

    examples/draw.py [NAME...] [--output output/examples]

Bodies in 2D are coloured by von Mises stress, obstacles grey. Bodies in 3D are drawn by the
Python package of Ricochet, cut in halves, or from outside.
"""

import argparse
import math
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "python"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import ricochet  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from matplotlib.patches import Circle, Rectangle  # noqa: E402
from PIL import Image  # noqa: E402
from ricochet import fields, pictures  # noqa: E402

STONE = "#b9b4aa"


def box(x, y, width, height):
    return lambda: Rectangle((x, y), width, height, color=STONE, lw=0)


def circle(x, y, radius):
    return lambda: Circle((x, y), radius, color=STONE, lw=0)


def belt(begin, end, depth):
    """With a mark that goes along: (time) -> patches."""
    def patches(speed):
        def at(time):
            marks = np.arange(begin - 1., end, .05) + speed * time
            return [box(begin, -depth, end - begin, depth)] + [
                (lambda x=x: Rectangle((x, -depth), .004, depth, color="#77736b", lw=0))
                for x in marks if begin < x < end]
        return at
    return patches


def lid_and_groove(time):
    way = 1.3325 * (1. - math.cos(math.pi * time / .02)) / 2.
    top = 5.33 - way
    return [box(-5, -1, 10, 1), box(-5, 0, 1.9, 3.9), box(3.1, 0, 1.9, 3.9),
            box(-5, top, 10, .8)]


FLOOR = {  # parts at rest
    "snap_fit": [circle(36.4, -1.5, 1.5)],
    "gear_pair": [circle(40, 0, 9.98)],
    "dominoes": [box(-.01, -.006, .24, .006)],
    "arch": [box(-1.3, -.1, 2.6, .1)],
    "arch_too_thin": [box(-1.3, -.1, 2.6, .1)],
}
MOVING = {
    "seal_in_groove": lid_and_groove,
    "belt_with_spring": belt(-.05, .4, .02)(.3),
    "suitcase_on_belt": belt(-.1, .75, .05)(.5),
}
# Instants, limits of x and y, and panels beside each other.
PANELS = {
    "newtons_cradle": ([0., .0012, .01], (-.105, .112), (-.022, .022), 1),
    "bowling": ([0., .032, .06, .1], (-.38, 1.15), (-.62, .62), 2),
    "belt_with_spring": ([0., .3, .6], (-.04, .36), (-.02, .07), 1),
    "suitcase_on_belt": ([0., .16, .3], (-.08, .7), (-.05, .23), 1),
    "dominoes": ([0., .12, .22, .34], (-.008, .22), (-.006, .055), 2),
    "gear_pair": ([0., .016], (-20, 68), (-28, 28), 2),
    "snap_fit": ([0., .0345, .0575, .092], (18, 43), (-3.4, 5.2), 2),
    "seal_in_groove": ([0., .01, .02], (-4.6, 4.6), (-.8, 6), 3),
    "arch": ([.4], (-1.25, 1.25), (-.1, 1.15), 1),
    "arch_too_thin": ([.16, .4], (-1.25, 1.25), (-.1, 1.15), 2),
    "tyre_over_kerb": ([0., .22, .3, .6], (-.47, 1.05), (-.1, .7), 2),
}


def draw_plane(run, name, path):
    times, across, along, columns = PANELS[name]
    rows = math.ceil(len(times) / columns)
    width = 8.
    height = width / columns * (along[1] - along[0]) / (across[1] - across[0]) * rows
    figure, axes = plt.subplots(rows, columns, figsize=(width, height + .25 * rows),
                                squeeze=False, layout="constrained")
    grids = [(run.fields(float(time)), float(run.times[np.argmin(abs(run.times - time))]))
             for time in times]
    largest = max(np.percentile(fields.values(grid, "von_mises"), 99.) for grid, _ in grids)
    for panel, (grid, time) in zip(axes.flat, grids):
        places = fields.array_of_points(grid) + fields.displacements(grid)
        stress = fields.values(grid, "von_mises")
        for patch in FLOOR.get(name, []) + MOVING.get(name, lambda _: [])(time):
            panel.add_patch(patch())
        cells, values = [], []
        for c in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(c)
            points = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
            if cell.GetCellType() not in (5, 9):  # of higher order: the corners
                n = 3 if cell.GetNumberOfPoints() in (6, 10) else 4
                points = points[:n]
            cells.append(places[points, :2])
            values.append(np.mean(stress[points]))
        panel.add_collection(PolyCollection(cells, array=np.array(values), cmap="viridis",
                                            clim=(0., largest or 1.), linewidths=0,
                                            antialiased=False))
        panel.set(xlim=across, ylim=along, aspect="equal", xticks=[], yticks=[])
        panel.set_title(f"t = {time:.4g} s", fontsize=8, loc="left", pad=2)
        for side in panel.spines.values():
            side.set_visible(False)
    figure.savefig(path, dpi=160)
    plt.close(figure)


# Instants of bodies of hexahedra that are seen from outside.
OUTSIDE = {"twisted_cubes": [3., 13., 23.]}
HEXAHEDRON = np.array([(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
                       (2, 3, 7, 6), (3, 0, 4, 7)])


def draw_outside(run, times, path):
    """Faces that belong to one cell, the farthest first."""
    grids = [run.fields(time) for time in times]
    largest = max(np.percentile(fields.values(grid, "von_mises"), 99.) for grid in grids)
    towards = np.array([.45, -1., .5]) / np.linalg.norm([.45, -1., .5])
    right = np.cross([0., 0., 1.], towards) / np.linalg.norm(towards[:2])
    up = np.cross(towards, right)
    figure, axes = plt.subplots(1, len(times), figsize=(8., 3.6), layout="constrained")
    for panel, grid, time in zip(axes, grids, times):
        start = fields.array_of_points(grid)
        places = start + fields.displacements(grid)
        stress = fields.values(grid, "von_mises")
        faces = {}
        for c in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(c)
            points = np.array([cell.GetPointId(i) for i in range(8)])
            for face in points[HEXAHEDRON]:
                # Bodies that touch have coincident faces at the start.
                where = np.hstack([start[face], places[face]]).round(7) + 0.
                faces.setdefault(tuple(sorted(map(tuple, where))), []).append(face)
        outer = np.array([own[0] for own in faces.values() if len(own) == 1])
        outer = outer[np.argsort((places[outer].mean(axis=1)) @ towards)]
        flat = np.stack([places @ right, places @ up], axis=-1)
        panel.add_collection(PolyCollection(
            flat[outer], array=stress[outer].mean(axis=1), cmap="viridis",
            clim=(0., largest), edgecolors="#444444", linewidths=.3))
        panel.autoscale_view()
        panel.set(aspect="equal", xticks=[], yticks=[])
        panel.set_title(f"t = {time:.4g} s", fontsize=8, loc="left", pad=2)
        for side in panel.spines.values():
            side.set_visible(False)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw(name, folder, path):
    run = ricochet.Run(folder)
    if name in PANELS:
        draw_plane(run, name, path)
    elif name in OUTSIDE:
        draw_outside(run, OUTSIDE[name], path)
    else:
        pictures.draw_instants(run, "von_mises", path)
    with Image.open(path) as picture:
        small = picture.convert("RGB")
    if small.width > 760:
        small = small.resize((760, small.height * 760 // small.width), Image.LANCZOS)
    small.quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all")
    parser.add_argument("--output", default=HERE.parent / "output" / "examples",
                        type=pathlib.Path, help="folder of the runs")
    options = parser.parse_args()
    names = options.names or sorted(path.stem for path in HERE.glob("*.prm"))
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / f"{name}.png"
            draw(name, options.output / name, path)
            target = HERE / "images" / f"{name}.png"
            target.write_bytes(path.read_bytes())
            print(f"{target.relative_to(HERE.parent)}, {target.stat().st_size // 1000} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
