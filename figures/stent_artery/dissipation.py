# SPDX-License-Identifier: LGPL-2.1-or-later
"""Energy with viscosity and with friction: figures B-15 and B-16."""

import numpy as np

from shared.figure import check
from shared.methods import SCALE

from .common import STENTS, change, dissipation, largest_energy, ledger_rows


def draw_steps(left, right, runs, name):
    for (key, one), colour in zip(runs.items(), ("#000000", *SCALE[1:])):
        table = one.read()
        left.plot(table["time"][1:], 1e3 * change(one), color=colour, label=name(*key))
        right.plot(table["time"], dissipation(one), color=colour, label=name(*key))
    left.set_ylabel(r"$\Delta E - \Delta W$ in a step ($\mu$J)")
    right.set_ylabel("dissipated until then (mJ)")
    right.legend(fontsize=9, loc="upper left")
    for panel in (left, right):
        panel.set_xlim(0, 1)
        panel.set_xlabel("time (s)")


def stent_rows(runs):
    """Nothing is gained, and what is missing is what friction and viscosity took."""
    rise = max(change(one).max() / largest_energy(one) for one in runs.values())
    return [
        check(
            f"largest change of energy less work in a step, {len(runs)} runs",
            f"{rise:.1e}",
            rise <= 1e-12,
            "at most 1e-12 of the largest energy: round-off",
            "always negative",
            "<= 0",
        )
    ] + ledger_rows(runs.values())


def conserving_row():
    one = STENTS["0", "0"]
    worst = np.abs(change(one)).max() / largest_energy(one)
    return check(
        "mu = 0, eta = 0: max |change of energy less work| in a step",
        f"{worst:.1e}",
        worst <= 1e-9,
        "at most 1e-9 of the largest energy: Newton's tolerance",
        "practically zero",
        "0",
    )
