# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SS, TR-BDF2.

Motion of the ends, contact pressure -sigma_n(u_h) and modified energy, against the exact solution
(black); consistent mass on the left, redistributed mass on the right. 1D-SS, TR-BDF2.
h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

from shared.figure import Figure

from .common import HHT_SS, TREATMENTS, TR_SS
from .dissipative import checks_tr_bdf2
from .exact import SS
from .panels import draw_panels
from .rows import smoother_rows

def checks():
    quantities = ("pressure", "velocity")
    return [
        *smoother_rows(SS, "C.figure_15", TREATMENTS[:1], TR_SS, quantities),
        *checks_tr_bdf2(SS, "C.figure_15", TR_SS, HHT_SS),
    ]


FIGURE = Figure(
    "C-15",
    __doc__,
    [*TR_SS.values(), *HHT_SS.values()],
    lambda: draw_panels(SS, TREATMENTS, TR_SS),
    checks,
)
