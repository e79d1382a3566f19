# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stent and artery: viscosity.

Without friction. Left: change of energy less the work of the imposed displacement, in each step;
right: what viscosity has taken. The paper's viscosities have no unit.
"""

import matplotlib.pyplot as plt

from shared.figure import Figure
from shared.rows import order_row

from .common import ETAS, dissipation, family
from .dissipation import conserving_row, draw_steps, stent_rows


def draw():
    figure, axes = plt.subplots(1, 2, figsize=(6.8, 3.6), layout="constrained")
    draw_steps(*axes, family(etas=ETAS), lambda mu, eta: rf"$\eta$ = {eta} MPa s")
    return figure


def checks():
    runs = family(etas=ETAS)
    damped = {key: one for key, one in runs.items() if key != ("0", "0")}
    return [
        conserving_row(),
        order_row(
            "dissipated (mJ), eta = 0, 0.001, 0.01, 0.03 MPa s",
            [dissipation(one)[-1] for one in runs.values()],
            "grows with eta",
            "grows with eta",
            "{:.4f}",
        ),
        *stent_rows(damped),
    ]


FIGURE = Figure("B-15", __doc__, list(family(etas=ETAS).values()), draw, checks)
