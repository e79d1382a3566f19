# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a run that several figures show, and ranges of them as text."""

import re

import numpy as np
from ricochet import RicochetError

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def energy(run, column="energy"):
    """Energy of each step, relative to the start."""
    table = run.read()
    return table[column] / table["energy"][0]


def lost(run):
    """Part of the energy that is gone at the end."""
    return 1 - energy(run)[-1]


def dip(run):
    """Part of the energy that is gone when it is least."""
    return 1 - energy(run).min()


def change(runs, column="energy"):
    """The largest change of energy of some runs, relative to the start."""
    return max(np.abs(energy(run, column) - 1).max() for run in runs)


def missing_after(runs):
    """The largest part of the energy that is gone in a step in which no point penetrates.

    Raises:
        RicochetError: a run ends before it is free again.
    """
    worst = 0.0
    for run in runs:
        values = energy(run)
        free = np.flatnonzero(run.read()["active_points_foundation"] == 0)
        if free[-1] <= values.argmin():
            raise RicochetError(f"The run {run.name} ends in contact.")
        worst = max(worst, np.abs(values[free] - 1).max())
    return worst


def smallest_factor(values):
    """The smallest factor from a value to the next: above 1 where they grow strictly."""
    return min(after / before for before, after in zip(values, values[1:]))


def penetration(run):
    return run.read()["penetration_foundation"].max()


def mean(values):
    return sum(values) / len(values)


def scientific(value, digits=3):
    """A number as in a table, 1.54·10⁻²; 0 for round-off of metres."""
    if abs(value) < 1e-12:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(SUPERSCRIPTS)}"


def scientific_span(values, digits=3):
    """The range of some numbers, as a table has it."""
    ends = [scientific(value, digits) for value in (min(values), max(values))]
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def wall_clock(run):
    """Seconds of a run, from its start to its end."""
    return float(re.search(r"elapsed since start +\| +([0-9.e+-]+)s", run.results.log).group(1))
