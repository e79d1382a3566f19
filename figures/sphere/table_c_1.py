# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: Newton iterations of the schemes.

Totals of a run, with one iteration more for each stage of a step, and their ratio to Crank-
Nicolson with Nitsche's method. The paper counts the iteration in which the residual is zero: it has
two of them in a step in flight, whose equations are linear, where ours end with the first. It does
not say which sphere its table is for; its totals need some 475 steps, 90 of them in contact, which
are nearer to the hard one (500 and 48) than to the soft one (240 and 165). Seconds: C-T2.
"""

from shared.figure import Figure, Table
from shared.paper_numbers import compare, numbers

from .common import HARD, NITSCHE, SCHEMES, SPHERES, stages

PAPER = numbers("C.table_1")


def paper_ratio(scheme):
    return PAPER[scheme.key] / PAPER[NITSCHE[0].key]


def ours(run):
    """The Newton iterations of a run, as they are counted here."""
    return run.read()["newton_iterations"].sum()


def totals(sphere):
    """Iterations of each run as the paper counts them, and their ratio to Crank-Nicolson's."""
    counts = {
        key: ours(run) + stages(key) * (len(run.read()["time"]) - 1)
        for key, run in sphere.runs.items()
    }
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
    counts, ratios = totals(HARD)
    return [
        *(
            compare(f"own.sphere_iterations.{sphere.name}_{key}", ours(run))
            for sphere in SPHERES
            for key, run in sphere.runs.items()
        ),
        *(compare(f"C.table_1.{scheme.key}", counts[scheme.key]) for scheme in SCHEMES),
        *(
            compare(f"C.table_1_ratios.{scheme.key}", ratios[scheme.key])
            for scheme in SCHEMES
            if scheme is not NITSCHE[0]
        ),
    ]


FIGURE = Figure(
    "C-T1",
    __doc__,
    [run for sphere in SPHERES for run in sphere.runs.values()],
    None,
    checks,
    table=table,
)
