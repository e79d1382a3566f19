# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of the block, and its motion along the strip, by its momentum and by hand."""

import numpy as np

from shared.runs import QUIET, Run

G = 9.81  # m/s^2
BLOCK_MASS = 500.0  # kg
SPEED = 2.0  # m/s, at the start on the level
UNDAMPED = ("Material/Viscosity=none", "Material/Viscosity eta=0")
SLOPE = 0.5
COS, SIN = 1 / np.hypot(1, SLOPE), SLOPE / np.hypot(1, SLOPE)


def block(key, file, until, more=(), output=QUIET):
    overrides = (*output, f"Time/Final time={until}", *more)
    return Run("S-1", key, "sliding_block", f"sliding_block/{file}.prm", overrides, cost=3)


SMALL_MU = "Contact/Friction coefficient=0.1"
# key: friction coefficient, and whether there is viscosity
LEVEL = {
    ("0.1", True): block("level_0.1", "default", 2.4, (SMALL_MU,)),
    ("0.1", False): block("level_0.1_undamped", "default", 2.4, (SMALL_MU, *UNDAMPED)),
    ("0.3", True): block(
        "level_0.3", "default", 1.2, output=("Output/Fields every=50", "Output/Log every=0")
    ),
    ("0.3", False): block("level_0.3_undamped", "default", 1.2, UNDAMPED),
}
ON_SLOPE = {
    ("0.49", True): block("slope_0.49", "slope_slides", 1),
    ("0.51", True): block("slope_0.51", "slope_sticks", 1),
    ("0.51", False): block("slope_0.51_undamped", "slope_sticks", 1, UNDAMPED),
}


def motion(one):
    """Times (s) and the velocity of the block along the strip (m/s): means of steps."""
    table = one.read()
    values = table["momentum_x_block"] / BLOCK_MASS
    return (table["time"][1:] + table["time"][:-1]) / 2, (values[1:] + values[:-1]) / 2


def slope_of(one, first, last):
    time, values = motion(one)
    chosen = (time > first) & (time < last)
    return np.polyfit(time[chosen], values[chosen], 1)[0]


def stop(mu):
    """When a rigid block stops (s)."""
    return SPEED / (float(mu) * G)


def stopped(one):
    """From when on the block is slower than a hundredth of its first velocity (s)."""
    time, values = motion(one)
    return time[np.flatnonzero(np.abs(values) > SPEED / 100)[-1]]


def by_hand(mu):
    """The acceleration down the slope (m/s^2)."""
    return G * (SIN - float(mu) * COS)
