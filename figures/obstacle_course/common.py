# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the figures of the obstacle course: runs, and the drawing of a body."""

import numpy as np
from matplotlib.collections import LineCollection

from shared.pictures import outline, snapshot, zero_line
from shared.runs import Run

G = 9.81  # m/s^2
DENSITY = 1000.0  # kg/m^3
RADIUS = 0.5  # m, of all disks

# Stress is shown up to here, in disks; just above the contact there may be more.
STRESS = 40.0  # kPa
ARROW = 3e-5  # m per N, of forces
FORCE = "#E31A1C"

# Conservation, and the order in the time step, need no fine mesh.
SMALL = ("Body/Boundary nodes=32",)


def run(figure, key, file, overrides=(), cost=2.0):
    return Run(
        figure,
        key,
        "obstacle_course",
        f"obstacle_course/{file}.prm",
        ("Output/Log every=0", *overrides),
        cost=cost,
    )


def draw_body(axes, one, step, ghost=False, cross=True, limit=STRESS):
    """A body with its von Mises stress and the resultant of the contact force.

    The cross is made of points that were on two diameters at the start, and the dot was
    above the middle, so that they show how far the body has turned. A ghost is an outline
    only. Returns the colour map, and the centre of the body.
    """
    rest, place, cells, fields = snapshot(one, step)
    x, y = place.T
    middle = (place.min(axis=0) + place.max(axis=0)) / 2
    colour = "0.55" if ghost else "black"
    drawn = None
    if not ghost:
        stress = fields["von_mises"].reshape(-1) / 1e3
        # Images, not thousands of triangles; the colours run from point to point.
        drawn = axes.tripcolor(
            x, y, cells, stress, shading="gouraud", cmap="viridis", vmin=0, vmax=limit, zorder=2
        )
    axes.add_collection(
        LineCollection(place[outline(cells)], colors=colour, linewidths=0.9, zorder=3)
    )
    if cross:
        local = rest - (rest.min(axis=0) + rest.max(axis=0)) / 2
        for coordinate in local.T:
            axes.add_collection(
                LineCollection(
                    zero_line(place, cells, coordinate),
                    colors=colour if ghost else "white",
                    linewidths=0.9,
                    zorder=3,
                )
            )
        dot = place[np.linalg.norm(local - (0, RADIUS / 2), axis=1).argmin()]
        axes.plot(*dot, "o", color=colour if ghost else "white", markersize=4, zorder=3)
    forces = fields["contact_force"][:, :2].astype(float)
    size = np.linalg.norm(forces, axis=1)
    if not ghost and size.sum() > 0:
        foot = size @ place / size.sum()
        axes.annotate(
            "",
            xy=foot + ARROW * forces.sum(axis=0),
            xytext=foot,
            arrowprops={
                "arrowstyle": "-|>",
                "color": FORCE,
                "linewidth": 2.0,
                "shrinkA": 0,
                "shrinkB": 0,
            },
            zorder=5,
        )
    return drawn, middle


def label(axes, place, text):
    axes.text(*place, text, ha="center", va="center", fontsize=8, zorder=6)
