# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: energy of the methods.

Energy relative to the start, steps of 10 ms, no friction. Bands: ten positions of the impact
within a step. The two-step scheme and persistent contact conserve; improved normal compliance
recovers; Signorini and standard normal compliance lose.
"""

from shared.curves import panels_with_bands
from shared.figure import Figure
from shared.measures import change, energy, lost, missing_after
from shared.methods import PERSISTENT, SIGNORINI, SNC, TWO_STEP
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row, momentum_row

from .common import AGAINST, BANDS, FULL, GAP, METHODS

RUNS = [r for m in METHODS for r in (FULL[m.key], *BANDS[m.key])]


def draw():
    curves = [(FULL[m.key], BANDS[m.key], m.colour, m.label) for m in METHODS]
    return panels_with_bands(curves, energy, GAP, AGAINST, (-0.1, 5.95), 1.0, None)


def checks():
    def both(method):
        return [FULL[method], *BANDS[method]]

    return [
        *(
            compare(f"A.figure_11.{m.key}", change(both(m.key))) for m in (PERSISTENT, TWO_STEP)
        ),
        compare("A.figure_11.inc2", missing_after(both("inc2"))),
        constant_row("INC alpha = 2", both("inc2"), "modified_energy", "-"),
        *(
            compare(f"A.figure_11.{m.key}", [lost(r) for r in BANDS[m.key]])
            for m in (SIGNORINI, SNC)
        ),
        momentum_row(RUNS),
    ] + checks_of_runs(RUNS)


FIGURE = Figure("A-11", __doc__, RUNS, draw, checks)
