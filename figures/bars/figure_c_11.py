# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SS, the bar between two obstacles.

One period: the bar wriggles between two rigid obstacles. At each time the upper strip is the exact
solution and the lower one a run (Nitsche, TR-BDF2, redistributed mass, h = dt = 0.05); colours are
the pressure in the bar, white lines the ends of its elements, grey lines the paths of six points.
From t = 1 to 2 and from 3 to 4 the left end stays at the obstacle without pressing on it (grazing
contact), from 2 to 3 it presses. Under a pressure of 1 Pa this linear bar has no length: at t = 2.5
its left half is a point.
"""

from shared.figure import Figure

from .common import SS_FIELDS
from .exact import SS
from .several_times import checks_bar, draw_bar

FIGURE = Figure(
    "C-11",
    __doc__,
    [SS_FIELDS],
    lambda: draw_bar(SS, SS_FIELDS, 6, (0, 1.5), (-0.5, 1)),
    lambda: checks_bar(SS, SS_FIELDS, 6),
)
