# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: hard, two bounces.

Displacement and velocity of the lowest point, contact force, and the energy that a scheme should
keep, with Nitsche's method (left) and the augmented Lagrangian (right). 14112 unknowns. One
curve is on curved cells.
"""

from shared.figure import Figure

from .common import CURVED, HARD
from .series import draw_series
from .series_checks import checks_series

FIGURE = Figure(
    "C-17",
    __doc__,
    [*HARD.runs.values(), CURVED],
    lambda: draw_series(HARD),
    lambda: checks_series(HARD),
)
