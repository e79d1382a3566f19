# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: cost against degrees of freedom (timed).

Seconds for the 200 steps of 10 ms, without the start of the program, beside the CPU seconds of
the paper's table 2. One factorisation serves all steps without contact. The numbers depend on the
machine, the exponents hardly.
"""

from shared.figure import Figure, Table
from shared.methods import INC, PERSISTENT, SIGNORINI, SNC
from shared.paper_numbers import series
from shared.rows import checks_of_runs
from shared.runs import QUIET, Run
from shared.timing import cost_checks, timing_of_steps

PAPER = series("A.table_2")
METHODS = (SIGNORINI, PERSISTENT, INC[3], SNC)
FAMILY = {16: 25, 32: 96, 64: 392, 128: 1580, 256: 6260}
RUNS = {
    (method.key, n): Run(
        "A-T2",
        f"{method.key}_{n}",
        "elastic_ball",
        "elastic_ball/figure_A08_inc3.prm"
        if method is INC[3]
        else f"elastic_ball/figure_A04_{method.key}.prm",
        (
            *QUIET,
            f"Mesh/Nodes={nodes}",
            f"Mesh/Boundary nodes={n}",
            "Time/Time step=1e-2",
            "Time/Final time=2",
            "Start/Initial gap=15.05",
            *(("Contact/Compliance exponent=3",) if method is SNC else ()),
        ),
        cost=n,
    )
    for method in METHODS
    for n, nodes in FAMILY.items()
}


def table():
    header = ["nodes on the circle", *map(str, FAMILY)]
    rows = [["degrees of freedom", *(str(2 * nodes) for nodes in FAMILY.values())]]
    for method in METHODS:
        ours = [timing_of_steps(RUNS[method.key, n])[0] for n in FAMILY]
        rows.append([f"{method.name}, ours (s)", *(f"{t:.3g}" for t in ours)])
        rows.append([f"{method.name}, paper (s)", *(f"{t:g}" for t in PAPER[method.key])])
    return Table(header, rows)


def checks():
    return cost_checks("A.table_2", METHODS, RUNS, FAMILY) + checks_of_runs(
        RUNS.values(), 1e-8, "< 1e-8: round-off of 15 m of flight, as large before the impact"
    )


FIGURE = Figure("A-T2", __doc__, list(RUNS.values()), None, checks, timed=True, table=table)
