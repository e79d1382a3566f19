# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a run that several figures show, and ranges of them as text."""

import re


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


def penetration(run):
    return run.read()["penetration_foundation"].max()


def mean(values):
    return sum(values) / len(values)


def span(values, form="{:.2e}"):
    """The range of some numbers, as text."""
    return f"{form.format(min(values))} to {form.format(max(values))}"


def percent(values):
    return span([100 * value for value in values], "{:.2f}") + " %"


def wall_clock(run):
    """Seconds of a run, from its start to its end."""
    return float(re.search(r"elapsed since start +\| +([0-9.e+-]+)s", run.results.log).group(1))
