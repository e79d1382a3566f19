# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spectral radii of HHT and TR-BDF2.

As figure C-3, with TR-BDF2, whose spectral radius tends to zero.
"""

import numpy as np

from shared.curves import legend_above
from shared.figure import Figure, check
from shared.paper_numbers import compare

from .common import ALPHAS, SPECTRUM, hht, order_of, plot_hht, radius_axes


def draw():
    table = SPECTRUM.read()
    figure, axes = radius_axes()
    axes.plot(table["omega_tilde"], table["Crank-Nicolson"], "0.4", label=r"$\tilde\alpha = 0$")
    plot_hht(axes, table, ALPHAS)
    axes.plot(
        table["omega_tilde"],
        table["TR-BDF2"],
        color="#CC79A7",
        linewidth=2,
        label=r"TR-BDF2, $\tilde\gamma = 2 - \sqrt{2}$",
    )
    axes.set_ylim(0, 1.03)
    legend_above(axes, 3)
    return figure


def checks():
    table = SPECTRUM.read()
    omega, radius = table["omega_tilde"], table["TR-BDF2"]
    # L-stability: the stability function falls like 1/(omega dt), that is like
    # omega_tilde^(-1/2). The factor is 2 (1 + sqrt 2) = 4.83: 1.5e-3 at 1e7.
    far = omega >= 1e5
    slope = np.polyfit(np.log(omega[far]), np.log(radius[far]), 1)[0]
    hht_least = np.min([table[hht(alpha)] for alpha in ALPHAS], axis=0)
    return [
        compare("C.figure_4.limit", radius[-1]),
        check(
            "TR-BDF2: slope of the radius for omega >= 1e5",
            f"{slope:.4f}",
            abs(slope + 0.5) < 1e-3,
            "within 1e-3 of -1/2: falls to 0, L-stable",
            exact="-1/2",
        ),
        compare("C.figure_4.more", (hht_least - radius)[omega > 100].min()),
        compare("C.section_3.crank_nicolson", order_of("Crank-Nicolson")),
        compare("C.section_3.tr_bdf2", order_of("TR-BDF2")),
    ]


FIGURE = Figure("C-4", __doc__, [SPECTRUM], draw, checks)
