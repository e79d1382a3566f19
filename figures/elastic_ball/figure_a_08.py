# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: exponent of improved normal compliance, steps of 10 ms.

Energy relative to the start. Bands: ten positions of the impact within a step. With steps of 10
ms, three to an impact, the position decides more than the exponent does.
"""

from shared.figure import Figure, check, info
from shared.measures import dip, lost, percent
from shared.methods import INC
from shared.paper_numbers import numbers
from shared.rows import checks_of_runs

from .common import COARSE, COARSE_BAND
from .exponents import checks_exponents, draw_exponents, runs_and_bands

LOST = numbers("A.figure_8")["snc_lost"]


def checks():
    losses = [lost(r) for r in COARSE_BAND["snc"]]
    snc = check(
        "SNC: energy lost",
        percent(losses),
        min(losses) <= LOST <= max(losses),
        f"the ten positions reach {100 * LOST:g} %",
        f"{100 * LOST:g} %",
    )
    rows, runs = checks_exponents(COARSE, COARSE_BAND, snc)
    for alpha in (2, 3, 4, 5):
        dips = [dip(r) for r in COARSE_BAND[INC[alpha].key]]
        rows.append(info(f"{INC[alpha].name}: dip", percent(dips), "some fluctuations"))
    return rows + checks_of_runs(runs)


FIGURE = Figure(
    "A-8",
    __doc__,
    runs_and_bands(COARSE, COARSE_BAND),
    lambda: draw_exponents(COARSE, COARSE_BAND, "10ms", (-20, 90)),
    checks,
)
