# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: improved normal compliance for several coefficients.

Energy relative to the start, alpha = 3, steps of 10 ms. Bands: five positions of the impact
within a step. The energy comes back whatever the coefficient. 2.6e12 Pa/m^2 stands for the
paper's 1000.
"""

from shared.curves import panels_with_bands
from shared.figure import Figure
from shared.measures import dip, energy, mean, penetration
from shared.methods import SCALE
from shared.paper_numbers import numbers
from shared.rows import checks_of_runs, constant_row, order_row, recovered_row, statement
from shared.runs import QUIET, Run

from .common import AGAINST, COARSE, STEP, positions

PAPER = numbers("A.figure_5")

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


def checks():
    deepest = [max(penetration(r) for r in BY_COEFFICIENT_BAND[c]) for c in COEFFICIENTS]
    dips = [mean([100 * dip(r) for r in BY_COEFFICIENT_BAND[c]]) for c in COEFFICIENTS]
    falls = all(a > b for a, b in zip(dips, dips[1:]))
    return [
        recovered_row("all c_nu", RUNS),
        constant_row("all c_nu", RUNS, "modified_energy", "-"),
        order_row(
            "largest penetration (m), by c_nu from small to large",
            deepest,
            "falls from each to the next",
            "practically none for large c_nu",
            "{:.1e}",
            rising=False,
        ),
        statement(
            "mean dip, by c_nu from small to large",
            ", ".join(f"{value:.1f} %" for value in dips),
            falls,
            "falls from each to the next",
            PAPER["said"],
            "the dip is the energy in the contact potential, which falls as c_nu grows, but at "
            "this step a stiffer contact also lands nodes deeper than they would stay: the dip "
            "ends at the loss that Signorini's condition has",
        ),
    ] + checks_of_runs(RUNS)


FIGURE = Figure("A-5", __doc__, RUNS, draw, checks)
