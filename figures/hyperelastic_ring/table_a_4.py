# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: cost against degrees of freedom, table (timed).

Milliseconds per step over the first second of the motion, without the start of the program,
beside the CPU seconds of the paper's table 4.
"""

from shared.figure import Figure, Table
from shared.rows import checks_of_runs
from shared.timing import cost_checks, timing_of_steps

from .cost import COST_METHODS, FAMILY, NODES, PAPER, RUNS


def table():
    rows = [["degrees of freedom", *(str(2 * nodes) for nodes in NODES.values())]]
    for method in COST_METHODS:
        timings = [timing_of_steps(RUNS[method.key, n]) for n in FAMILY]
        ours = (f"{1e3 * seconds / steps:.3g}" for seconds, steps in timings)
        rows.append([f"{method.name}, ours (ms a step)", *ours])
        rows.append([f"{method.name}, paper (s)", *(f"{t:g}" for t in PAPER[method.key])])
    return Table(["nodes on the circle", *map(str, FAMILY)], rows)


def checks():
    return cost_checks("A.table_4", COST_METHODS, RUNS, NODES) + checks_of_runs(RUNS.values())


FIGURE = Figure("A-T4", __doc__, list(RUNS.values()), None, checks, timed=True, table=table)
