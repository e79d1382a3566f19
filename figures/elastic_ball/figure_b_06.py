# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: persistent contact with viscosity.

Energy relative to the start for linear viscosities. Without viscosity it is constant; the larger
the viscosity, the more is dissipated, and the energy never rises.
"""

import numpy as np

from shared.curves import curve, energy_axes, legend_above
from shared.figure import Figure
from shared.measures import change, energy, lost, smallest_factor
from shared.methods import SCALE
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, dissipative_row

from .common import AGAINST, FINE, STEP, run

RUNS = {0: FINE["persistent"]}
RUNS.update({float(eta): run("B-6", f"eta_{eta}") for eta in ("1e5", "1e6", "1e7")})


def draw():
    figure, axes = energy_axes()
    for (eta, one), colour in zip(RUNS.items(), ("#D55E00", *SCALE)):
        label = rf"$\eta = {eta / 1e6:g}$ MPa s"
        curve(axes, one, energy, STEP["1ms"][1], colour, label)
    axes.set_xlabel(AGAINST)
    axes.set_xlim(-2, 54)
    legend_above(axes)
    return figure


def checks():
    damped = {eta: one for eta, one in RUNS.items() if eta}
    losses = {eta: lost(one) for eta, one in damped.items()}
    parts = []
    for one in damped.values():
        table = one.read()
        taken = table["viscous_dissipation"][-1] / (table["energy"][0] - table["energy"][-1])
        parts.append(abs(taken - 1))
    return [
        compare("B.figure_6.without", change([RUNS[0]])),
        compare("B.figure_6.grows", smallest_factor(list(losses.values()))),
        compare("B.figure_6.of_the_model", max(parts)),
        *(compare(f"B.figure_6.lost_1e{np.log10(eta):.0f}", part) for eta, part in losses.items()),
        dissipative_row("with viscosity", damped.values()),
    ] + checks_of_runs(RUNS.values())


FIGURE = Figure("B-6", __doc__, list(RUNS.values()), draw, checks)
