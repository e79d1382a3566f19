# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: persistent contact with viscosity.

Energy relative to the start for linear viscosities. Without viscosity it is constant; the larger
the viscosity, the more is dissipated, and the energy never rises.
"""

from shared.curves import curve, energy_axes, legend_above
from shared.figure import Figure, check
from shared.measures import energy, lost
from shared.methods import SCALE
from shared.rows import checks_of_runs, constant_row, dissipative_row, order_row

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
    losses = [100 * lost(r) for r in RUNS.values()]
    rows = [constant_row("no viscosity", RUNS[0])]
    rows.append(dissipative_row("with viscosity", [r for eta, r in RUNS.items() if eta]))
    for eta, one in RUNS.items():
        if eta:
            table = one.read()
            part = table["viscous_dissipation"][-1] / (table["energy"][0] - table["energy"][-1])
            rows.append(
                check(
                    f"eta = {eta:g} Pa s: viscous dissipation / energy lost - 1",
                    f"{part - 1:.1e}",
                    abs(part - 1) < 1e-9,
                    "< 1e-9: nothing else dissipates",
                    exact="0",
                )
            )
    rows.append(
        order_row(
            "energy lost for eta = 0, 0.1, 1, 10 MPa s",
            losses,
            "grows with eta",
            "grows with eta",
        )
    )
    return rows + checks_of_runs(RUNS.values())


FIGURE = Figure("B-6", __doc__, list(RUNS.values()), draw, checks)
