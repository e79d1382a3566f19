# SPDX-License-Identifier: LGPL-2.1-or-later
"""A disk in a bowl: runs, pictures."""

import numpy as np
from matplotlib.patches import Annulus

from shared.pictures import GROUND, bare

from .common import SMALL, draw_body, label, run

BOWL = 2.0  # m, its radius
START = np.array([-1.2, -0.9])


def bowl(key, treatment=None, fields=False):
    overrides = SMALL
    if treatment:
        overrides += (f"Contact/Treatment={treatment}",)
    if not fields:
        overrides += ("Output/Fields every=0",)
    return run("O-2", key, "bowl", overrides, 6)


# key: run, column of the energy that is kept, label, colour, line
BOWLS = {
    "persistent": (
        bowl("persistent", fields=True),
        "energy",
        "persistent contact",
        "#D55E00",
        "-",
    ),
    "inc": (
        bowl("inc", "improved normal compliance"),
        "modified_energy",
        "improved normal compliance",
        "#0072B2",
        (0, (5, 2)),
    ),
    "signorini": (
        bowl("signorini", "Signorini active set"),
        "energy",
        "Signorini active set",
        "#000000",
        (0, (1, 1.5)),
    ),
}
BOWL_STEPS = (0, 160, 300)


def draw_bowl(axes, thickness=0.12):
    """The wall of a bowl or of the drum."""
    axes.add_patch(Annulus((0, 0), BOWL + thickness, thickness, zorder=1, **GROUND))


def draw_in_bowl(axes, title):
    one = BOWLS["persistent"][0]
    table = one.read()
    draw_bowl(axes)
    for step in BOWL_STEPS:
        drawn, middle = draw_body(axes, one, step)
        label(axes, middle * (1 - 0.7 / np.hypot(*middle)), f"{table['time'][step]:.2f} s")
    bare(axes, title, (-2.2, 2.2), (-2.25, 0.44))
    return drawn
