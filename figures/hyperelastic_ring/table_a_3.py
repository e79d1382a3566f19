# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: largest penetration, and readings of c_nu.

Largest penetration against c_nu, a scan on 64 x 5 nodes; the paper's numbers as dashed lines. INC
with alpha = 2 and with alpha = 3 meet them at the same c_nu, which is the default; SNC does
elsewhere. The table is table 3 of the paper beside ours on its mesh with the default c_nu, for ten
positions of the impact within a step.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.curves import FULL_WIDTH, legend_above
from shared.figure import Figure, Table
from shared.measures import lost, penetration, scientific, scientific_span
from shared.methods import INC, PERSISTENT, SIGNORINI, SNC, TWO_STEP
from shared.paper_numbers import compare, numbers
from shared.rows import checks_of_runs

from .common import BANDS, COARSE, FULL, GAP, run

PAPER = numbers("A.table_3")
METHODS = (SIGNORINI, TWO_STEP, PERSISTENT, SNC, INC[2], INC[3])
COEFFICIENTS = (1e9, 1e10, 1e11, 1e12, 1e13)
SCAN_METHODS = (SNC, INC[2], INC[3])
SCAN = {
    (m.key, c): run(
        "A-T3",
        f"{m.key}_{c:.0e}",
        "figure_A11_snc.prm" if m is SNC else f"figure_A13_{m.key}.prm",
        (*COARSE, f"Contact/Compliance coefficient={c:g}"),
        cost=2,
    )
    for m in SCAN_METHODS
    for c in COEFFICIENTS
}
PLANE = {
    (m.key, state): run(
        "A-T3",
        f"{m.key}_plane_{state}",
        f"figure_A11_{m.key}.prm",
        (*COARSE, f"Material/Plane state=plane {state}"),
        cost=2,
    )
    for m in (SIGNORINI, SNC)
    for state in ("stress", "strain")
}
RUNS = [
    *(r for m in METHODS for r in BANDS[m.key]),
    *(FULL[m.key] for m in METHODS),
    *SCAN.values(),
    *PLANE.values(),
]
def scanned(method):
    return [penetration(SCAN[method.key, c]) for c in COEFFICIENTS]


def reading(method, paper):
    """The coefficient that gives the paper's penetration."""
    values = np.log(scanned(method))
    return np.exp(np.interp(-np.log(paper), -values, np.log(COEFFICIENTS)))


def first_second(one):
    table = one.read()
    return table["penetration_foundation"][table["time"] <= 1.0 + GAP / 10].max()


def draw():
    figure, axes = plt.subplots(figsize=FULL_WIDTH)
    for method, colour in zip(SCAN_METHODS, ("#E69F00", "#0072B2", "#009E73")):
        axes.loglog(COEFFICIENTS, scanned(method), "o-", color=colour, label=method.name)
        axes.axhline(PAPER[method.key], color=colour, linestyle="--", linewidth=0.9)
    axes.axvline(8e11, color="black", linewidth=0.8)
    axes.annotate(
        "default",
        (8e11, 0.02),
        xycoords=("data", "axes fraction"),
        xytext=(-4, 0),
        textcoords="offset points",
        ha="right",
    )
    axes.annotate(
        "paper", (1.1e9, PAPER["snc"]), xytext=(0, 3), textcoords="offset points", color="#A87400"
    )
    axes.set_xlabel(r"$c_\nu$ (Pa/m$^{\alpha-1}$)")
    axes.set_ylabel("largest penetration (m)")
    legend_above(axes, 3)
    return figure


def table():
    rows = []
    for method in METHODS:
        values = [penetration(r) for r in BANDS[method.key]]
        early = [first_second(r) for r in BANDS[method.key]]
        rows.append(
            [
                method.name,
                scientific(PAPER[method.key], 2),
                scientific_span(values, 2),
                scientific_span(early, 2),
            ]
        )
    return Table(["method", "paper (m)", "ours, 6 s (m)", "ours, first second (m)"], rows)


def checks():
    slopes = {
        m.key: np.polyfit(np.log(COEFFICIENTS), np.log(scanned(m)), 1)[0] for m in SCAN_METHODS
    }
    return [
        *(compare(f"A.table_3.{m.key}", [penetration(r) for r in BANDS[m.key]]) for m in METHODS),
        # The contact potential c/2 delta^alpha holds the energy of a node that lands, and the
        # pressure c delta of SNC is that of Signorini's condition.
        *(compare(f"own.ring_penetration.{key}_slope", slope) for key, slope in slopes.items()),
        *(
            compare(f"own.ring_penetration.{m.key}_reading", reading(m, PAPER[m.key]))
            for m in SCAN_METHODS
        ),
        *(
            compare(f"own.ring_penetration.{key}_{state}", lost(one))
            for (key, state), one in PLANE.items()
        ),
    ] + checks_of_runs(
        RUNS,
        1e-8,
        "< 1e-8: 1e-7 m, SNC's penetration at the largest c_nu, has eight digits beside 10 m",
    )


FIGURE = Figure("A-T3", __doc__, RUNS, draw, checks, table=table)
