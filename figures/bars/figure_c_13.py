# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SS, Crank-Nicolson.

Motion of the ends, contact pressure -sigma_n(u_h) and modified energy, against the exact solution
(black); consistent mass on the left, redistributed mass on the right. 1D-SS, Crank-Nicolson.
h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

from shared.figure import Figure

from .common import CN_SS, TREATMENTS
from .exact import SS
from .panels import draw_panels
from .rows import (
    checks_of_runs,
    checks_off_contact,
    error_rows,
    initial_energy_row,
    loss_rows,
    smoother_rows,
)


def checks():
    return [
        *smoother_rows(SS, "C.figure_13", TREATMENTS, CN_SS, ("pressure", "displacement")),
        *loss_rows("own.bar_ss_cn", TREATMENTS, CN_SS),
        *error_rows(SS, "own.bar_ss_cn", TREATMENTS, CN_SS),
        initial_energy_row(SS, CN_SS["nitsche", "consistent"]),
        *checks_off_contact(SS, TREATMENTS, CN_SS),
        *checks_of_runs(SS, CN_SS.values()),
    ]


FIGURE = Figure(
    "C-13", __doc__, list(CN_SS.values()), lambda: draw_panels(SS, TREATMENTS, CN_SS), checks
)
