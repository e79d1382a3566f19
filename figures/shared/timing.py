# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds of the steps of a run, and how they grow with the degrees of freedom."""

import numpy as np

from .figure import check, info
from .rows import statement


def timing_of_steps(run):
    """Seconds in the steps of a run, without its start, and their number."""
    results = run.results
    return results.seconds_in_steps, len(results.table) - 1


def timing_exponent(dofs, seconds, last=3):
    """Slope of log(seconds) against log(degrees of freedom), on the finest meshes."""
    return np.polyfit(np.log(dofs[-last:]), np.log(seconds[-last:]), 1)[0]


def cost_checks(methods, runs, family, paper):
    """Cost of a step against degrees of freedom, on meshes of one family."""
    rows = []
    dofs = [2 * nodes for nodes in family.values()]
    for method in methods:
        timings = [timing_of_steps(runs[method.key, n]) for n in family]
        for n, (seconds, steps), cpu in zip(family, timings, paper[method.key]):
            rows.append(
                info(
                    f"{method.name}, {n} nodes on the circle: steps (s), a step (ms)",
                    f"{seconds:.3g}, {1e3 * seconds / steps:.3g}",
                    f"{cpu:g} s",
                )
            )
        seconds = [t[0] for t in timings]
        slope = timing_exponent(dofs, seconds, last=len(dofs))
        theirs = timing_exponent(dofs, paper[method.key], last=len(dofs))
        rows.append(
            check(
                f"{method.name}: exponent of the cost in degrees of freedom, all meshes",
                f"{slope:.2f}",
                slope < 1.3,
                "< 1.3",
                f"{theirs:.2f}",
            )
        )
        rows.append(
            info(
                f"{method.name}: the same, three finest meshes",
                f"{timing_exponent(dofs, seconds):.2f}",
                f"{timing_exponent(dofs, paper[method.key]):.2f}",
            )
        )
    finest = {m.key: timing_of_steps(runs[m.key, list(family)[-1]])[0] for m in methods}
    ratio = finest["inc3"] / finest["snc"]
    theirs = paper["inc3"][-1] / paper["snc"][-1]
    rows.append(
        check(
            "finest mesh, INC over SNC, both with alpha = 3",
            f"{ratio:.2f}",
            ratio < 1.3,
            "< 1.3",
            f"{theirs:.2f}",
        )
    )
    ratio = finest["signorini"] / finest["persistent"]
    theirs = paper["signorini"][-1] / paper["persistent"][-1]
    rows.append(
        statement(
            "finest mesh, Signorini multipliers over persistent contact",
            f"{ratio:.2f}",
            ratio > 1,
            "more than 1",
            f"{theirs:.1f}",
            "a sparse direct solver takes the few multipliers of the active nodes in its stride",
        )
    )
    return rows
