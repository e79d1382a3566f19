# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: persistent contact with viscosity.

Energy relative to the start for Curnier's viscosity, steps of 1/300 s. The paper prints no
viscosity.
"""

from shared.figure import Figure

from .dissipation import B9, checks_family, draw_family

FIGURE = Figure(
    "B-9",
    __doc__,
    list(B9.values()),
    lambda: draw_family(B9, lambda eta: rf"$\eta$ = {eta} Pa s"),
    lambda: checks_family("B.figure_9", B9, {eta: f"lost_{eta}" for eta in (100, 400, 1600)}),
)
