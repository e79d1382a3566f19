# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: deformed body and contact forces.

The ball before, during and after the impact, with improved normal compliance (alpha = 2) and
steps of 1 ms. The displacement is not magnified; arrows are nodal contact forces.
"""

from shared.figure import Figure

from .pictures import PICTURE, checks_picture, draw_picture

FIGURE = Figure("A-3", __doc__, [PICTURE], lambda: draw_picture(stress=False), checks_picture)
