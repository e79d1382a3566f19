# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stent and artery: friction.

Left: change of energy less the work of the imposed displacement, in each step; right: the
dissipation of friction and viscosity. Above: without viscosity; below: with eta = 1, as in the
paper, which has no unit; here MPa s.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure
from shared.measures import smallest_factor
from shared.paper_numbers import compare

from .common import (
    ETA_WITH_FRICTION,
    MUS,
    change,
    dissipation,
    family,
    halvings,
    largest_change,
    ledger_rows,
)
from .dissipation import draw_steps


def draw():
    figure, axes = plt.subplots(2, 2, figsize=(6.8, 6.4), layout="constrained")
    for row, eta in zip(axes, ("0", ETA_WITH_FRICTION)):
        draw_steps(*row, family(MUS, (eta,)), lambda mu, _: rf"$\mu$ = {mu}")
        row[0].set_title(rf"$\eta$ = {eta} MPa s", loc="left")
    return figure


def fluctuation(one):
    """How much the change in a step goes up and down (uJ): its total variation."""
    return 1e3 * np.abs(np.diff(change(one))).sum()


def checks():
    runs = family(MUS, (ETA_WITH_FRICTION,))
    taken = {mu: dissipation(one)[-1] for (mu, _), one in runs.items()}
    frictional = family(MUS[1:], ("0", ETA_WITH_FRICTION))
    return [
        compare("B.figure_16.viscosity", taken["0"]),
        compare("B.figure_16.grows", smallest_factor(list(taken.values()))),
        compare(
            "B.figure_16.fluctuations",
            smallest_factor([fluctuation(one) for one in runs.values()]),
        ),
        compare("B.figure_16.negative", largest_change(runs.values())),
        *(
            compare(f"B.figure_16.taken_{mu.replace('.', '')}", taken[mu])
            for mu in MUS[1:]
        ),
        *(
            compare(
                f"B.figure_16.without_{mu.replace('.', '')}", dissipation(frictional[mu, "0"])[-1]
            )
            for mu in MUS[1:]
        ),
        compare("own.stent.halvings", halvings([*runs.values(), *frictional.values()])),
        *ledger_rows([*runs.values(), *frictional.values()]),
    ]


FIGURE = Figure("B-16", __doc__, list(family(MUS, ("0", ETA_WITH_FRICTION)).values()), draw, checks)
