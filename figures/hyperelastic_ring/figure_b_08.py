# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: energy of the methods of paper B.

Energy relative to the start, steps of 1/300 s. Persistent contact, the two-step
scheme and Hauret and Le Tallec's penalisation conserve or recover, Signorini's condition and the
equivalent mass matrix do not.
"""

from shared.curves import ENERGY, curve, name_panel, small_panels
from shared.figure import Figure
from shared.measures import change, dip, energy, lost, missing_after
from shared.methods import EMM, HAURET, PERSISTENT, SIGNORINI, TWO_STEP
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row, momentum_row

from .common import AGAINST, GAP, run

METHODS = (SIGNORINI, EMM, TWO_STEP, HAURET, PERSISTENT)
RUNS = {m.key: run("B-8", m.key, cost=35) for m in METHODS}


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
    return [
        *(compare(f"B.figure_8.{key}", change([RUNS[key]])) for key in ("persistent", "two_step")),
        compare("B.figure_8.hauret", missing_after([RUNS["hauret"]])),
        compare("B.figure_8.hauret_dip", dip(RUNS["hauret"])),
        *(compare(f"B.figure_8.{key}", lost(RUNS[key])) for key in ("emm", "signorini")),
        constant_row("Hauret", RUNS["hauret"], "modified_energy", "-"),
        momentum_row(RUNS.values()),
    ] + checks_of_runs(RUNS.values())


FIGURE = Figure("B-8", __doc__, list(RUNS.values()), draw, checks)
