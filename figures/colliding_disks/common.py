# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the figures of the disks: runs, output of the program, momenta."""

import re

import numpy as np

from shared.figure import check
from shared.runs import QUIET, Run

TREATMENTS = {
    "persistent": ("persistent contact", "persistent contact", "#D55E00"),
    "inc": ("improved normal compliance", r"INC, $\alpha = 2$", "#0072B2"),
    "signorini": ("Signorini active set", "Signorini, active set", "#000000"),
}
# Offset (m) and friction coefficient.
CASES = (("0", "0"), ("1", "0"), ("1", "0.2"))


def disks(figure, key, treatment="persistent", case=CASES[0], more=(), output=QUIET, cost=2.0):
    file = dict(zip(CASES, ("default", "oblique", "oblique_friction")))[case]
    overrides = list(output)
    if treatment != "persistent":
        overrides.append(f"Contact/Treatment={TREATMENTS[treatment][0]}")
    return Run(
        figure,
        key,
        "colliding_disks",
        f"colliding_disks/{file}.prm",
        (*overrides, *more),
        cost=cost,
    )


def printed(one):
    """The numbers that the program prints at the end."""
    return {
        name: float(value)
        for name, value in re.findall(r"^(\w+) +(-?\d\.\d+e[+-]\d+)$", one.results.log, re.M)
    }


MOMENTA = ("momentum_x", "momentum_y", "angular_momentum")


def momenta_row(runs, mass):
    """Nothing comes from outside: momenta are those of the start in all steps."""
    worst = 0.0
    for one in runs:
        table = one.read()
        for name in MOMENTA:
            worst = max(worst, np.abs(table[name] - table[name][0]).max())
    return check(
        "max change of linear and angular momentum",
        f"{worst / mass:.1e}",
        worst < 1e-9 * mass,
        "< 1e-9 of a disk's momentum (times 1 m)",
        exact="0",
    )
