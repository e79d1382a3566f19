# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a run of a sphere."""

import numpy as np

from .common import RADIUS, SPEED


def conserved(table):
    """The quantity that a scheme should keep: modified energy without the work of gravity."""
    return table["modified_energy"] - table["external_work"]


def change_of_energy(table):
    """Change of it at the end, over the largest energy."""
    kept = conserved(table)
    return (kept[-1] - kept[0]) / np.abs(table["energy"]).max()


def largest_gain(table):
    """Largest gain of it in a step, over the largest energy."""
    return np.diff(conserved(table)).max() / np.abs(table["energy"]).max()


def change_before_contact(table):
    """Largest change of it before the first touch, over the largest energy."""
    first = (table["contact_force_foundation"] > 0).argmax()
    kept = conserved(table)[:first]
    return np.abs(kept - kept[0]).max() / np.abs(table["energy"]).max()


def touches(table):
    """First touch, lift-off (after the whole first bounce), next touch (s)."""
    time, touching = table["time"], table["contact_force_foundation"] > 0
    starts = time[1:][touching[1:] & ~touching[:-1]]
    ends = time[1:][~touching[1:] & touching[:-1]]
    # In the bounce of a hard body points may open for a step.
    gap = np.diff(starts).argmax()
    return starts[0], ends[ends < starts[gap + 1]][-1], starts[gap + 1]


def peak(table, until):
    """The largest force of the first bounce, and when."""
    first = table["time"] < until
    k = table["contact_force_foundation"][first].argmax()
    return table["contact_force_foundation"][k], table["time"][k]


def variation(table):
    """How much the velocity of the lowest point goes up and down."""
    return np.abs(np.diff(table["lowest_velocity"])).sum()


def hertz_force(lame, density=1.0):
    """The largest force when an elastic sphere falls, by Hertz's quasi-static theory."""
    modulus = 4 * lame * (2 * lame) / (3 * lame)  # E / (1 - nu^2), lambda = mu
    stiffness = 4 / 3 * modulus * np.sqrt(RADIUS)
    mass = density * 4 / 3 * np.pi * RADIUS**3
    approach = (1.25 * mass * SPEED**2 / stiffness) ** 0.4
    return stiffness * approach**1.5
