# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacle course at a glance.

Runs of figures O-1 to O-3: a disk rolls down an incline (grey: at the start), runs to and fro in
a bowl, is lifted by a plate and dragged along by a drum, with von Mises stress and the resultant
of the contact force. Cross and dot are fixed to the disk.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure
from shared.pictures import bare, colour_bar, scale_bar

from .bowl import BOWLS, draw_in_bowl
from .common import RADIUS, draw_body, label
from .incline import COS, INCLINE, LAST, SIN, draw_incline
from .moving import MOVES, MOVING, STEPS, draw_moving


def draw():
    figure = plt.figure(figsize=(11, 6), layout="constrained")
    grid = figure.add_gridspec(2, 4, height_ratios=(1.65, 1))
    incline, in_bowl = figure.add_subplot(grid[0, :2]), figure.add_subplot(grid[0, 2:])

    one, last = INCLINE["disk_rolls"], LAST["disk_rolls"]
    time = one.read()["time"]
    x, y = (-0.85, 1.75), (-0.52, 1.08)
    draw_incline(incline, x, y)
    for step in (0, last):
        drawn, middle = draw_body(incline, one, step, ghost=step < last)
        label(incline, middle + (RADIUS + 0.07) * np.array([SIN, COS]), f"{time[step]:.2f} s")
    bare(incline, "a disk rolls down an incline", x, y)
    scale_bar(incline, x[0] + 0.1, y[0] + 0.08, 0.5)

    draw_in_bowl(in_bowl, "without friction, it runs to and fro in a bowl")
    scale_bar(in_bowl, -2.1, -2.15, 0.5)
    colour_bar(drawn, in_bowl.inset_axes((-0.8, 0.05, 1.6, 0.09), transform=in_bowl.transData))

    for column, (key, (_, steps)) in enumerate(MOVING.items()):
        for k, step in enumerate(steps[::2]):
            axes = figure.add_subplot(grid[1, 2 * column + k])
            _, time = draw_moving(axes, key, step)
            axes.set_title(
                f"{'on a rising plate' if key == 'plate' else 'in a turning drum'}, {time:.2f} s",
                fontsize=10,
            )
    return figure


FIGURE = Figure(
    "O-4",
    __doc__,
    [INCLINE["disk_rolls"], BOWLS["persistent"][0], *(MOVES[key, STEPS[0]] for key in MOVING)],
    draw,
)
