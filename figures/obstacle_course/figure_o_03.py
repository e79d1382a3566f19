# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacle course: a plate that is lifted, a drum that turns.

Left: a disk on a plate that is lifted and tilted (persistent contact), and in a drum that turns
against the clock (improved normal compliance), with friction. Right: the work of the obstacle on
the body, once from the energy balance and once from the resultant of the contact force, its moment
and the motion; the largest difference until 0.6 s falls with the square of the step.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.pictures import colour_bar, snapshot
from shared.rows import checks_of_runs

from .moving import MOVES, MOVING, STEPS, UNTIL, draw_moving, plate_angle, plate_height


def works(one):
    """The work of an obstacle on the body (J): by the balance, and by the resultants."""
    table = one.read()
    early = table["time"] < UNTIL + 1e-9
    potential = table["modified_energy"] - table["energy"]
    balance = potential - potential[0] - table["contact_work"]
    return balance[early], table["obstacle_work"][early]


def difference(key, step):
    balance, resultants = works(MOVES[key, step])
    return np.abs(balance - resultants).max()


def draw():
    figure = plt.figure(figsize=(14, 6.2), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=(2.6, 1))
    grid = left.add_gridspec(3, 3, height_ratios=(1, 1, 0.04))
    for row, (key, (_, steps)) in enumerate(MOVING.items()):
        for column, step in enumerate(steps):
            axes = left.add_subplot(grid[row, column])
            drawn, time = draw_moving(axes, key, step)
            axes.set_title(f"{key}, {time:.2f} s")
    colour_bar(drawn, left.add_subplot(grid[2, 1]))

    axes = right.add_subplot()
    steps = np.array(STEPS)
    for key, (colour, _) in MOVING.items():
        values = [difference(key, step) for step in STEPS]
        axes.loglog(1e3 * steps, values, "o", color=colour, label=key, markersize=7)
        line = values[-1] * (steps / steps[-1]) ** 2
        axes.loglog(1e3 * steps, line, color=colour, linestyle=(0, (4, 3)), linewidth=1)
    axes.plot([], [], color="0.4", linestyle=(0, (4, 3)), linewidth=1, label="slope 2")
    axes.set_xticks(1e3 * steps, [f"{1e3 * step:g}" for step in STEPS])
    axes.minorticks_off()
    axes.set_xlabel("time step (ms)")
    axes.set_ylabel("|work by the balance $-$ work by the resultants| (J)")
    axes.set_title(f"work of about 3 kJ until {UNTIL:g} s")
    axes.legend()
    return figure


def checks():
    rows = []
    for key in MOVING:
        values = [difference(key, step) for step in STEPS]
        ratios = [a / b for a, b in zip(values[:-1], values[1:])]
        total = works(MOVES[key, STEPS[-1]])[1][-1]
        rows.append(compare(f"own.drum.work_{key}", total))
        rows.append(
            check(
                f"{key}: balance against resultants (J), steps of 4, 2, 1 ms",
                ", ".join(f"{value:.2e}" for value in values),
                all(3 < ratio < 5 for ratio in ratios),
                "each 3 to 5 times the next: second order; ratios "
                + ", ".join(f"{ratio:.2f}" for ratio in ratios),
                exact="ratio 4",
            )
        )
        fall, taken = 0.0, []
        for step in STEPS:
            table = MOVES[key, step].read()
            fall = max(fall, -np.diff(table["friction_work"]).min() / table["energy"].max())
            early = table["time"] < UNTIL + 1e-9
            taken.append(table["friction_work"][early][-1])
        rows.append(
            check(
                f"{key}: largest fall of the work against friction in a step",
                f"{max(fall, 0):.1e}",
                fall <= 1e-12,
                "at most 1e-12 of the energy: friction only takes",
                exact="<= 0",
            )
        )
        rows.append(compare(f"own.drum.taken_{key}", taken[-1]))
    rows.append(plate_row())
    return rows + checks_of_runs(list(MOVES.values()))


def plate_row():
    """The plate of the pictures is where the program has it."""
    one = MOVES["plate", STEPS[0]]
    worst = 0.0
    for step in MOVING["plate"][1]:
        time = one.read()["time"][step]
        _, place, _, fields = snapshot(one, step)
        normal = np.array([-np.sin(plate_angle(time)), np.cos(plate_angle(time))])
        gap = (place - (0, plate_height(time))) @ normal
        worst = max(worst, np.abs(gap - fields["gap"].reshape(-1)).max())
    return check(
        "plate of the pictures: distances of the points against the field of gaps (m)",
        f"{worst:.1e}",
        worst < 1e-5,
        "< 1e-5: fields have single precision",
        exact="0",
    )


FIGURE = Figure("O-3", __doc__, list(MOVES.values()), draw, checks)
