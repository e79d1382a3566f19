# SPDX-License-Identifier: LGPL-2.1-or-later
"""The exact motion inside the bars, by characteristics from what their ends do.

u_t + u_x is constant along lines x + t = const., u_t - u_x along x - t = const. Both are known at
an end, where `exact.py` has velocity and pressure -u_x, and constant there between integer times.
"""

import numpy as np

from shared.meshes import read_bar

from .exact import SD, SS

# Strain and velocity (m/s) at the start.
START = {SD.name: (-0.5, 0.0), SS.name: (-0.5, -0.5)}


def _end_values(end, time, sign):
    """u_t + sign u_x at an end."""
    return end.piecewise(end.velocity, time) - sign * end.piecewise(end.pressure, time)


def invariants(bar, x, time):
    """u_t + u_x and u_t - u_x at points and times; at a jump, the values after it."""
    x, time = np.broadcast_arrays(np.asarray(x, float), np.asarray(time, float))
    strain, velocity = START[bar.name]
    # When the characteristics left the ends; before time 0 they came from the start.
    from_right, from_left = time - (1 - x) + 1e-9, time - x + 1e-9
    going_right = np.where(
        from_left >= 0, _end_values(bar.ends[0], np.maximum(from_left, 0), -1), velocity - strain
    )
    if len(bar.ends) == 2:
        left_at_end = _end_values(bar.ends[1], np.maximum(from_right, 0), 1)
    else:
        # The right end is held: it reflects the incoming invariant with the opposite sign.
        came = from_right - 1
        left_at_end = -np.where(
            came >= 0, _end_values(bar.ends[0], np.maximum(came, 0), -1), velocity - strain
        )
    return np.where(from_right >= 0, left_at_end, velocity + strain), going_right


def strain(bar, x, time):
    going_left, going_right = invariants(bar, x, time)
    return 0.5 * (going_left - going_right)


def velocity(bar, x, time):
    going_left, going_right = invariants(bar, x, time)
    return 0.5 * (going_left + going_right)


def displacement(bar, x, time):
    """u at one point and time: that of the left end, and the strain from there on."""
    part = time - np.floor(time + 1e-9)
    breaks = np.array([0, *sorted(b for b in (part, 1 - part) if 0 < b < x), x])
    middles = 0.5 * (breaks[1:] + breaks[:-1])
    along = strain(bar, middles, time) @ np.diff(breaks)
    return bar.ends[0].displacement_at(time) + along


def h1_error(bar, file, time):
    """The H1 norm of the error of a field of a run."""
    nodes, values, _, _ = read_bar(file)
    error = 0.0
    for a, b, u_a, u_b in zip(nodes, nodes[1:], values, values[1:]):
        # Kinks are on nodes: the error is linear between them.
        slope = (u_b - u_a) / (b - a) - strain(bar, 0.5 * (a + b), time)
        e_a, e_b = u_a - displacement(bar, a, time), u_b - displacement(bar, b, time)
        error += (b - a) * (slope**2 + (e_a**2 + e_a * e_b + e_b**2) / 3)
    return np.sqrt(error)
