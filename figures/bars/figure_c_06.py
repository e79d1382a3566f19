# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD, Crank-Nicolson.

Motion of the left end, contact pressure -sigma_n(u_h) and modified energy, against the exact
solution (black); consistent mass on the left, redistributed mass on the right. 1D-SD,
Crank-Nicolson. h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

from shared.figure import Figure

from .common import CN_SD, TREATMENTS
from .exact import SD
from .panels import draw_panels
from .rows import (
    checks_of_runs,
    checks_off_contact,
    energy_rows,
    first_step_rows,
    initial_energy_row,
    smoother_rows,
)

# "Gains up to about 1 %": the largest gain over the four periods.
GAIN = 0.015


def checks():
    return (
        energy_rows(TREATMENTS, CN_SD, bound=GAIN, paper="bounded")
        + [initial_energy_row(SD, CN_SD["nitsche", "consistent"])]
        + first_step_rows(
            # The elastic energy h (1/2)^2/2 of one element, of 1/8.
            TREATMENTS,
            CN_SD,
            "the first element holds 5 % of the energy, and relaxes",
        )
        + checks_off_contact(SD, TREATMENTS, CN_SD)
        + smoother_rows(SD, TREATMENTS, CN_SD)
        + checks_of_runs(SD, CN_SD.values())
    )


FIGURE = Figure(
    "C-6", __doc__, list(CN_SD.values()), lambda: draw_panels(SD, TREATMENTS, CN_SD), checks
)
