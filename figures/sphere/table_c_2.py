# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: seconds of the schemes (timed).

Seconds of the 500 steps of the hard sphere and their ratio to Crank-Nicolson with Nitsche's method,
beside the CPU times of the paper's table 1.
"""

import dataclasses

from shared.figure import Figure, Table
from shared.paper_numbers import compare, numbers
from shared.timing import timing_of_steps

from .common import HARD, NITSCHE, SCHEMES

PAPER = numbers("C.table_1_seconds")
RUNS = {
    scheme.key: dataclasses.replace(HARD.runs[scheme.key], figure="C-T2") for scheme in SCHEMES
}


def ratios():
    seconds = {key: timing_of_steps(run)[0] for key, run in RUNS.items()}
    return {key: value / seconds[NITSCHE[0].key] for key, value in seconds.items()}


def table():
    ours = ratios()
    rows = [
        [
            scheme.label.replace(r"$\alpha = 0.05$", "α = 0.05"),
            f"{timing_of_steps(RUNS[scheme.key])[0]:.3g}",
            f"{ours[scheme.key]:.2f}",
            f"{PAPER.get(scheme.key, 1.0):.2f}",
        ]
        for scheme in SCHEMES
    ]
    return Table(["", "seconds", "ratio", "paper"], rows)


def checks():
    ours = ratios()
    return [compare(f"C.table_1_seconds.{key}", ours[key]) for key in PAPER]


FIGURE = Figure("C-T2", __doc__, list(RUNS.values()), None, checks, timed=True, table=table)
