# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: the two viscosities of paper B.

Energy relative to the start with persistent contact, steps of 1/300 s. Curnier's power is that of
the rate of C alone; Pioletti's has the factor (tr C - 3)/2 besides, so that a ring that is hardly
strained is hardly damped: with sixteen times the eta it dissipates a little less.
"""

from shared.curves import energy_axes
from shared.figure import Figure
from shared.measures import lost
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, dissipative_row

from .common import draw_lines, run, share_row
from .dissipation import B9

CURNIER = {eta: B9[eta] for eta in (100, 1600)}
PIOLETTI = {
    eta: run(
        "R-4",
        f"pioletti_{eta}",
        "figure_B09_eta_0.prm",
        ("Material/Viscosity=Pioletti", f"Material/Viscosity eta={eta}"),
        cost=35,
    )
    for eta in (100, 1600)
}
COLOURS = {100: "#0072B2", 1600: "#D55E00"}


def draw():
    figure, axes = energy_axes()
    for runs, name in ((CURNIER, "Curnier"), (PIOLETTI, "Pioletti")):
        labels = (rf"{name}, $\eta$ = {eta} Pa s" for eta in runs)
        draw_lines(axes, zip(runs.values(), COLOURS.values(), labels))
    for line in axes.lines[-2:]:
        line.set_linestyle((0, (4, 2)))
    return figure


def checks():
    rows = [dissipative_row("Pioletti", PIOLETTI.values())]
    for eta, one in PIOLETTI.items():
        rows += [
            compare(f"own.pioletti.lost_{eta}", lost(one)),
            share_row(f"Pioletti, eta = {eta} Pa s", one, "viscous_dissipation"),
        ]
    return rows + checks_of_runs(PIOLETTI.values())


FIGURE = Figure("R-4", __doc__, [*CURNIER.values(), *PIOLETTI.values()], draw, checks)
