# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: deformed body and contact forces.

The ring before, during and after the impact, with improved normal compliance (alpha = 2); all
pictures have the same scale. Arrows are nodal contact forces. The sides of the ring pass through
each other between 1.5 and 2.5 s, since there is no contact between them.
"""

from shared.figure import Figure
from shared.runs import Run

from .pictures import checks_picture, draw_picture

RUN = Run(
    "A-10",
    "fields",
    "hyperelastic_ring",
    "hyperelastic_ring/figure_A10.prm",
    ("Output/Log every=0",),
    cost=20,
)
STEPS = (0, 50, 100, 150, 250, 600)

FIGURE = Figure(
    "A-10",
    __doc__,
    [RUN],
    lambda: draw_picture(RUN, STEPS),
    lambda: checks_picture(RUN, STEPS),
)
