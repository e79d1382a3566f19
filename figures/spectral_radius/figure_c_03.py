# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spectral radii of HHT.

Spectral radius of the amplification matrix against the squared frequency. A negative alpha
(dashed) damps more at low frequencies than its positive counterpart; both tend to the same limit
(dotted).
"""

import numpy as np

from shared.curves import legend_above
from shared.figure import Figure, check
from shared.paper_numbers import compare

from .common import ALPHAS, COLOURS, SPECTRUM, hht, order_of, plot_hht, radius_axes


def limit(alpha):
    """Spectral radius of HHT for large omega dt, paper C, below (32)."""
    return (1 - abs(alpha)) / (1 + abs(alpha))


def draw():
    table = SPECTRUM.read()
    figure, axes = radius_axes()
    axes.plot(table["omega_tilde"], table["Crank-Nicolson"], "0.4", label=r"$\tilde\alpha = 0$")
    plot_hht(axes, table, ALPHAS)
    for i, magnitude in enumerate(COLOURS):
        axes.axhline(
            limit(magnitude),
            color="black",
            linewidth=0.8,
            linestyle=":",
            zorder=1,
            label=r"limit $(1-|\tilde\alpha|)/(1+|\tilde\alpha|)$" if i == 0 else None,
        )
    axes.set_ylim(0.78, 1.01)
    legend_above(axes, 3)
    return figure


def named(alpha):
    """Its name in numbers/C.toml: m05 for -0.05."""
    return ("m" if alpha < 0 else "") + f"{abs(alpha):g}".removeprefix("0.")


def checks():
    table = SPECTRUM.read()
    low = table["omega_tilde"] <= 1
    largest = max(values.max() for name, values in table.items() if name != "omega_tilde")
    deviation = np.abs(table["Crank-Nicolson"] - 1).max()
    margin = min((table[hht(a)] - table[hht(-a)])[low].min() for a in COLOURS)
    return [
        # The distance to the limit falls like 1/omega_tilde, with a factor of order
        # 1: at the last frequency, 1e7, it is 1e-7 or less.
        *(compare(f"C.figure_3.limit_{named(alpha)}", table[hht(alpha)][-1]) for alpha in ALPHAS),
        check(
            "Crank-Nicolson: max |radius - 1|",
            f"{deviation:.1e}",
            deviation < 1e-12,
            "< 1e-12, round-off",
            exact="0",
        ),
        compare("C.figure_3.stable", largest - 1),
        compare("C.figure_3.negative", margin),
        # gamma = 1/2 + |alpha| gives up the second order when alpha < 0, for which
        # it would have to be 1/2 + alpha.
        compare("C.section_3_2.positive", min(order_of(hht(a)) for a in ALPHAS if a > 0)),
        compare("C.section_3_2.negative", max(order_of(hht(a)) for a in ALPHAS if a < 0)),
    ]


FIGURE = Figure("C-3", __doc__, [SPECTRUM], draw, checks)
