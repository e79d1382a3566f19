# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD and 1D-SS, convergence with h = dt.

Error in L2(0,T;H1) against h = dt, Nitsche's method with consistent mass. The paper shows 1D-SD.
The strain jumps, so that the orders are low: 1/3 where dispersion spreads the jump, 1/4 where the
first-order damping of alpha < 0 does.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.runs import Run

from .common import BLUE, ORANGE
from .exact import SD, SS

MESH_SIZES = [0.1 / 2**k for k in range(7)]
SCHEMES = {
    "crank_nicolson": ("Crank-Nicolson", "0.35", "o"),
    "alpha_0.05": (r"HHT, $\tilde\alpha = 0.05$", BLUE, "s"),
    "alpha_-0.02": (r"HHT, $\tilde\alpha = -0.02$", ORANGE, "^"),
    "tr_bdf2": ("TR-BDF2", "#CC79A7", "D"),
}
SCHEME_NAMES = {
    "crank_nicolson": "Crank-Nicolson",
    "alpha_0.05": "HHT 0.05",
    "alpha_-0.02": "HHT -0.02",
    "tr_bdf2": "TR-BDF2",
}


def convergence_run(bar, scheme, k):
    size = repr(MESH_SIZES[k])
    return Run(
        "C-10",
        f"{bar.program}_{scheme}_h{k}",
        bar.program,
        f"{bar.program}/figure_10_{scheme}.prm",
        overrides=(f"Mesh/Mesh size={size}", f"Time/Time step={size}"),
        # Steps times unknowns; TR-BDF2 has two stages.
        cost=0.3 + 8 * 4.0 ** (k - 6) * (2 if scheme == "tr_bdf2" else 1),
    )


RUNS = {
    (bar.name, scheme): [convergence_run(bar, scheme, k) for k in range(len(MESH_SIZES))]
    for bar in (SD, SS)
    for scheme in SCHEMES
}


def errors(bar, scheme):
    """L2(0,T; H1) errors on the family of meshes: sqrt(dt sum_(n>=1) |e_n|_1^2)."""
    return np.array(
        [
            np.sqrt(size * np.sum(run.read()["h1_error"][1:] ** 2))
            for size, run in zip(MESH_SIZES, RUNS[bar.name, scheme])
        ]
    )


def draw():
    figure, axes = plt.subplots(1, 2, figsize=(6.8, 4.0), sharey=True)
    sizes = np.array(MESH_SIZES)
    for panel, bar in zip(axes, (SD, SS)):
        for scheme, (label, colour, marker) in SCHEMES.items():
            panel.loglog(
                sizes,
                errors(bar, scheme),
                color=colour,
                marker=marker,
                markersize=5,
                linewidth=1.5,
                label=label,
            )
        for order, text, style in ((1 / 3, "1/3", ":"), (1 / 4, "1/4", "--")):
            guide = 0.045 * (sizes / sizes[-1]) ** order
            panel.loglog(sizes, guide, "k", linestyle=style, linewidth=1, label=f"order {text}")
        panel.set_xlabel(r"$h = \Delta t$ (m, s)")
        panel.set_title(bar.name)
        panel.grid(True, which="minor", color="0.95", linewidth=0.4)
        ticks = (0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125, 0.0015625)
        panel.set_xticks(ticks)
        panel.set_xticklabels([r"$\frac{1}{%d}$" % round(1 / t) for t in ticks], fontsize=11)
        panel.set_xticks([], minor=True)
    axes[0].set_ylabel(r"error in $L^2(0,T;H^1(\Omega))$")
    figure.tight_layout()
    figure.legend(
        *axes[0].get_legend_handles_labels(),
        loc="lower center",
        bbox_to_anchor=(0.5, 0.98),
        ncol=3,
    )
    return figure


def checks():
    """Orders of convergence.

    The exact strain is discontinuous, so that no scheme can do better than order
    1/2 on meshes like these. How much worse it is depends on the width over which
    a scheme spreads a jump: like h^(2/3) by dispersion of second order
    (Crank-Nicolson, HHT with alpha > 0, TR-BDF2), hence order 1/3, and like
    h^(1/2) by the damping of first order that alpha < 0 has, hence 1/4. Where
    both are at work the order drifts from the larger to the smaller one, so a
    fit over the three finest meshes is asked to lie between 1/4 and 1/2, with
    0.02 to spare for the fit, and the error to fall with every refinement.
    """
    low, high = 0.25 - 0.02, 0.5 + 0.02
    rows = []
    for bar in (SD, SS):
        last = {}
        for scheme, name in SCHEME_NAMES.items():
            error = errors(bar, scheme)
            orders = np.diff(np.log(error)) / np.diff(np.log(MESH_SIZES))
            fit = np.polyfit(np.log(MESH_SIZES), np.log(error), 1)[0]
            last[scheme] = np.polyfit(np.log(MESH_SIZES[-3:]), np.log(error[-3:]), 1)[0]
            theory = "1/4" if scheme == "alpha_-0.02" else "1/3"
            rows += [
                check(
                    f"{bar.name}, {name}: orders between meshes",
                    " ".join(f"{order:.2f}" for order in orders),
                    np.all(orders > 0),
                    "the error falls with every refinement",
                ),
                check(
                    f"{bar.name}, {name}: order overall, last three meshes",
                    f"{fit:.3f}, {last[scheme]:.3f}",
                    low <= last[scheme] <= high,
                    f"last three: {low:.2f} ... {high:.2f}, from 1/4 to 1/2",
                    exact=theory,
                ),
                compare(f"own.convergence.{bar.program}_{scheme}", error[-1]),
            ]
        if bar is SD:
            spread = abs(last["alpha_0.05"] - last["alpha_-0.02"])
            rows.append(compare("C.figure_10.similar", spread))
    tables = [run.read() for runs in RUNS.values() for run in runs]
    residual = max(np.abs(table["balance_residual"]).max() for table in tables)
    halvings = max(table["step_halvings"].max() for table in tables)
    return rows + [
        check(
            "max |balance residual|, all runs",
            f"{residual:.1e}",
            residual < 1e-11,
            "< 1e-11: Newton's tolerance; round-off grows as h^-2 (5.9e-13 seen)",
            exact="0",
        ),
        check("step halvings, all runs", f"{halvings:.0f}", halvings == 0, "none", exact="0"),
    ]


FIGURE = Figure("C-10", __doc__, [run for runs in RUNS.values() for run in runs], draw, checks)
