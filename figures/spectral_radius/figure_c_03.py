# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spectral radii of HHT.

Spectral radius of the amplification matrix against the squared frequency. A negative alpha
(dashed) damps more at low frequencies than its positive counterpart; both tend to the same limit
(dotted).
"""

import numpy as np

from shared.curves import legend_above
from shared.figure import Figure, check, note

from .common import (
    ALPHAS,
    COLOURS,
    ORDER,
    SPECTRUM,
    hht,
    order_check,
    order_of,
    plot_hht,
    radius_axes,
)


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


def checks():
    table = SPECTRUM.read()
    omega = table["omega_tilde"]
    rows = []

    # The distance to the limit falls like 1/omega_tilde, with a factor of order
    # 1: at the last frequency, 1e7, it is 1e-7 or less.
    for alpha in ALPHAS:
        rows.append(
            check(
                f"limit of the spectral radius, alpha = {alpha:g}",
                f"{table[hht(alpha)][-1]:.7f}",
                abs(table[hht(alpha)][-1] - limit(alpha)) < 1e-6,
                "within 1e-6 (deviation ~ 1/omega, omega = 1e7)",
                paper="(1-|a|)/(1+|a|)",
                exact=f"{limit(alpha):.7f}",
            )
        )
    deviation = np.abs(table["Crank-Nicolson"] - 1).max()
    rows.append(
        check(
            "Crank-Nicolson: max |radius - 1|",
            f"{deviation:.1e}",
            deviation < 1e-12,
            "< 1e-12, round-off",
            paper="0",
            exact="0",
        )
    )
    largest = max(values.max() for name, values in table.items() if name != "omega_tilde")
    rows.append(
        check(
            "largest spectral radius of all schemes, minus 1",
            f"{largest - 1:.1e}",
            largest <= 1 + 1e-12,
            "<= 1e-12, round-off",
            paper="<= 0",
            exact="0",
        )
    )
    low = omega <= 1
    margin = min((table[hht(a)] - table[hht(-a)])[low].min() for a in COLOURS)
    rows.append(
        check(
            "radius(alpha) - radius(-alpha), least for omega <= 1",
            f"{margin:.1e}",
            margin > 0,
            "> 0: a negative alpha damps more at low frequencies",
            paper="> 0",
        )
    )

    # gamma = 1/2 + |alpha| gives up the second order when alpha < 0, for which
    # it would have to be 1/2 + alpha.
    rows += [order_check(hht(alpha), 2 if alpha > 0 else 1) for alpha in ALPHAS]
    orders = [order_of(SPECTRUM.read("oscillator_order.csv"), hht(a)) for a in ALPHAS if a < 0]
    rows.append(
        note(
            "order for alpha < 0, gamma = 1/2 + |alpha|",
            f"{min(orders):.2f} ... {max(orders):.2f}",
            "C (28) claims second order; it is first order",
            paper=f"{ORDER}",
            exact="1",
        )
    )
    return rows


FIGURE = Figure("C-3", __doc__, [SPECTRUM], draw, checks)
