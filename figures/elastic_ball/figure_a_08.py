# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: exponent of improved normal compliance, steps of 10 ms.

Energy relative to the start. Bands: ten positions of the impact within a step. With steps of 10
ms, three to an impact, the position decides more than the exponent does.
"""

from shared.figure import Figure
from shared.measures import dip
from shared.methods import INC
from shared.paper_numbers import compare

from .common import COARSE, COARSE_BAND
from .exponents import checks_exponents, draw_exponents, runs_and_bands


def checks():
    dips = [dip(r) for a in (2, 3, 4, 5) for r in COARSE_BAND[INC[a].key]]
    return [
        compare("A.figure_8.inc_dip", dips),
        *checks_exponents(COARSE, COARSE_BAND, "A.figure_8"),
    ]


FIGURE = Figure(
    "A-8",
    __doc__,
    runs_and_bands(COARSE, COARSE_BAND),
    lambda: draw_exponents(COARSE, COARSE_BAND, "10ms", (-20, 90)),
    checks,
)
