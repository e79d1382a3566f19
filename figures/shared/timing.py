# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds of the steps of a run, and how they grow with the degrees of freedom."""

import numpy as np

from .paper_numbers import compare


def timing_of_steps(run):
    """Seconds in the steps of a run, without its start, and their number."""
    results = run.results
    return results.seconds_in_steps, len(results.table) - 1


def timing_exponent(dofs, seconds, last):
    """Slope of log(seconds) against log(degrees of freedom), on the finest meshes."""
    return np.polyfit(np.log(dofs[-last:]), np.log(seconds[-last:]), 1)[0]


def cost_checks(place, methods, runs, family):
    """Rows of the numbers of `place`, "A.table_2" or "A.table_4": seconds of a method.

    Machines differ: comparable are a method against Signorini's multipliers on the same mesh, and
    how the seconds grow from the coarsest mesh to the finest.
    """
    dofs = [2 * nodes for nodes in family.values()]
    seconds = {m.key: [timing_of_steps(runs[m.key, n])[0] for n in family] for m in methods}
    rows = []
    for method in methods:
        ours = seconds[method.key]
        if method.key != "signorini":
            rows += [
                compare(f"{place}.{method.key}_{n}", one / reference)
                for n, one, reference in zip(family, ours, seconds["signorini"])
            ]
        rows.append(
            compare(f"{place}.{method.key}_exponent", timing_exponent(dofs, ours, len(dofs)))
        )
    return rows
