# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a run that several figures show, and ranges of them as text."""

import re

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


def penetration(run):
    return run.read()["penetration_foundation"].max()


def mean(values):
    return sum(values) / len(values)


def span(values, form="{:.2e}"):
    """The range of some numbers, as text."""
    return f"{form.format(min(values))} to {form.format(max(values))}"


def scientific(value, digits=3):
    """A number as a table has it, 1.54·10⁻²; 0 for what is round-off of metres."""
    if abs(value) < 1e-12:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(SUPERSCRIPTS)}"


def scientific_span(values, digits=3):
    """The range of some numbers, as a table has it."""
    ends = [scientific(value, digits) for value in (min(values), max(values))]
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def percent(values):
    return span([100 * value for value in values], "{:.2f}") + " %"


def wall_clock(run):
    """Seconds of a run, from its start to its end."""
    return float(re.search(r"elapsed since start +\| +([0-9.e+-]+)s", run.results.log).group(1))
