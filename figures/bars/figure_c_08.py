# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD, HHT with alpha = 0.05 and -0.02.

Motion of the left end, contact pressure -sigma_n(u_h) and modified energy, against the exact
solution (black); consistent mass on the left, redistributed mass on the right. 1D-SD, HHT with
alpha = 0.05 and -0.02. h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

from shared.figure import Figure

from .common import ALPHAS, CN_SD, HHT_SD
from .dissipative import checks_hht
from .exact import SD
from .panels import draw_panels

FIGURE = Figure(
    "C-8",
    __doc__,
    [*HHT_SD.values(), *CN_SD.values()],
    lambda: draw_panels(SD, ALPHAS, HHT_SD),
    lambda: checks_hht(SD, HHT_SD, CN_SD),
)
