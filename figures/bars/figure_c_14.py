# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SS, HHT with alpha = 0.05 and -0.02.

Motion of the ends, contact pressure -sigma_n(u_h) and modified energy, against the exact solution
(black); consistent mass on the left, redistributed mass on the right. 1D-SS, HHT with
alpha = 0.05 and -0.02. h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

from shared.figure import Figure

from .common import ALPHAS, HHT_SS
from .dissipative import checks_hht
from .exact import SS
from .panels import draw_panels

FIGURE = Figure(
    "C-14",
    __doc__,
    list(HHT_SS.values()),
    lambda: draw_panels(SS, ALPHAS, HHT_SS),
    lambda: checks_hht(SS, "C.figure_14", HHT_SS),
)
