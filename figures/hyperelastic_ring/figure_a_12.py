# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: cost against degrees of freedom (timed).

Seconds per step in the first second of the motion, of which 0.945 s are in contact, and the CPU
seconds of the paper's table 4 over its 1000 steps.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.curves import FULL_WIDTH, legend_above
from shared.figure import Figure
from shared.timing import timing_of_steps

from .cost import COST_METHODS, FAMILY, NODES, PAPER, PAPER_STEPS, RUNS


def draw():
    figure, axes = plt.subplots(figsize=FULL_WIDTH)
    dofs = [2 * nodes for nodes in NODES.values()]
    for method in COST_METHODS:
        timings = [timing_of_steps(RUNS[method.key, n]) for n in FAMILY]
        axes.loglog(
            dofs, [t / n for t, n in timings], "o-", color=method.colour, label=method.label
        )
        axes.loglog(
            dofs,
            np.array(PAPER[method.key]) / PAPER_STEPS,
            "s--",
            color=method.colour,
            alpha=0.5,
        )
    axes.set_xlabel("degrees of freedom")
    axes.set_ylabel(f"seconds per step; dashed: the paper, {PAPER_STEPS} steps")
    legend_above(axes)
    return figure


FIGURE = Figure("A-12", __doc__, list(RUNS.values()), draw, timed=True)
