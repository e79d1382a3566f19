# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: energy of the methods of paper B.

Energy relative to the start, steps of 1/300 s, 64 x 7 nodes. Persistent contact, the two-step
scheme and Hauret and Le Tallec's penalisation conserve or recover, Signorini's condition and the
equivalent mass matrix do not.
"""

from shared.curves import ENERGY, curve, name_panel, small_panels
from shared.figure import Figure, check, info
from shared.measures import dip, energy, lost
from shared.methods import EMM, HAURET, PERSISTENT, SIGNORINI, TWO_STEP
from shared.rows import checks_of_runs, constant_row, momentum_row, recovered_row

from .common import AGAINST, GAP, run

METHODS = (SIGNORINI, EMM, TWO_STEP, HAURET, PERSISTENT)
RUNS = {m.key: run("B-8", m.key, cost=5) for m in METHODS}


def draw():
    figure, axes = small_panels(len(METHODS))
    for panel, method in zip(axes.flat, METHODS):
        panel.axhline(1, color="0.6", linewidth=0.7, zorder=1)
        curve(panel, RUNS[method.key], energy, GAP, method.colour, None, 1.0)
        name_panel(panel, method.label)
    figure.supxlabel(AGAINST, fontsize=10)
    figure.supylabel(ENERGY, fontsize=10)
    return figure


def checks():
    rows = [
        constant_row("persistent", RUNS["persistent"]),
        constant_row("two-step", RUNS["two_step"]),
        constant_row("Hauret", RUNS["hauret"], "modified_energy", "-"),
        recovered_row("Hauret", RUNS["hauret"]),
        info("Hauret: dip", f"{100 * dip(RUNS['hauret']):.2f} %"),
        check(
            "EMM: energy lost",
            f"{100 * lost(RUNS['emm']):.2f} %",
            lost(RUNS["emm"]) > 0.01,
            "above 1 %",
            "dissipates",
        ),
        info("Signorini: energy lost", f"{100 * lost(RUNS['signorini']):.2f} %"),
        momentum_row(RUNS.values()),
    ]
    return rows + checks_of_runs(RUNS.values())


FIGURE = Figure("B-8", __doc__, list(RUNS.values()), draw, checks)
