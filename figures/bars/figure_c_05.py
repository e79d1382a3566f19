# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD, the bar at several times.

The compressed bar is released at t = 0, held on the right. At each time the upper strip is the
exact solution and the lower one a run (Nitsche, TR-BDF2, redistributed mass, h = dt = 0.05);
colours are the pressure in the bar, white lines the ends of its elements, grey lines the paths of
six points. A wave of release runs through the bar, which touches the obstacle at t = 1, is
compressed by it while a wave goes to the held end and back, and leaves it at t = 2. The run has
smeared the fronts of the waves over a few elements.
"""

from shared.figure import Figure

from .common import SD_FIELDS
from .exact import SD
from .several_times import checks_bar, draw_bar

FIGURE = Figure(
    "C-5",
    __doc__,
    [SD_FIELDS],
    lambda: draw_bar(SD, SD_FIELDS, 3, (0, 1), (0, 0.5)),
    lambda: checks_bar(SD, SD_FIELDS, 3),
)
