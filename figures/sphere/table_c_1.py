# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: Newton iterations of the schemes.

Totals of a run and their ratio to Crank-Nicolson with Nitsche's method. Seconds:
benchmarks/README.md.
"""

from shared.figure import Figure, Table, check
from shared.paper_numbers import numbers

from .common import NITSCHE, SCHEMES, SPHERES

PAPER = numbers("C.table_1")


def paper_ratio(scheme):
    return PAPER[scheme.key] / PAPER[NITSCHE[0].key]


def totals(sphere):
    """Iterations of each run, and their ratio to those of Nitsche, Crank-Nicolson."""
    counts = {key: run.read()["newton_iterations"].sum() for key, run in sphere.runs.items()}
    return counts, {key: count / counts["nitsche_cn"] for key, count in counts.items()}


def table():
    rows = []
    of_spheres = [totals(sphere) for sphere in SPHERES]
    for scheme in SCHEMES:
        row = [
            scheme.label.replace(r"$\alpha = 0.05$", "α = 0.05"),
            f"{PAPER[scheme.key]}",
            f"{paper_ratio(scheme):.2f}",
        ]
        for counts, ratios in of_spheres:
            row += [f"{counts[scheme.key]:.0f}", f"{ratios[scheme.key]:.2f}"]
        rows.append(row)
    header = ["iterations", "paper", "ratio", "soft", "ratio", "hard", "ratio"]
    return Table(header, rows)


def checks():
    rows = []
    ratios_of_spheres = [totals(sphere)[1] for sphere in SPHERES]
    for scheme in SCHEMES:
        ours = [ratios[scheme.key] for ratios in ratios_of_spheres]
        paper = paper_ratio(scheme)
        rows.append(
            check(
                f"{scheme.label}: iterations over those of Nitsche, Crank-Nicolson, soft and hard",
                f"{ours[0]:.2f}, {ours[1]:.2f}",
                max(ours) < 1.2 * paper,
                "at most 1.2 times the paper's ratio",
                paper=f"{paper:.2f}",
            )
        )
    return rows


FIGURE = Figure(
    "C-T1",
    __doc__,
    [run for sphere in SPHERES for run in sphere.runs.values()],
    None,
    checks,
    table=table,
)
