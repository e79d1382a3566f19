# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD, Crank-Nicolson.

Motion of the left end, contact pressure -sigma_n(u_h) and modified energy, against the exact
solution (black); consistent mass on the left, redistributed mass on the right. 1D-SD,
Crank-Nicolson. h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

import numpy as np

from shared.figure import Figure
from shared.paper_numbers import compare

from .common import CN_SD, MASSES, TREATMENTS
from .exact import SD
from .panels import draw_panels
from .rows import (
    checks_of_runs,
    checks_off_contact,
    error_rows,
    gain,
    initial_energy_row,
    loss_rows,
    smoother_rows,
)


def stress_off_contact(table):
    free = table["active_points_left"] == 0
    return np.abs(table["stress_pressure_left"][free][1:]).max()


def checks():
    place = "C.figure_6"
    return [
        *(
            compare(f"{place}.gain_{curve.key}_{mass}", gain(CN_SD[curve.key, mass].read()))
            for curve in TREATMENTS
            for mass in MASSES
        ),
        compare(
            f"{place}.around_zero", stress_off_contact(CN_SD["nitsche", "consistent"].read())
        ),
        *smoother_rows(SD, place, TREATMENTS, CN_SD, ("pressure", "velocity")),
        *loss_rows("own.bar_sd_cn", TREATMENTS, CN_SD),
        *error_rows(SD, "own.bar_sd_cn", TREATMENTS, CN_SD),
        initial_energy_row(SD, CN_SD["nitsche", "consistent"]),
        *checks_off_contact(SD, TREATMENTS, CN_SD),
        *checks_of_runs(SD, CN_SD.values()),
    ]


FIGURE = Figure(
    "C-6", __doc__, list(CN_SD.values()), lambda: draw_panels(SD, TREATMENTS, CN_SD), checks
)
