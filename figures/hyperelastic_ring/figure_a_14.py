# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: improved normal compliance for several time steps.

Energy relative to the start, alpha = 3. The dips fall with the step.
"""

from shared.curves import curve, energy_axes, legend_above
from shared.figure import Figure
from shared.measures import dip, energy, missing_after
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row, momentum_row

from .common import AGAINST, FULL, run

COARSE = run("A-14", "100ms", cost=4)
CURVES = (
    (COARSE, "#D55E00", 0.55, "100 ms"),
    (FULL["inc3"], "#0072B2", 0.55, "10 ms"),
    (run("A-14", "1ms", cost=110), "#000000", 0.555, "1 ms"),
)
RUNS = [one for one, *_ in CURVES]


def draw():
    figure, axes = energy_axes()
    for one, colour, start, label in CURVES:
        curve(axes, one, energy, start, colour, rf"$\Delta t$ = {label}", 1.0)
    axes.set_xlabel(AGAINST)
    legend_above(axes, 3)
    return figure


def checks():
    dips = [dip(one) for one in RUNS]
    return [
        compare("A.figure_14.recovered", missing_after(RUNS)),
        compare("A.figure_14.fine", dips[1] / dips[2]),
        compare("A.figure_14.coarse", dips[0]),
        compare("own.ring_steps.halvings", COARSE.read()["step_halvings"].max()),
        constant_row("all steps", RUNS, "modified_energy", "-"),
        momentum_row(RUNS),
    ] + checks_of_runs(RUNS[1:])


FIGURE = Figure("A-14", __doc__, RUNS, draw, checks)
