# SPDX-License-Identifier: LGPL-2.1-or-later
"""Energy of the methods during the impact: figures A-4 and B-4."""

import numpy as np

from shared.curves import panels_with_bands
from shared.figure import check
from shared.measures import change, dip, energy, lost, mean, missing_after
from shared.methods import HAURET, INC, SPEED
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row, momentum_row

from .common import AGAINST, FINE, FINE_BAND, STEP, with_bands


def draw_energy(methods):
    curves = [(FINE[m.key], FINE_BAND[m.key], m.colour, m.label) for m in methods]
    return panels_with_bands(curves, energy, STEP["1ms"][1], AGAINST, (-2, 40))


def lost_on_landing(one):
    """Energy lost in the steps after which more nodes are in contact than before."""
    return -np.diff(energy(one))[np.diff(one.read()["active_points_foundation"]) > 0].sum()


def impact_over(one):
    """The first step off the foundation (s), had the ball started 15 m above it.

    At that time the papers' impact is over; the gap that they print, 50 m, does not fit it.
    """
    table = one.read()
    touching = table["contact_force_foundation"] > 0
    first = touching.argmax()
    off = first + (~touching[first:]).argmax()
    return 15.0 / SPEED + table["time"][off] - STEP["1ms"][1] / SPEED


def checks_energy(methods, place):
    """Rows for the numbers of a place, "A.figure_4" or "B.figure_4"."""

    def both(key):
        return [FINE[key], *FINE_BAND[key]]

    losses = {key: [lost(r) for r in FINE_BAND[key]] for key in ("signorini", "snc", "emm")}
    ratio = mean(losses["emm"]) / mean(losses["signorini"])
    losing = [r for key in ("emm", "signorini") for r in FINE_BAND[key]]
    elsewhere = max(abs(lost(r) - lost_on_landing(r)) for r in losing)
    comes_back = next(m for m in methods if m in (INC[2], HAURET))
    key = comes_back.key
    rows = [
        compare(f"{place}.impact_over", impact_over(FINE["signorini"])),
        compare(f"{place}.persistent", change(both("persistent"))),
        compare(f"{place}.two_step", change(both("two_step"))),
        compare(f"{place}.{key}", missing_after(both(key))),
        compare(f"{place}.{key}_dip", [dip(r) for r in both(key)]),
        constant_row(comes_back.name, both(key), "modified_energy", "-"),
        *(compare(f"{place}.{name}", values) for name, values in losses.items()),
        compare(f"{place}.emm_over_signorini", ratio),
        check(
            "Signorini and EMM: energy lost in steps in which no node lands",
            f"{elsewhere:.1e}",
            elsewhere < 1e-9,
            "< 1e-9 of the initial energy",
        ),
    ]
    runs = with_bands(methods, FINE, FINE_BAND)
    return rows + [momentum_row(runs)] + checks_of_runs(runs)
