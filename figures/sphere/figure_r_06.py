# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: thrown at an angle, with friction.

The soft sphere of C with the horizontal velocity 1 m/s, mu = 0.3 and elements of degree 1. Left: the
energy that friction takes. Right: the modified energy with what friction and gravity took and gave,
which no scheme should let grow. Nitsche-hybrid does not, in any step; Crank-Nicolson, HHT and TR-BDF2,
which take contact and friction at instants, gain where points touch and leave, in this order. Friction
takes the same within 5 %.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.rows import checks_of_runs
from shared.runs import QUIET, Run

from .measures import conserved

SCHEMES = {
    "Crank-Nicolson": ("Nitsche", "#000000"),
    "HHT": ("Nitsche", "#0072B2"),
    "TR-BDF2": ("Nitsche", "#D55E00"),
    "midpoint": ("Nitsche-hybrid", "#009E73"),
}
RUNS = {
    scheme: Run(
        "R-6",
        scheme,
        "sphere",
        "sphere/default.prm",
        (
            *QUIET,
            f"Contact/Treatment={treatment}",
            f"Time/Scheme={scheme}",
            "Time/Final time=40",
            "Start/Initial velocity=1, 0, 0",
            "Mesh/Degree=1",
            "Contact/Friction coefficient=0.3",
        ),
        cost=20.0,
    )
    for scheme, (treatment, _) in SCHEMES.items()
}


def kept(table):
    """The modified energy, without the work of gravity, and with what friction took."""
    return conserved(table) + table["friction_work"]


def draw():
    figure, axes = plt.subplots(1, 2, figsize=(6.8, 3), sharex=True, layout="constrained")
    for scheme, run in RUNS.items():
        table = run.read()
        first = table["modified_energy"][0]
        name = f"{SCHEMES[scheme][0]}, {scheme}"
        for panel, values in zip(axes, (table["friction_work"], kept(table) - first)):
            panel.plot(table["time"], values / first, color=SCHEMES[scheme][1], label=name)
    axes[0].set_ylabel("friction / energy at the start")
    axes[1].set_ylabel("change of what is kept / the same")
    for panel in axes:
        panel.set_xlabel("time (s)")
    axes[0].legend(fontsize=7)
    return figure


def checks():
    tables = {scheme: run.read() for scheme, run in RUNS.items()}
    largest = {
        scheme: np.diff(kept(table)).max() / table["energy"].max()
        for scheme, table in tables.items()
    }
    rows = [
        check(
            "Nitsche-hybrid with friction: largest gain in a step",
            f"{largest['midpoint']:.1e}",
            largest["midpoint"] < 1e-11,
            "never grows: < 1e-11 of the energy",
            exact="0",
        ),
        check(
            "largest gain in a step: Crank-Nicolson, HHT, TR-BDF2",
            ", ".join(f"{largest[scheme]:.1e}" for scheme in list(SCHEMES)[:3]),
            largest["Crank-Nicolson"] > largest["HHT"] > largest["TR-BDF2"] > 0.0,
            "more than 0, in this order",
        ),
    ]
    takes = {scheme: table["friction_work"][-1] for scheme, table in tables.items()}
    spread = max(takes.values()) / min(takes.values()) - 1
    rows.append(
        check(
            "work of friction, largest over smallest of the schemes",
            f"{1 + spread:.3f}",
            spread < 0.05,
            "within 5 %",
        )
    )
    return rows + checks_of_runs(RUNS.values())


FIGURE = Figure("R-6", __doc__, list(RUNS.values()), draw, checks)
