# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: largest penetration.

Largest penetration with steps of 1 ms, for ten positions of the impact within a step, beside
table 1 of the paper.
"""

from shared.figure import Figure, Table
from shared.measures import penetration, scientific, scientific_span
from shared.methods import INC, PERSISTENT, SIGNORINI, SNC, TWO_STEP
from shared.paper_numbers import compare, numbers
from shared.rows import checks_of_runs

from .common import FINE, FINE_BAND, with_bands

PAPER = numbers("A.table_1")
METHODS = (SIGNORINI, TWO_STEP, PERSISTENT, SNC, INC[2], INC[3])
RUNS = with_bands(METHODS, FINE, FINE_BAND)


def table():
    rows = []
    for method in METHODS:
        paper = PAPER[method.key]
        values = [penetration(r) for r in FINE_BAND[method.key]]
        middle = penetration(FINE[method.key])
        rows.append([method.name, scientific(paper), scientific_span(values), scientific(middle)])
    header = ["method", "paper (m)", "ours, ten positions (m)", "ours, middle of a step (m)"]
    return Table(header, rows)


def checks():
    return [
        compare(f"A.table_1.{m.key}", [penetration(r) for r in FINE_BAND[m.key]]) for m in METHODS
    ] + checks_of_runs(RUNS)


FIGURE = Figure("A-T1", __doc__, RUNS, None, checks, table=table)
