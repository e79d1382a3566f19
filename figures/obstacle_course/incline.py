# SPDX-License-Identifier: LGPL-2.1-or-later
"""Block and disk on an incline: their runs, and the ground."""

import numpy as np
from matplotlib.patches import Polygon

from shared.pictures import GROUND

from .common import run

# tan(beta) = 1/2
COS, SIN = 2 / np.sqrt(5), 1 / np.sqrt(5)
INCLINE_NODES = 256  # of the disks
BLOCK_STRESS = 8.0  # kPa, the largest shown in a block
# Pictures at the start and at the end, with its number of steps, are enough.
LAST = {"block_slides": 200, "block_sticks": 200, "disk_rolls": 60, "disk_slips": 60}
INCLINE = {
    key: run("O-1", key, key, (f"Output/Fields every={last}",), 70 if "disk" in key else 6)
    for key, last in LAST.items()
}
FRICTION = {"block_slides": 0.49, "block_sticks": 0.51, "disk_rolls": 0.18, "disk_slips": 0.15}
COLOUR = {
    "block_slides": "#D55E00",
    "block_sticks": "#0072B2",
    "disk_rolls": "#009E73",
    "disk_slips": "#CC79A7",
}
NAME = {key: key.replace("_", " ") for key in INCLINE}


def draw_incline(axes, x, y):
    """The ground below x + 2 y = 0."""
    corners = [(x[0], -x[0] / 2), (x[1], -x[1] / 2), (x[1], y[0] - 1), (x[0], y[0] - 1)]
    axes.add_patch(Polygon(corners, zorder=1, **GROUND))
