# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: readings of Young's modulus and c_nu.

Steps of 1 ms, impact in the middle of a step. Left: how long the ball is on the foundation, by its
modulus (Signorini's condition); the text of papers A and B has the impact over 20 ms after a start
15 m above (dashed), and prints 100 GPa. Right: largest penetration against c_nu with the default
of 10 GPa; dashed: the numbers of paper A's table 1, which prints 1000 without a unit.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.curves import legend_above
from shared.figure import Figure
from shared.measures import penetration
from shared.methods import INC, SNC
from shared.paper_numbers import compare, numbers
from shared.rows import checks_of_runs
from shared.runs import QUIET, Run

PAPER = numbers("A.table_1")
MODULI = (1e9, 1e10, 1e11)
COEFFICIENTS = (1e11, 1e12, 1e13)
METHODS = (SNC, INC[2], INC[3])
FILES = {"snc": "A04_snc", "inc2": "A04_inc2", "inc3": "A09_inc3"}
COLOURS = {"snc": "#E69F00", "inc2": "#0072B2", "inc3": "#009E73"}



def reading(file, curve, *overrides):
    return Run(
        "R-5",
        curve,
        "elastic_ball",
        f"elastic_ball/figure_{file}.prm",
        (*QUIET, *overrides),
        cost=1.0,
    )


BY_MODULUS = {
    modulus: reading(
        "A04_signorini",
        f"modulus_{modulus:.0e}",
        f"Material/Young modulus={modulus:g}",
        "Time/Final time=0.12",
    )
    for modulus in MODULI
}
SCAN = {
    (m.key, c): reading(
        FILES[m.key], f"{m.key}_{c:.0e}", f"Contact/Compliance coefficient={c:g}"
    )
    for m in METHODS
    for c in COEFFICIENTS
}
RUNS = [*BY_MODULUS.values(), *SCAN.values()]


def duration(one):
    """Duration of the first contact (s)."""
    table = one.read()
    force = table["contact_force_foundation"]
    # Less is round-off of nodes that have left.
    touching = force > 1e-9 * force.max()
    first = touching.argmax()
    return table["time"][first + (~touching[first:]).argmax()] - table["time"][first]


def scanned(method):
    return [penetration(SCAN[method.key, c]) for c in COEFFICIENTS]


def coefficient(method):
    """The one that gives the paper's penetration, by the power law."""
    slope, at_one = np.polyfit(np.log(COEFFICIENTS), np.log(scanned(method)), 1)
    return np.exp((np.log(PAPER[method.key]) - at_one) / slope)


def draw():
    figure, (left, right) = plt.subplots(1, 2, figsize=(6.8, 3.8), layout="constrained")
    left.loglog(MODULI, [1e3 * duration(one) for one in BY_MODULUS.values()], "ko-")
    left.axhline(20, color="0.5", linestyle="--", linewidth=0.9)
    left.set_xlabel("Young's modulus (Pa)")
    left.set_ylabel("duration of the impact (ms)")
    for method in METHODS:
        colour = COLOURS[method.key]
        right.loglog(COEFFICIENTS, scanned(method), "o-", color=colour, label=method.name)
        right.axhline(PAPER[method.key], color=colour, linestyle="--", linewidth=0.9)
    right.axvline(2.6e12, color="black", linewidth=0.8)
    right.set_xlabel(r"$c_\nu$ (Pa/m$^{\alpha-1}$); black: default")
    right.set_ylabel("largest penetration (m)")
    legend_above(right, 3)
    return figure


def checks():
    rows = [
        compare(f"own.ball_readings.duration_{modulus:.0e}", duration(one))
        for modulus, one in BY_MODULUS.items()
    ]
    for method in METHODS:
        slope = np.polyfit(np.log(COEFFICIENTS), np.log(scanned(method)), 1)[0]
        rows += [
            compare(f"own.ball_readings.{method.key}_slope", slope),
            compare(f"own.ball_readings.{method.key}_reading", coefficient(method)),
        ]
    return rows + checks_of_runs(RUNS)


FIGURE = Figure("R-5", __doc__, RUNS, draw, checks)
