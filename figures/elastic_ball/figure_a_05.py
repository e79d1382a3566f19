# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: improved normal compliance for several coefficients.

Energy relative to the start, alpha = 3, steps of 10 ms. Bands: five positions of the impact
within a step. The energy comes back whatever the coefficient. 2.6e12 Pa/m^2 stands for the
paper's 1000.
"""

import numpy as np

from shared.curves import panels_with_bands
from shared.figure import Figure
from shared.measures import dip, energy, mean, missing_after, penetration
from shared.methods import SCALE
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row
from shared.runs import QUIET, Run

from .common import AGAINST, COARSE, STEP, positions

# 2.6e12 Pa/m^2 stands for the paper's 1000.
COEFFICIENTS = (2.6e10, 2.6e11, 2.6e12, 2.6e13, 2.6e14)
BY_COEFFICIENT = {
    c: COARSE["inc3"]
    if c == 2.6e12
    else Run(
        "A-5",
        f"inc3_{c:.1e}",
        "elastic_ball",
        "elastic_ball/figure_A08_inc3.prm",
        (*QUIET, f"Contact/Compliance coefficient={c:g}"),
        cost=0.8,
    )
    for c in COEFFICIENTS
}
# Every other position.
BY_COEFFICIENT_BAND = {c: positions(r, "10ms")[::2] for c, r in BY_COEFFICIENT.items()}
RUNS = [r for c in COEFFICIENTS for r in (BY_COEFFICIENT[c], *BY_COEFFICIENT_BAND[c])]


def draw():
    curves = [
        (
            BY_COEFFICIENT[c],
            BY_COEFFICIENT_BAND[c],
            colour,
            rf"$c_\nu = {c / 1e12:g}\cdot 10^{{12}}$ Pa/m$^2$",
        )
        for c, colour in zip(COEFFICIENTS, SCALE)
    ]
    return panels_with_bands(curves, energy, STEP["10ms"][1], AGAINST, (-20, 70))


def named(coefficient):
    """Its name in numbers/own.toml: 26e11 for 2.6e12."""
    return f"26e{round(np.log10(coefficient / 26))}"


def checks():
    dips = {c: mean([dip(r) for r in BY_COEFFICIENT_BAND[c]]) for c in COEFFICIENTS}
    return [
        compare("A.figure_5.recovered", missing_after(RUNS)),
        compare("A.figure_5.fluctuation", dips[2.6e12] / dips[2.6e14]),
        constant_row("all c_nu", RUNS, "modified_energy", "-"),
        *(
            compare(
                f"own.ball_by_coefficient.deepest_{named(c)}",
                max(penetration(r) for r in BY_COEFFICIENT_BAND[c]),
            )
            for c in COEFFICIENTS
        ),
        *(
            compare(f"own.ball_by_coefficient.dip_{named(c)}", dips[c])
            for c in COEFFICIENTS
        ),
    ] + checks_of_runs(RUNS)


FIGURE = Figure("A-5", __doc__, RUNS, draw, checks)
