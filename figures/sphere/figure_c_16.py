# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: soft, two bounces.

Displacement and velocity of the lowest point, contact force, and the energy that a scheme should
keep, with Nitsche's method (left) and the augmented Lagrangian (right). 14112 unknowns.
"""

from shared.figure import Figure

from .common import SOFT
from .series import draw_series
from .series_checks import checks_series

FIGURE = Figure(
    "C-16",
    __doc__,
    list(SOFT.runs.values()),
    lambda: draw_series(SOFT),
    lambda: checks_series(SOFT),
)
