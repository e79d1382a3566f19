# SPDX-License-Identifier: LGPL-2.1-or-later
"""Energy of the methods during the impact: figures A-4 and B-4."""

import numpy as np

from shared.curves import panels_with_bands
from shared.figure import check, info
from shared.measures import dip, energy, lost, mean, percent
from shared.methods import HAURET, INC, SIGNORINI, SNC
from shared.paper_numbers import numbers
from shared.rows import (
    checks_of_runs,
    constant_row,
    loses_row,
    momentum_row,
    recovered_row,
    statement,
)

from .common import AGAINST, FINE, FINE_BAND, STEP, positions, run, with_bands

PAPER = numbers("A.figure_9")

# An experiment on EMM: the Crank-Nicolson scheme in place of the midpoint rule.
EMM_CN = positions(run("A-4", "emm_cn", "emm", ("Time/Scheme=Crank-Nicolson",)), "1ms")


def draw_energy(methods):
    curves = [(FINE[m.key], FINE_BAND[m.key], m.colour, m.label) for m in methods]
    return panels_with_bands(curves, energy, STEP["1ms"][1], AGAINST, (-2, 40))


def lost_on_landing(one):
    """Energy lost in the steps after which more nodes are in contact than before."""
    return -np.diff(energy(one))[np.diff(one.read()["active_points_foundation"]) > 0].sum()


def checks_energy(methods):
    rows = [constant_row("persistent", [FINE["persistent"], *FINE_BAND["persistent"]])]
    rows.append(constant_row("two-step", [FINE["two_step"], *FINE_BAND["two_step"]]))
    for method in methods:
        if method in (INC[2], HAURET):
            all_runs = [FINE[method.key], *FINE_BAND[method.key]]
            rows.append(constant_row(method.name, all_runs, "modified_energy", "-"))
            rows.append(recovered_row(method.name, all_runs))
            rows.append(
                info(f"{method.name}: largest dip", percent([dip(r) for r in all_runs]), "a dip")
            )
    # A's text names 1 % for SNC at this step (below figure 9).
    for method, paper in ((SIGNORINI, "loses"), (SNC, f"about {100 * PAPER['snc_lost']:g} %")):
        rows.append(
            loses_row(
                method.name,
                FINE_BAND[method.key],
                paper,
                (0.001, 0.02),
                "between 0.1 and 2 % at each position",
            )
        )
    losses = {key: [lost(r) for r in FINE_BAND[key]] for key in ("emm", "signorini")}
    ratio = mean(losses["emm"]) / mean(losses["signorini"])
    losing = [r for key in losses for r in FINE_BAND[key]]
    elsewhere = max(abs(lost(r) - lost_on_landing(r)) for r in losing)
    change = [-lost(r) for r in EMM_CN]
    rows += [
        check(
            "EMM: energy lost",
            percent(losses["emm"]),
            min(losses["emm"]) > 1e-9 and ratio < 1,
            "some at each position, on average less than Signorini",
            "some",
        ),
        check(
            "Signorini and EMM: energy lost in steps in which no node lands",
            f"{elsewhere:.1e}",
            elsewhere < 1e-9,
            "< 1e-9 of the initial energy",
        ),
        statement(
            "EMM loses much less than Signorini: ratio of the means",
            f"{ratio:.2f}",
            ratio < 0.5,
            "below 0.5",
            "strongly reduced",
            "each node that lands costs its pressure times the rest of its way in that step, "
            "whatever its inertia; with Crank-Nicolson in place of the midpoint rule the change "
            f"is {100 * min(change):+.2f} to {100 * max(change):+.2f} %",
        ),
    ]
    runs = with_bands(methods, FINE, FINE_BAND)
    return rows + [momentum_row(runs)] + checks_of_runs(runs)
