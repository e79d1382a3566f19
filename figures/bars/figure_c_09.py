# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD, TR-BDF2.

Motion of the left end, contact pressure -sigma_n(u_h) and modified energy, against the exact
solution (black); consistent mass on the left, redistributed mass on the right. 1D-SD, TR-BDF2.
h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

from shared.figure import Figure

from .common import HHT_SD, TREATMENTS, TR_SD
from .dissipative import checks_tr_bdf2
from .exact import SD
from .panels import draw_panels

FIGURE = Figure(
    "C-9",
    __doc__,
    [*TR_SD.values(), *HHT_SD.values()],
    lambda: draw_panels(SD, TREATMENTS, TR_SD),
    lambda: checks_tr_bdf2(SD, "C.figure_9", TR_SD, HHT_SD),
)
