# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: energy of the methods of paper B, steps of 1 ms.

Energy relative to the start during the impact, steps of 1 ms. Bands: ten positions of the impact
within a step. Signorini's condition and standard normal compliance lose energy as nodes land, and
so does the equivalent mass matrix; Hauret and Le Tallec's penalisation dips and recovers; the
two-step scheme and persistent contact change nothing.
"""

from shared.figure import Figure

from .common import FINE, FINE_BAND, METHODS_B, with_bands
from .energies import checks_energy, draw_energy

FIGURE = Figure(
    "B-4",
    __doc__,
    with_bands(METHODS_B, FINE, FINE_BAND),
    lambda: draw_energy(METHODS_B),
    lambda: checks_energy(METHODS_B, "B.figure_4"),
)
