# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: exponent of improved normal compliance.

Energy relative to the start for alpha = 2 to 5, steps of 10 ms. The mesh has 64 x 5 nodes. It
dips while some node penetrates, and comes back.
"""

from shared.curves import ENERGY, curve, name_panel, small_panels
from shared.figure import Figure, info
from shared.measures import dip, energy, penetration
from shared.methods import INC, SCALE
from shared.paper_numbers import numbers
from shared.rows import checks_of_runs, constant_row, momentum_row, order_row, recovered_row

from .common import AGAINST, COARSE, EXPONENTS, GAP

PAPER = numbers("A.table_3")
RUNS = [COARSE[INC[a].key] for a in EXPONENTS]


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
    rows = []
    for a, one in zip(EXPONENTS, RUNS):
        rows.append(recovered_row(INC[a].name, one))
        rows.append(info(f"{INC[a].name}: dip", f"{100 * dip(one):.2f} %", "some fluctuations"))
    rows.append(constant_row("INC", RUNS, "modified_energy", "-"))
    rows.append(
        order_row(
            "largest penetration (m), alpha = 2, 3, 4, 5",
            [penetration(one) for one in RUNS],
            "grows with alpha",
            " and ".join(f"{PAPER[key]:.1e}".replace("e-0", "e-") for key in ("inc2", "inc3"))
            + " for 2 and 3",
            "{:.2e}",
        )
    )
    return rows + [momentum_row(RUNS)] + checks_of_runs(RUNS)


FIGURE = Figure("A-13", __doc__, RUNS, draw, checks)
