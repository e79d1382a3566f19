# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: energy of the methods.

Energy relative to the start, steps of 10 ms, no friction. Left: the mesh of the paper. Right: a
coarse mesh, with bands for ten positions of the impact within a step. The two-step scheme and
persistent contact conserve; improved normal compliance recovers; Signorini and standard normal
compliance lose.
"""

from shared.curves import ENERGY, curve, fill, name_panel, small_panels
from shared.figure import Figure, check, info
from shared.measures import dip, energy, lost, percent
from shared.methods import PERSISTENT, SIGNORINI, SNC, TWO_STEP
from shared.paper_numbers import numbers
from shared.rows import checks_of_runs, constant_row, momentum_row, recovered_row

from .common import AGAINST, BANDS, COARSE, FULL, GAP, METHODS

PAPER = numbers("A.figure_11")["lost"]
RUNS = [r for m in METHODS for r in (FULL[m.key], COARSE[m.key], *BANDS[m.key])]


def draw():
    figure, axes = small_panels(2 * len(METHODS), height=1.6)
    for row, method in zip(axes, METHODS):
        fill(row[1], BANDS[method.key], energy, GAP, method.colour, 1.0)
        for panel, one in zip(row, (FULL[method.key], COARSE[method.key])):
            panel.axhline(1, color="0.6", linewidth=0.7, zorder=1)
            curve(panel, one, energy, GAP, method.colour, None, 1.0)
        name_panel(row[0], method.label)
    axes[0, 0].set_title("128 x 13 nodes\n", fontsize=11)
    axes[0, 1].set_title("64 x 5 nodes, ten positions\n", fontsize=11)
    axes[0, 0].set_xlim(-0.1, 5.95)
    figure.supxlabel(AGAINST, fontsize=10)
    figure.supylabel(ENERGY, fontsize=10)
    return figure


def checks():
    rows = []
    for method in (PERSISTENT, TWO_STEP):
        rows.append(constant_row(method.name, [FULL[method.key], *BANDS[method.key]]))
    inc = [FULL["inc2"], *BANDS["inc2"]]
    rows.append(constant_row("INC alpha = 2", inc, "modified_energy", "-"))
    rows.append(recovered_row("INC alpha = 2", inc))
    rows.append(info("INC alpha = 2: dip", percent([dip(r) for r in inc]), "a dip"))
    for method in (SIGNORINI, SNC):
        losses = [lost(FULL[method.key])] + [lost(r) for r in BANDS[method.key]]
        rows.append(
            check(
                f"{method.name}: energy lost, 128 x 13 nodes; ten positions on 64 x 5",
                f"{100 * losses[0]:.2f} %; {percent(losses[1:])}",
                PAPER[method.key] / 2 < losses[0] < 2 * PAPER[method.key],
                "within a factor of two on the mesh of the paper",
                f"{100 * PAPER[method.key]:g} %",
            )
        )
    return rows + [momentum_row(RUNS)] + checks_of_runs(RUNS)


FIGURE = Figure("A-11", __doc__, RUNS, draw, checks)
