# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sliding block on a strip.

Two elastic bodies with exact Coulomb friction. Left: on the level the block is slowed down by
mu g. Middle: the weight acts at once; without viscosity its vibrations stay. Right: a slope
of 1/2, with friction just below and just above it; without viscosity the block hops and never
sticks. Below: the block and the strip, with von Mises stress.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.pictures import GROUND, bare, colour_bar, draw_cells, outline, scale_bar, snapshot
from shared.rows import checks_of_runs

from .common import (
    BLOCK_MASS,
    G,
    LEVEL,
    ON_SLOPE,
    SIN,
    SPEED,
    by_hand,
    motion,
    slope_of,
    stop,
    stopped,
)

STEP = 150
MU_COLOUR = {"0.1": "#0072B2", "0.3": "#D55E00", "0.49": "#D55E00", "0.51": "#0072B2"}


def draw_block(axes, step, ghost=False):
    _, place, cells, fields = snapshot(LEVEL["0.3", True], step)
    if ghost:
        mine = cells[fields["part of cells"] == 0]
        axes.add_collection(LineCollection(place[outline(mine)], colors="0.5", linewidths=0.9))
        return None
    return draw_cells(axes, place, cells, fields["von_mises of cells"] / 1e3, 12, False)


def draw():
    figure = plt.figure(figsize=(14, 8.2), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(1, 0.75))
    level, force, slope = (figure.add_subplot(grid[0, k]) for k in range(3))
    for (mu, damped), one in LEVEL.items():
        time, values = motion(one)
        style = {"color": MU_COLOUR[mu], "linewidth": 1.6 if damped else 0.8}
        text = rf"$\mu$ = {mu}" + ("" if damped else ", no viscosity")
        level.plot(time, values, linestyle="-" if damped else (0, (4, 1)), label=text, **style)
    for mu in ("0.1", "0.3"):
        level.plot([0, stop(mu)], [SPEED, 0], color="black", linestyle=(0, (1, 2)), linewidth=1)
    level.plot([], [], color="black", linestyle=(0, (1, 2)), linewidth=1, label=r"slope $-\mu g$")
    level.set_title("on the level")
    level.set_ylabel("velocity (m/s)")
    level.set_xlim(0, 2.4)
    for damped, colour in ((False, "0.6"), (True, "#D55E00")):
        table = LEVEL["0.3", damped].read()
        force.plot(
            table["time"],
            table["contact_force_block"] / (BLOCK_MASS * G),
            color=colour,
            linewidth=1,
            label="with viscosity" if damped else "no viscosity",
        )
    force.set_title(r"on the level, $\mu$ = 0.3")
    force.set_ylabel("contact force / weight")
    force.set_xlim(0, 1.2)
    for (mu, damped), one in ON_SLOPE.items():
        time, values = motion(one)
        style = {"color": MU_COLOUR[mu], "linewidth": 1.6 if damped else 0.8}
        text = rf"$\mu$ = {mu}" + ("" if damped else ", no viscosity")
        slope.plot(time, values, linestyle="-" if damped else (0, (4, 1)), label=text, **style)
    mean = slice(*np.searchsorted(motion(ON_SLOPE["0.49", True])[0], (0.2, 1)))
    time, values = (x[mean] for x in motion(ON_SLOPE["0.49", True]))
    line = values.mean() + by_hand("0.49") * (time - time.mean())
    slope.plot(
        time,
        line,
        color="black",
        linestyle=(0, (1, 2)),
        linewidth=1.2,
        label=r"$g\,(\sin\beta - \mu\cos\beta)$",
    )
    slope.set_title(r"on a slope, $\tan\beta$ = 1/2")
    slope.set_ylabel("velocity down the slope (m/s)")
    slope.set_xlim(0, 1)
    slope.set_ylim(-0.02, 0.4)
    for panel in (level, force, slope):
        panel.set_xlabel("time (s)")
        panel.legend(fontsize=8.5)
    picture = figure.add_subplot(grid[1, :])
    step = STEP
    drawn = draw_block(picture, step)
    draw_block(picture, 0, ghost=True)
    picture.add_patch(Rectangle((-0.05, -0.56), 4.1, 0.06, **GROUND))
    time = LEVEL["0.3", True].read()["time"][step]
    bare(picture, rf"$\mu$ = 0.3, {time:g} s (grey: at the start)", (-0.1, 4.1), (-0.6, 0.6))
    scale_bar(picture, 3.4, 0.2, 0.5)
    colour_bar(drawn, picture.inset_axes((2.6, 0.42, 0.7, 0.05), transform=picture.transData))
    return figure


def checks():
    rows = []
    for mu in ("0.1", "0.3"):
        exact = float(mu) * G
        ours = -slope_of(LEVEL[mu, True], 0.1, 0.9 * stop(mu))
        rows.append(
            check(
                f"level, mu = {mu}: deceleration (m/s^2)",
                f"{ours:.5f}",
                abs(ours / exact - 1) < 5e-3,
                "within 0.5 %",
                exact=f"{exact:.5f}",
            )
        )
        way = LEVEL[mu, True].read()["slide_block"][-1]
        exact = SPEED**2 / (2 * float(mu) * G)
        rows.append(
            check(
                f"level, mu = {mu}: way until it stops (m)",
                f"{way:.5f}",
                abs(way / exact - 1) < 5e-3,
                "within 0.5 %",
                exact=f"{exact:.5f}",
            )
        )
        late = [stopped(LEVEL[mu, damped]) for damped in (True, False)]
        rows.append(
            check(
                f"level, mu = {mu}: stops (s) with and without viscosity",
                f"{late[0]:.3f}, {late[1]:.3f}",
                abs(late[0] / stop(mu) - 1) < 0.05 and late[1] > late[0],
                "within 5 %; later without, since it goes on vibrating",
                exact=f"{stop(mu):.3f}",
            )
        )
    ours, exact = slope_of(ON_SLOPE["0.49", True], 0.2, 1), by_hand("0.49")
    rows.append(
        check(
            "slope of 1/2, mu = 0.49: acceleration (m/s^2)",
            f"{ours:.5f}",
            abs(ours / exact - 1) < 0.02,
            "within 2 %",
            exact=f"{exact:.5f}",
        )
    )
    ours = slope_of(ON_SLOPE["0.51", True], 0.6, 1)
    rows.append(
        check(
            "slope of 1/2, mu = 0.51: acceleration from 0.6 s on (m/s^2)",
            f"{ours:.1e}",
            abs(ours) < 5e-3 * G * SIN,
            "less than 0.5 % of g sin(beta): it sticks",
            exact="0",
        )
    )
    table = ON_SLOPE["0.51", False].read()
    rows += [
        compare("own.slope.velocity", table["momentum_x_block"][-1] / BLOCK_MASS),
        compare("own.slope.off", np.mean(table["active_points_block"][1:] == 0)),
    ]
    return rows + checks_of_runs([*LEVEL.values(), *ON_SLOPE.values()])


FIGURE = Figure("S-1", __doc__, [*LEVEL.values(), *ON_SLOPE.values()], draw, checks)
