# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks that several figures share."""

import numpy as np

from .figure import check, info, note
from .measures import energy, lost, percent, span
from .runs import Run


def statement(quantity, ours, holds, criterion, paper, reason):
    """A statement of a paper: a check, or a note with the reason if it does not hold."""
    if holds:
        return check(quantity, ours, True, criterion, paper)
    return note(quantity, ours, reason, paper)


def checks_of_runs(runs, tolerance=1e-9, criterion="< 1e-9 of the energy"):
    """What must hold in each run, whatever the method."""
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


def recovered_row(name, runs):
    """The energy of a compliance law is back whenever no point penetrates."""
    runs = [runs] if isinstance(runs, Run) else list(runs)
    worst, after = 0.0, []
    for run in runs:
        values = energy(run)
        free = np.flatnonzero(run.read()["active_points_foundation"] == 0)
        worst = max(worst, np.abs(values[free] - 1).max())
        after.append(free[-1] > values.argmin())
    return check(
        f"{name}: energy lost when there is no contact",
        f"{worst:.1e}",
        worst < 1e-9 and all(after),
        "< 1e-9, also after the deepest dip of each run",
        "0",
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


def loses_row(name, runs, paper, bounds=None, criterion=""):
    """Energy lost over the positions, with bounds for the whole range or without."""
    losses = [lost(run) for run in runs]
    ours = percent(losses)
    if bounds is None:
        return info(f"{name}: energy lost", ours, paper)
    passed = min(losses) >= bounds[0] and max(losses) <= bounds[1]
    return check(f"{name}: energy lost", ours, passed, criterion, paper)


def order_row(quantity, values, criterion, paper, form="{:.2f} %", rising=True):
    """Numbers that must rise (or fall) strictly from each to the next."""
    steps = np.diff(values) if rising else -np.diff(values)
    ours = ", ".join(form.format(value) for value in values)
    return check(quantity, ours, bool((steps > 0).all()), criterion, paper)


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


def factor_row(name, values, paper, reason):
    """Whether some of the values is within a factor of two of the paper's."""
    return statement(
        f"largest penetration, {name} (m)",
        span(values),
        min(values) <= 2 * paper and max(values) >= paper / 2,
        "some position within a factor of two",
        f"{paper:.2e}",
        reason,
    )
