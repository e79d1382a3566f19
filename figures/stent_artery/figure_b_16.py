# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stent and artery: friction.

Left: change of energy less the work of the imposed displacement, in each step; right: what
friction and viscosity have taken. Above: without viscosity; below: with, as in the paper, whose
eta = 1 has no unit.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure
from shared.rows import order_row, statement

from .common import ETA_WITH_FRICTION, MUS, change, dissipation, family
from .dissipation import conserving_row, draw_steps, stent_rows


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
    rows = [conserving_row()]
    for eta in ("0", ETA_WITH_FRICTION):
        runs = family(MUS, (eta,))
        rows.append(
            order_row(
                f"eta = {eta}: dissipated (mJ), mu = 0, 0.1, 0.2, 0.4",
                [dissipation(one)[-1] for one in runs.values()],
                "grows with mu",
                "grows with mu",
                "{:.4f}",
            )
        )
        values = [fluctuation(one) for one in runs.values()]
        rows.append(
            statement(
                f"eta = {eta}: total variation of the change in a step (uJ)",
                ", ".join(f"{value:.1f}" for value in values),
                bool((np.diff(values) > 0).all()),
                "grows with mu",
                "fluctuations grow with mu",
                "does not grow from each mu to the next",
            )
        )
    dissipative = {
        key: one for key, one in family(MUS, ("0", ETA_WITH_FRICTION)).items() if key[0] != "0"
    }
    return rows + stent_rows(dissipative)


FIGURE = Figure("B-16", __doc__, list(family(MUS, ("0", ETA_WITH_FRICTION)).values()), draw, checks)
