# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: deformed body, stress and contact forces.

The run of figure A-3, with von Mises stress: waves still run through the ball after the impact.
"""

from shared.figure import Figure

from .pictures import PICTURE, checks_picture, draw_picture

FIGURE = Figure("B-3", __doc__, [PICTURE], lambda: draw_picture(stress=True), checks_picture)
