# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD, HHT with alpha = 0.05 and -0.02.

Motion of the left end, contact pressure -sigma_n(u_h) and modified energy, against the exact
solution (black); consistent mass on the left, redistributed mass on the right. 1D-SD, HHT with
alpha = 0.05 and -0.02. h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5.
"""

import numpy as np

from shared.figure import Figure
from shared.paper_numbers import compare

from .common import ALPHAS, CN_SD, HHT_SD, MASSES
from .dissipative import checks_hht
from .exact import SD
from .panels import draw_panels
from .rows import variation


def late_stress(key):
    """The largest |pressure| off contact (Pa) once that of the start has decayed."""
    table = HHT_SD[key, "redistributed"].read()
    free = table["active_points_left"] == 0
    free[:16] = False
    return np.abs(table["stress_pressure_left"][free]).max()


def checks():
    rows = [
        compare("C.figure_8.zero_positive", late_stress("alpha_0.05")),
        compare("C.figure_8.zero_negative", late_stress("alpha_-0.02")),
    ]
    for mass in MASSES:
        tables = (HHT_SD["alpha_0.05", mass].read(), CN_SD["nitsche", mass].read())
        swings = [variation(SD, table, "displacement") for table in tables]
        rows.append(compare(f"C.figure_8.regular_{mass}", swings[0] / swings[1]))
    return rows + checks_hht(SD, "C.figure_8", HHT_SD)


FIGURE = Figure(
    "C-8",
    __doc__,
    [*HHT_SD.values(), *CN_SD.values()],
    lambda: draw_panels(SD, ALPHAS, HHT_SD),
    checks,
)
