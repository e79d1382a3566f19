# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: energy of the methods, steps of 1 ms.

Energy relative to the start during the impact, steps of 1 ms. Bands: ten positions of the impact
within a step. Signorini's condition and standard normal compliance lose energy as nodes land, and
so does the equivalent mass matrix; improved normal compliance stores energy in its potential and
returns all of it; the two-step scheme and persistent contact change nothing.
"""

from shared.figure import Figure

from .common import FINE, FINE_BAND, METHODS_A, with_bands
from .energies import checks_energy, draw_energy

FIGURE = Figure(
    "A-4",
    __doc__,
    with_bands(METHODS_A, FINE, FINE_BAND),
    lambda: draw_energy(METHODS_A),
    lambda: checks_energy(METHODS_A, "A.figure_4"),
)
