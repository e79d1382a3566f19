# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: exponent of improved normal compliance, steps of 1 ms.

Energy relative to the start. Bands: ten positions of the impact within a step. The larger the
exponent, the softer the contact at these penetrations, and the more energy its potential holds.
"""

from shared.figure import Figure
from shared.measures import dip, mean
from shared.methods import INC
from shared.paper_numbers import numbers
from shared.rows import checks_of_runs, loses_row, order_row

from .common import FINE, FINE_BAND
from .exponents import checks_exponents, draw_exponents, runs_and_bands

LOST = numbers("A.figure_9")["snc_lost"]


def checks():
    snc = loses_row(
        "SNC",
        FINE_BAND["snc"],
        f"{100 * LOST:g} %",
        (0.001, 0.02),
        "between 0.1 and 2 % at each position",
    )
    rows, runs = checks_exponents(FINE, FINE_BAND, snc)
    dips = [mean([100 * dip(r) for r in FINE_BAND[INC[a].key]]) for a in (2, 3, 4, 5)]
    rows.append(
        order_row(
            "mean dip for alpha = 2, 3, 4, 5",
            dips,
            "grows from each to the next",
            "strictly increasing; large above alpha = 4",
        )
    )
    return rows + checks_of_runs(runs)


FIGURE = Figure(
    "A-9",
    __doc__,
    runs_and_bands(FINE, FINE_BAND),
    lambda: draw_exponents(FINE, FINE_BAND, "1ms", (-2, 45)),
    checks,
)
