# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacle course: block and disk on an incline.

An incline of tan(beta) = 1/2. Left: velocity of the centre; right: the body at the start (grey)
and at the end, with von Mises stress and the resultant of the contact force. A block slides or
sticks as the friction coefficient is below or above 1/2, a disk slips or rolls as it is below or
above 1/6. Bodies land within a tenth of a second, in which also the block slides that then
sticks. Cross and dot are fixed to the disk.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.pictures import bare, colour_bar, scale_bar
from shared.rows import checks_of_runs

from .common import DENSITY, G, RADIUS, STRESS, draw_body
from .incline import (
    BLOCK_STRESS,
    COLOUR,
    COS,
    FRICTION,
    INCLINE,
    INCLINE_NODES,
    LAST,
    NAME,
    SIN,
    draw_incline,
)


def disk_mass(n_boundary_nodes):
    """Mass (kg) of the polygon that stands for a disk."""
    n = n_boundary_nodes
    return DENSITY * n / 2 * RADIUS**2 * np.sin(2 * np.pi / n)


def by_hand(key):
    """The acceleration (m/s^2) down the slope, and its formula."""
    if key == "block_sticks":
        return 0.0, "0"
    if key == "disk_rolls":
        return 2 / 3 * G * SIN, r"$\frac{2}{3}\,g \sin\beta$"
    return G * (SIN - FRICTION[key] * COS), r"$g\,(\sin\beta - \mu \cos\beta)$"


def mass(key):
    return 1.0 * 0.5 * DENSITY if key.startswith("block") else disk_mass(INCLINE_NODES)


def motion(key):
    """Times (s), velocity of the centre down the slope and of a disk's rolling (m/s).

    One of each for a step, the mean of those at both ends: a body that has landed still vibrates
    from step to step. The velocity of rolling is spin times radius.
    """
    table = INCLINE[key].read()
    px, py = table["momentum_x"], table["momentum_y"]
    x = RADIUS * SIN + table["centre_displacement_x"]
    y = RADIUS * COS + table["centre_displacement_y"]
    spin = (x * py - y * px - table["angular_momentum"]) / (0.5 * mass(key) * RADIUS**2)
    values = (table["time"], (COS * px - SIN * py) / mass(key), RADIUS * spin)
    return tuple((v[1:] + v[:-1]) / 2 for v in values)


def late(key):
    """Steps that count for an acceleration: not those of the landing."""
    time = motion(key)[0]
    return time >= time[-1] / 3


def accelerations(key):
    """Slopes of lines through the two velocities (m/s^2)."""
    time, *velocities = motion(key)
    return [np.polyfit(time[late(key)], v[late(key)], 1)[0] for v in velocities]


def rolling_by_hand(key):
    """The velocity of rolling over that of the centre: friction turns a disk that slips."""
    if key == "disk_rolls":
        return 1.0
    return 2 * FRICTION[key] * G * COS / by_hand(key)[0]


def draw_velocity(axes, keys):
    for key in keys:
        time, values, _ = motion(key)
        exact, formula = by_hand(key)
        axes.plot(
            time,
            values,
            color=COLOUR[key],
            linewidth=2.4,
            label=rf"{NAME[key]}, $\mu$ = {FRICTION[key]}: $a$ = {formula}",
        )
        # Only the slope is known by hand, not how the body lands.
        time, values = time[late(key)], values[late(key)]
        line = values.mean() + exact * (time - time.mean())
        axes.plot(time, line, color="black", linestyle=(0, (4, 3)), linewidth=1, zorder=4)
    axes.plot([], [], color="black", linestyle=(0, (4, 3)), linewidth=1, label="$a$ by hand")
    axes.set_xlabel("time (s)")
    axes.set_ylabel("velocity down the slope (m/s)")
    axes.set_xlim(0, np.ceil(10 * time[-1]) / 10)
    axes.legend(loc="upper left", fontsize=8.5)


def draw():
    figure = plt.figure(figsize=(13.5, 7), layout="constrained")
    grid = figure.add_gridspec(2, 4, width_ratios=(1.3, 1, 1, 0.04))
    rows = (
        (("block_slides", "block_sticks"), (-0.75, 0.95), (-0.52, 0.88), BLOCK_STRESS, 0.13),
        (("disk_rolls", "disk_slips"), (-0.55, 1.45), (-0.62, 1.04), STRESS, 2.5),
    )
    for row, (keys, x, y, limit, top) in enumerate(rows):
        axes = figure.add_subplot(grid[row, 0])
        draw_velocity(axes, keys)
        axes.set_ylim(-0.05 * top, top)
        for column, key in enumerate(keys):
            one, cross = INCLINE[key], row == 1
            panel = figure.add_subplot(grid[row, column + 1])
            draw_incline(panel, x, y)
            _, start = draw_body(panel, one, 0, ghost=True, cross=cross)
            drawn, end = draw_body(panel, one, LAST[key], cross=cross, limit=limit)
            way = np.linalg.norm(end - start)
            text = f"{100 * way:.1f} cm" if way > 1e-3 else f"{1000 * way:.1f} mm"
            time = one.read()["time"][LAST[key]]
            bare(panel, f"{NAME[key]}: {text} in {time:g} s", x, y)
            scale_bar(panel, x[0] + 0.12, y[0] + 0.1, 0.5)
        colour_bar(drawn, figure.add_subplot(grid[row, 3]), "vertical")
    return figure


def checks():
    rows = []
    for key in INCLINE:
        ours, (exact, _) = accelerations(key)[0], by_hand(key)
        name = f"{NAME[key]}, mu = {FRICTION[key]}: acceleration (m/s^2)"
        if exact:
            error = abs(ours / exact - 1)
            rows.append(
                check(
                    name,
                    f"{ours:.5f}, {100 * error:.2f} % off",
                    error < 0.02,
                    "within 2 %: the body is elastic and shivers",
                    exact=f"{exact:.5f}",
                )
            )
        else:
            rows.append(
                check(
                    name,
                    f"{ours:.1e}",
                    abs(ours) < 5e-3 * G * SIN,
                    "less than 0.5 % of g sin(beta)",
                    exact="0",
                )
            )
    for key in ("disk_rolls", "disk_slips"):
        centre, rolling = accelerations(key)
        exact = rolling_by_hand(key)
        rows.append(
            check(
                f"{NAME[key]}: angular acceleration times radius over acceleration",
                f"{rolling / centre:.4f}",
                abs(rolling / centre - exact) < 0.03,
                "within 0.03: 1 is rolling",
                exact=f"{exact:.4f}",
            )
        )
    return rows + checks_of_runs(list(INCLINE.values()))


FIGURE = Figure("O-1", __doc__, list(INCLINE.values()), draw, checks)
