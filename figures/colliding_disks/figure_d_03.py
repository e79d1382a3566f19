# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colliding disks: slave and master swapped.

Offset 1 m, no friction, rings (6, 5), (11, 9) and (22, 18). Dots: how much the velocity after the
collision changes when the other disk is the slave. Triangles: the error of each choice, measured
from the mean of both on the finest mesh with the smaller step. With 4 ms the finest mesh brings
nothing: there the step counts, since persistent contact penetrates by the displacement of a node in
the step in which it touches.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.rows import checks_of_runs

from .common import CASES, disks, momenta_row, printed

# Which disk is the slave.
RINGS = ((6, 5), (11, 9), (22, 18))
TIME_STEPS = ("0.004", "0.002")  # s


def swapped(rings, step, slave):
    more = []
    if rings != (11, 9):
        for side, number in zip(("left", "right"), rings):
            more.append(f"Disks/Rings of the {side} disk={number}")
    if slave != "left":
        more.append(f"Disks/Slave={slave}")
    if step != "0.004":
        more.append(f"Time/Time step={step}")
    return disks(
        "D-3",
        f"{rings[0]}_{rings[1]}_{1e3 * float(step):g}ms_{slave}",
        case=CASES[1],
        more=tuple(more),
        cost=0.03 * rings[0] ** 2,
    )


RUNS = {
    (rings, step, slave): swapped(rings, step, slave)
    for rings in RINGS
    for step in TIME_STEPS
    for slave in ("left", "right")
}


def velocity(*key):
    """Velocity of the left disk's centre at the end (m/s)."""
    values = printed(RUNS[key])
    return np.array([values["velocity_x_left"], values["velocity_y_left"]])


def reference():
    """The mean of both choices on the finest mesh with the smallest step."""
    return sum(velocity(RINGS[-1], TIME_STEPS[-1], slave) for slave in ("left", "right")) / 2


def difference(rings, step):
    """Effect of the choice of the slave (m/s)."""
    return np.linalg.norm(velocity(rings, step, "left") - velocity(rings, step, "right"))


def error(*key):
    return np.linalg.norm(velocity(*key) - reference())


def draw():
    figure, axes = plt.subplots(figsize=(8, 4.8), layout="constrained")
    nodes = [6 * rings[0] for rings in RINGS]
    for step, colour in zip(TIME_STEPS, ("#0072B2", "#D55E00")):
        text = f"step {1e3 * float(step):g} ms: "
        axes.loglog(
            nodes,
            [difference(rings, step) for rings in RINGS],
            "o-",
            color=colour,
            label=text + "slave left less slave right",
        )
        # The reference is made of those with the finest mesh and the smallest step.
        coarse = range(len(RINGS) - (step == TIME_STEPS[-1]))
        for slave, marker in (("left", "<"), ("right", ">")):
            axes.loglog(
                [nodes[k] for k in coarse],
                [error(RINGS[k], step, slave) for k in coarse],
                marker,
                color=colour,
                markerfacecolor="none",
                markersize=9,
                label=text + f"error, slave {slave}",
            )
    axes.set_xticks(nodes, [str(n) for n in nodes])
    axes.minorticks_off()
    axes.set_xlabel("nodes on the circle of the left disk")
    axes.set_ylabel("difference in the left disk's velocity (m/s)")
    axes.legend(fontsize=8)
    return figure


def checks():
    rows = []
    small = TIME_STEPS[-1]
    differences = [difference(rings, small) for rings in RINGS]
    for rings, value in zip(RINGS, differences):
        rows.append(compare(f"own.swapped.change_{6 * rings[0]}", value))
    for rings in RINGS[:-1]:
        for step in TIME_STEPS:
            ours = difference(rings, step)
            largest = max(error(rings, step, slave) for slave in ("left", "right"))
            rows.append(
                check(
                    f"{6 * rings[0]} nodes, step {1e3 * float(step):g} ms: "
                    "the same, and the larger error of both (m/s)",
                    f"{ours:.1e}, {largest:.1e}",
                    ours < 1.5 * largest,
                    "less than 1.5 times the error",
                )
            )
    least = min(error(RINGS[1], small, slave) for slave in ("left", "right"))
    rows.append(
        check(
            "132 nodes, step 2 ms: the same, and the smaller error with 66 nodes (m/s)",
            f"{differences[-1]:.1e}, {least:.1e}",
            differences[-1] < least,
            "less than that",
        )
    )
    # On this mesh the step counts: nodes touch at other instants.
    rows.append(compare("own.swapped.change_coarse", difference(RINGS[-1], TIME_STEPS[0])))
    mass = RUNS[RINGS[1], TIME_STEPS[0], "left"].read()["momentum_x_left"][0]
    tables = [one.read()["energy"] for one in RUNS.values()]
    worst = max(np.abs(energy / energy[0] - 1).max() for energy in tables)
    rows.append(
        check(
            f"max change of energy, {len(RUNS)} runs",
            f"{worst:.1e}",
            worst < 1e-9,
            "< 1e-9: whichever is the slave",
            exact="0",
        )
    )
    return rows + [momenta_row(RUNS.values(), mass)] + checks_of_runs(RUNS.values())


FIGURE = Figure("D-3", __doc__, list(RUNS.values()), draw, checks)
