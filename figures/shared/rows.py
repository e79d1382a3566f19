# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks of several figures."""

import numpy as np

from .figure import check
from .measures import energy
from .runs import Run


def checks_of_runs(runs, tolerance=1e-9, criterion="< 1e-9 of the energy"):
    """Conditions that must hold in each run, whatever the method."""
    runs = list({run.folder: run for run in runs}.values())
    # Newton's tolerance is 1e-12 of the forces; stiff contact multiplies it.
    residual = max(np.abs(run.read()["balance_residual"]).max() for run in runs)
    # The column of halvings counts from the start.
    halvings = sum(int(run.read()["step_halvings"].max()) for run in runs)
    return [
        check(
            f"max |balance residual|, {len(runs)} runs",
            f"{residual:.1e}",
            residual < tolerance,
            criterion,
            exact="0",
        ),
        check(f"step halvings, {len(runs)} runs", f"{halvings}", halvings == 0, "none", exact="0"),
    ]


def constant_row(name, runs, column="energy", paper="conserved"):
    """The energy of a conserving method stays where it was."""
    runs = [runs] if isinstance(runs, Run) else list(runs)
    worst = max(np.abs(energy(run, column) - 1).max() for run in runs)
    what = "energy" if column == "energy" else "energy and contact potential"
    return check(
        f"{name}: max change of {what}",
        f"{worst:.1e}",
        worst < 1e-9,
        "< 1e-9: Newton's tolerance, summed over the steps",
        paper,
        "0",
    )


def dissipative_row(name, runs, column="energy", tolerance=1e-12):
    """The energy of a method with friction or viscosity never rises."""
    runs = [runs] if isinstance(runs, Run) else list(runs)
    rise = max(np.diff(energy(run, column)).max() for run in runs)
    what = "energy" if column == "energy" else "energy and contact potential"
    return check(
        f"{name}: largest rise of {what} in a step",
        f"{rise:.1e}",
        rise <= tolerance,
        f"at most {tolerance:g} of the initial energy",
        "only falls",
        "<= 0",
    )


def momentum_row(runs):
    """Without friction no force acts along the foundation."""
    worst = 0.0
    for run in runs:
        table = run.read()
        size = np.hypot(table["momentum_x"][0], table["momentum_y"][0])
        worst = max(worst, np.abs(table["momentum_x"] - table["momentum_x"][0]).max() / size)
    return check(
        "max change of momentum along the foundation",
        f"{worst:.1e}",
        worst < 1e-9,
        "< 1e-9 of the initial momentum",
        exact="0",
    )
