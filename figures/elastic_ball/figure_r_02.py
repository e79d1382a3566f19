# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: the equivalent mass matrix against the time step.

Energy lost with the equivalent mass matrix over that with Signorini's condition and the consistent
mass, means over five positions of the impact within a step, against the number of cells that a
longitudinal wave crosses in a step. The loss of a landing node is the work of its pressure over
the rest of its displacement in that step, whatever its mass: only steps in which a wave crosses
less than half a cell let a node without mass follow its neighbours. Papers A and B say of steps of
1 ms that the loss is strongly reduced.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.curves import FULL_WIDTH
from shared.figure import Figure
from shared.measures import lost, mean
from shared.methods import POSITIONS, SPEED, gap
from shared.paper_numbers import compare
from shared.rows import checks_of_runs
from shared.runs import QUIET, Run

# s
TIME_STEPS = (2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5)
METHODS = ("signorini", "emm")
# Speed of a longitudinal wave in plane stress (m/s), and size of the cells on the circle (m).
WAVE = np.sqrt(1e10 / (1000 * (1 - 0.35**2)))
CELL = 2 * np.pi * 10 / 128


def runs_of(method, time_step):
    """Every other position."""
    steps = max(1, round(0.055 / (SPEED * time_step)))
    return [
        Run(
            "R-2",
            f"{method}_{1e3 * time_step:g}ms_at_{position}",
            "elastic_ball",
            f"elastic_ball/figure_A04_{method}.prm",
            (
                *QUIET,
                f"Time/Time step={time_step:g}",
                "Time/Final time=0.05",
                f"Start/Initial gap={gap(steps, position, time_step):g}",
            ),
            cost=1e-3 / time_step,
        )
        for position in POSITIONS[::2]
    ]


RUNS = {(method, step): runs_of(method, step) for method in METHODS for step in TIME_STEPS}


def ratio(step):
    losses = {method: mean([lost(one) for one in RUNS[method, step]]) for method in METHODS}
    return losses["emm"] / losses["signorini"]


def draw():
    figure, axes = plt.subplots(figsize=FULL_WIDTH)
    cells = [WAVE * step / CELL for step in TIME_STEPS]
    axes.semilogx(cells, [ratio(step) for step in TIME_STEPS], "o-", color="#CC79A7")
    axes.axvline(1, color="0.6", linewidth=0.8)
    axes.set_ylim(0, 1.05)
    axes.set_xlabel(r"cells that a wave crosses in a step, $c\,\Delta t/h$")
    axes.set_ylabel("energy lost, EMM over Signorini")
    return figure


def checks():
    everything = [one for group in RUNS.values() for one in group]
    return [
        compare(f"own.emm_steps.step_{round(1e6 * step)}", ratio(step)) for step in TIME_STEPS
    ] + checks_of_runs(everything)


FIGURE = Figure("R-2", __doc__, [one for group in RUNS.values() for one in group], draw, checks)
