# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: deformed body, stress and contact forces.

Persistent contact with friction (mu = 0.1) and Curnier's viscosity (100 Pa s), steps of 1/300 s;
von Mises stress. The sides of the ring pass through each other for a
while, as in figure A-10.
"""

from shared.figure import Figure
from shared.runs import Run

from .pictures import checks_picture, draw_picture

RUN = Run(
    "B-7",
    "fields",
    "hyperelastic_ring",
    "hyperelastic_ring/figure_B07.prm",
    ("Output/Log every=0",),
    cost=35,
)
STEPS = (0, 150, 300, 450, 750, 1800)

FIGURE = Figure(
    "B-7",
    __doc__,
    [RUN],
    lambda: draw_picture(RUN, STEPS, 3e5),
    lambda: checks_picture(RUN, STEPS),
)
