# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stent and artery: viscosity.

Without friction. Left: change of energy less the work of the imposed displacement, in each step;
right: the dissipation of viscosity. The paper's viscosities have no unit.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure
from shared.measures import smallest_factor
from shared.paper_numbers import compare

from .common import (
    ETAS,
    change,
    dissipation,
    family,
    largest_change,
    largest_energy,
    ledger_rows,
)
from .dissipation import draw_steps


def draw():
    figure, axes = plt.subplots(1, 2, figsize=(6.8, 3.6), layout="constrained")
    draw_steps(*axes, family(etas=ETAS), lambda mu, eta: rf"$\eta$ = {eta} MPa s")
    return figure


def checks():
    runs = family(etas=ETAS)
    damped = {eta: one for (_, eta), one in runs.items() if eta != "0"}
    taken = {eta: dissipation(one)[-1] for eta, one in damped.items()}
    conserving = runs["0", "0"]
    return [
        compare(
            "B.figure_15.without", np.abs(change(conserving)).max() / largest_energy(conserving)
        ),
        compare("B.figure_15.negative", largest_change(damped.values())),
        compare("B.figure_15.grows", smallest_factor(list(taken.values()))),
        *(
            compare(f"B.figure_15.taken_{eta.replace('.', '')}", value)
            for eta, value in taken.items()
        ),
        *ledger_rows(runs.values()),
    ]


FIGURE = Figure("B-15", __doc__, list(family(etas=ETAS).values()), draw, checks)
