# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD and hard sphere: the variants of Nitsche's method.

Crank-Nicolson with the consistent mass; theta = 1 is the symmetric variant, 0 the non-symmetric
and -1 the skew-symmetric one. Left: 1D-SD, largest gain of energy in twelve seconds against
gamma_0. Right: hard sphere of paper C until t = 8 s, its deepest penetration. Symmetric variants
are not stable below a gamma_0, where the program refuses them; the skew-symmetric one is stable
with any. In this sense it is more robust, as the end of paper C has it: the energy is no better
with it.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.curves import legend_above
from shared.figure import Figure
from shared.paper_numbers import compare
from shared.rows import checks_of_runs
from shared.runs import QUIET, Run

THETAS = {1: "#000000", 0: "#0072B2", -1: "#D55E00"}
NAME = {1: "symmetric", 0: "non_symmetric", -1: "skew_symmetric"}
# Stable values; a tenth of the least one is refused. The figures of paper C have 5, and
# 100 mu = 3e6 Pa.
BAR_GAMMAS = {1: (5.0, 50.0), 0: (0.5, 5.0, 50.0), -1: (0.05, 0.5, 5.0, 50.0)}
SPHERE_GAMMAS = {1: (3e6, 3e7), 0: (3e5, 3e6, 3e7), -1: (3e4, 3e5, 3e6, 3e7)}


def bar(theta, gamma):
    return Run(
        "R-3",
        f"bar_{NAME[theta]}_{gamma:g}",
        "bar_sd",
        "bar_sd/figure_06_nitsche_consistent.prm",
        (*QUIET, f"Contact/Nitsche theta={theta}", f"Contact/Nitsche gamma0={gamma:g}"),
    )


def sphere(theta, gamma):
    return Run(
        "R-3",
        f"sphere_{NAME[theta]}_{gamma:g}",
        "sphere",
        "sphere/figure_17_nitsche_cn.prm",
        (
            *QUIET,
            "Time/Final time=8",
            f"Contact/Nitsche theta={theta}",
            f"Contact/Nitsche gamma0={gamma:g}",
        ),
        cost=3,
    )


BARS = {(theta, g): bar(theta, g) for theta in THETAS for g in BAR_GAMMAS[theta]}
SPHERES = {(theta, g): sphere(theta, g) for theta in THETAS for g in SPHERE_GAMMAS[theta]}


def gain(run):
    """The largest gain of energy less the work of loads, of the largest energy."""
    table = run.read()
    kept = table["energy"] - table["external_work"]
    return (kept - kept[0]).max() / np.abs(table["energy"]).max()


def deepest(run):
    return run.read()["penetration_foundation"].max()


def draw():
    figure, panels = plt.subplots(1, 2, figsize=(6.8, 3.8), layout="constrained")
    for panel, runs, gammas, value, label in (
        (panels[0], BARS, BAR_GAMMAS, gain, "gain / energy"),
        (panels[1], SPHERES, SPHERE_GAMMAS, deepest, "deepest penetration (m)"),
    ):
        for theta, colour in THETAS.items():
            values = [value(runs[theta, gamma]) for gamma in gammas[theta]]
            label_of = rf"$\theta$ = {theta}"
            panel.loglog(gammas[theta], values, "o-", color=colour, label=label_of)
        panel.set_xlabel(r"$\gamma_0$ (Pa)")
        panel.set_ylabel(label)
        legend_above(panel, 3)
    return figure


def checks():
    rows = []
    for (theta, gamma), run in BARS.items():
        rows.append(compare(f"own.variants.bar_{NAME[theta]}_{gamma:g}", gain(run)))
    for (theta, gamma), run in SPHERES.items():
        name = f"own.variants.sphere_{NAME[theta]}_{gamma:.0e}".replace("+0", "")
        rows.append(compare(name, deepest(run)))
    return rows + checks_of_runs([*BARS.values(), *SPHERES.values()])


FIGURE = Figure("R-3", __doc__, [*BARS.values(), *SPHERES.values()], draw, checks)
