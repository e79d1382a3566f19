# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: improved normal compliance for several time steps.

Energy relative to the start, alpha = 3. Bands: ten positions of the impact within a step. None is
shown for 0.1 ms. The dip of the small steps is the contact potential of the true motion, and does
not vanish.
"""

from shared.curves import curve, energy_axes, fill, legend_above
from shared.figure import Figure
from shared.measures import dip, energy, mean, missing_after
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row

from .common import AGAINST, COARSE, COARSE_BAND, FINE, FINE_BAND, STEP, run

FINEST = run("A-6", "inc3_0.1ms", cost=5)
CURVES = (("10ms", COARSE["inc3"]), ("1ms", FINE["inc3"]), ("0.1ms", FINEST))
BANDS = {"10ms": COARSE_BAND["inc3"], "1ms": FINE_BAND["inc3"]}
RUNS = [one for _, one in CURVES] + [r for group in BANDS.values() for r in group]


def draw():
    figure, axes = energy_axes()
    for (step, one), colour in zip(CURVES, ("#D55E00", "#0072B2", "#000000")):
        start = STEP[step][1]
        if step in BANDS:
            fill(axes, BANDS[step], energy, start, colour)
        curve(axes, one, energy, start, colour, rf"$\Delta t = {1e3 * STEP[step][0]:g}$ ms")
    axes.set_xlabel(AGAINST)
    axes.set_xlim(-15, 70)
    legend_above(axes, 3)
    return figure


def checks():
    dips = {step: mean([dip(r) for r in group]) for step, group in BANDS.items()}
    return [
        compare("A.figure_6.recovered", missing_after(RUNS)),
        compare("A.figure_6.coarse", dips["10ms"] / dips["1ms"]),
        compare("A.figure_6.fine", dip(FINEST) / dips["1ms"]),
        constant_row("all steps", RUNS, "modified_energy", "-"),
    ] + checks_of_runs(RUNS)


FIGURE = Figure("A-6", __doc__, RUNS, draw, checks)
