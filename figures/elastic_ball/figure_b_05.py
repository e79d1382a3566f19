# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: contact force and pressure of the methods of paper B.

Force that acts during each step (left) and largest pressure at its end (right) over the time of the
impact, steps of 1 ms, with the impact in the middle of a step; grey: Signorini's condition. The
force of all but persistent contact is the same to the width of a line; the pressure of Hauret and
Le Tallec's penalisation swings from step to step.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.curves import curve, name_panel
from shared.figure import Figure, check
from shared.methods import HAURET, SIGNORINI
from shared.paper_numbers import compare
from shared.rows import checks_of_runs

from .common import AGAINST, FINE, FINE_BAND, METHODS_B, STEP, with_bands


def force(one):
    """The force (N) that acts during each step, from the momentum of the ball."""
    table = one.read()
    steps = np.diff(table["momentum_y"]) / np.diff(table["time"])
    return np.concatenate(([0.0], steps))


def pressure(one):
    """The largest contact pressure at the end of each step (Pa)."""
    return one.read()["contact_pressure_foundation"]


def draw():
    figure, axes = plt.subplots(
        len(METHODS_B), 2, figsize=(6.8, 9), sharex=True, sharey="col", layout="constrained"
    )
    start = STEP["1ms"][1]
    for row, method in zip(axes, METHODS_B):
        for panel, values in zip(row, (lambda r: force(r) / 1e6, lambda r: pressure(r) / 1e6)):
            if method is not SIGNORINI:
                curve(panel, FINE["signorini"], values, start, "0.7", None)
            curve(panel, FINE[method.key], values, start, method.colour, None, marker=".")
            name_panel(panel, method.label)
    axes[0, 0].set_xlim(-1, 32)
    figure.supxlabel(AGAINST, fontsize=10)
    axes[0, 0].set_title("contact force of the step (MN)\n", fontsize=11)
    axes[0, 1].set_title("largest contact pressure (MPa)\n", fontsize=11)
    return figure


def impulse_row(method):
    """Newton's second law; the force of a step acts during all of it."""
    table = FINE[method.key].read()
    impulse = 1e-3 * table["contact_force_foundation"].sum()
    error = abs(impulse / (table["momentum_y"][-1] - table["momentum_y"][0]) - 1)
    return check(
        f"{method.name}: impulse of the table's contact force / change of momentum - 1",
        f"{error:.1e}",
        error < 1e-9,
        "< 1e-9: Newton's tolerance",
        exact="0",
    )


def checks():
    peak = {key: max(force(r).max() for r in FINE_BAND[key]) for key in ("two_step", "signorini")}
    return [
        # Hauret's force in the ledger is that of the penetration at the end of a step.
        *(impulse_row(method) for method in METHODS_B if method is not HAURET),
        *(compare(f"own.ball_forces.{m.key}", force(FINE[m.key]).max()) for m in METHODS_B),
        compare("B.figure_5.two_step", peak["two_step"] / peak["signorini"]),
    ] + checks_of_runs([FINE[m.key] for m in METHODS_B])


FIGURE = Figure("B-5", __doc__, with_bands(METHODS_B, FINE, FINE_BAND), draw, checks)
