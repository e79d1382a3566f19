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
from shared.figure import Figure, check, info
from shared.methods import HAURET, SIGNORINI
from shared.rows import checks_of_runs, statement

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


def roughness(values):
    """Total variation over twice the largest value: 1 for a single bump."""
    return np.abs(np.diff(values)).sum() / (2 * values.max())


def checks():
    rows = []
    momentum = abs(FINE["signorini"].read()["momentum_y"][0])
    for method in METHODS_B:
        one = FINE[method.key]
        table = one.read()
        # Newton's second law; the force of a step acts during all of it.
        impulse = 1e-3 * table["contact_force_foundation"].sum()
        change = table["momentum_y"][-1] - table["momentum_y"][0]
        error = abs(impulse / change - 1)
        rows.append(
            statement(
                f"{method.name}: impulse of the ledger's contact force / change of momentum - 1",
                f"{error:.1e}",
                error < 1e-9,
                "< 1e-9: Newton's tolerance",
                "-",
                "the ledger's force is that of the penetration at the end of a step, not the "
                "one that acts during it; the upper panel takes the change of momentum",
            )
            if method is HAURET
            else check(
                f"{method.name}: impulse of the ledger's contact force / change of momentum - 1",
                f"{error:.1e}",
                error < 1e-9,
                "< 1e-9: Newton's tolerance",
                exact="0",
            )
        )
        rows.append(
            info(
                f"{method.name}: impulse / momentum before; largest force (N); bumps of the force",
                f"{change / momentum:.4f}; {force(one).max():.2e}; {roughness(force(one)):.2f}",
            )
        )
    peak = {key: max(force(r).max() for r in FINE_BAND[key]) for key in ("two_step", "signorini")}
    rows.append(
        statement(
            "largest force over the positions, two-step over Signorini",
            f"{peak['two_step'] / peak['signorini']:.3f}",
            peak["two_step"] > 1.02 * peak["signorini"],
            "above 1.02",
            "two-step raises the contact stress",
            "the force of our two-step scheme is that of Signorini's condition to one per cent",
        )
    )
    return rows + checks_of_runs([FINE[m.key] for m in METHODS_B])


FIGURE = Figure("B-5", __doc__, with_bands(METHODS_B, FINE, FINE_BAND), draw, checks)
