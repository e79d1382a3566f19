# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: exponent of improved normal compliance, steps of 1 ms.

Energy relative to the start. Bands: ten positions of the impact within a step. The larger the
exponent, the softer the contact at these penetrations, and the more energy its potential holds.
"""

from shared.figure import Figure
from shared.measures import dip, mean, smallest_factor
from shared.methods import INC
from shared.paper_numbers import compare

from .common import FINE, FINE_BAND
from .exponents import checks_exponents, draw_exponents, runs_and_bands


def checks():
    dips = [mean([dip(r) for r in FINE_BAND[INC[a].key]]) for a in (2, 3, 4, 5)]
    return [
        compare("A.figure_9.grows", smallest_factor(dips)),
        compare("A.figure_9.large", dips[-1]),
        *checks_exponents(FINE, FINE_BAND, "A.figure_9"),
    ]


FIGURE = Figure(
    "A-9",
    __doc__,
    runs_and_bands(FINE, FINE_BAND),
    lambda: draw_exponents(FINE, FINE_BAND, "1ms", (-2, 45)),
    checks,
)
