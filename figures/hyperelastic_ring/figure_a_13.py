# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: exponent of improved normal compliance.

Energy relative to the start for alpha = 2 to 5, steps of 10 ms. It
dips while some node penetrates, and comes back.
"""

from shared.curves import ENERGY, curve, name_panel, small_panels
from shared.figure import Figure
from shared.measures import dip, energy, missing_after, penetration
from shared.methods import INC, SCALE
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row, momentum_row

from .common import AGAINST, EXPONENTS, FULL, GAP

RUNS = [FULL[INC[a].key] for a in EXPONENTS]


def draw():
    figure, axes = small_panels(len(EXPONENTS), columns=1, height=1.5)
    for panel, a, one, colour in zip(axes.flat, EXPONENTS, RUNS, SCALE):
        panel.axhline(1, color="0.6", linewidth=0.7, zorder=1)
        curve(panel, one, energy, GAP, colour, None, 1.0)
        name_panel(panel, INC[a].label)
    axes[0, 0].set_xlim(-0.1, 5.95)
    axes[-1, 0].set_xlabel(AGAINST)
    figure.supylabel(ENERGY, fontsize=10)
    return figure


def checks():
    dips = {a: dip(one) for a, one in zip(EXPONENTS, RUNS)}
    others = min(value for a, value in dips.items() if a != 3)
    return [
        compare("A.figure_13.recovered", missing_after(RUNS)),
        *(compare(f"A.figure_13.dip_{a}", value) for a, value in dips.items()),
        compare("A.figure_13.best", dips[3] / others),
        *(
            compare(f"own.ring_exponents.inc{a}", penetration(one))
            for a, one in zip(EXPONENTS, RUNS)
        ),
        constant_row("INC", RUNS, "modified_energy", "-"),
        momentum_row(RUNS),
    ] + checks_of_runs(RUNS)


FIGURE = Figure("A-13", __doc__, RUNS, draw, checks)
