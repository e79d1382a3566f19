# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacles that move: a plate that is lifted, a drum that turns; runs, motions, pictures."""

import numpy as np
from matplotlib.patches import Polygon

from shared.pictures import GROUND, bare, scale_bar
from shared.runs import QUIET, Run

from .bowl import BOWL, draw_bowl
from .common import SMALL, draw_body, run

UNTIL = 0.6  # s, the end of the runs with smaller steps
STEPS = (4e-3, 2e-3, 1e-3)  # s
# key: colour, the steps of the pictures
MOVING = {"plate": ("#0072B2", (20, 130, 240)), "drum": ("#009E73", (20, 90, 180))}
FILE = {"plate": "rising_plate", "drum": "drum"}


def moving(key, step):
    """The run with the step of the file goes on to the file's end, for the pictures."""
    if step == STEPS[0]:
        return run("O-3", f"{key}_{1e3 * step:g}ms", FILE[key], (*SMALL, "Output/Fields every=10"))
    return Run(
        "O-3",
        f"{key}_{1e3 * step:g}ms",
        "obstacle_course",
        f"obstacle_course/{FILE[key]}.prm",
        (*QUIET, *SMALL, f"Time/Time step={step:g}", f"Time/Final time={UNTIL:g}"),
        cost=4,
    )


MOVES = {(key, step): moving(key, step) for key in MOVING for step in STEPS}


# The motions are those of the parameter files; a check compares the plate with the gaps.


def plate_height(time):
    return 0.2 * (1 - np.cos(4 * time))


def plate_angle(time):
    return 0.2 * np.sin(3 * time)


def drum_angle(time):
    return 1.5 * time


def draw_plate(axes, time):
    half, thickness = 1.05, 0.12
    c, s = np.cos(plate_angle(time)), np.sin(plate_angle(time))
    corners = np.array([(-half, 0), (half, 0), (half, -thickness), (-half, -thickness)])
    turned = corners @ np.array([[c, s], [-s, c]]) + (0, plate_height(time))
    axes.add_patch(Polygon(turned, zorder=1, **GROUND))


def draw_drum(axes, time):
    draw_bowl(axes, 0.16)
    # Bolts show how far the drum has turned.
    for part in range(12):
        angle = drum_angle(time) + (part / 6 - 0.7) * np.pi
        axes.plot(
            *((BOWL + 0.08) * np.array([np.cos(angle), np.sin(angle)])),
            "o",
            color="black" if part == 0 else "white",
            markeredgecolor="0.25",
            markeredgewidth=0.7,
            markersize=5,
            zorder=2,
        )


def draw_moving(axes, key, step):
    """The body on its obstacle; the colour map, and the time."""
    one = MOVES[key, STEPS[0]]
    time = one.read()["time"][step]
    drawn, _ = draw_body(axes, one, step)
    if key == "plate":
        # Initial position of the plate.
        axes.axhline(0, color="0.6", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0)
        draw_plate(axes, time)
        bare(axes, "", (-1.45, 1.15), (-0.36, 1.5))
        scale_bar(axes, -1.37, 1.29, 0.5)
    else:
        draw_drum(axes, time)
        bare(axes, "", (-1.3, 1.3), (-2.24, -0.38))
        scale_bar(axes, -1.22, -0.59, 0.5)
    return drawn, time
