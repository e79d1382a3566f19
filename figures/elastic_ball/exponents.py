# SPDX-License-Identifier: LGPL-2.1-or-later
"""The exponent of improved normal compliance: figures A-8 and A-9."""

from shared.curves import panels_with_bands
from shared.measures import energy, lost, missing_after
from shared.methods import INC, SCALE, SNC
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, constant_row

from .common import AGAINST, STEP

BY_EXPONENT = (SNC, INC[2], INC[3], INC[4], INC[5])
EXPONENT_COLOURS = dict(zip((m.key for m in BY_EXPONENT), ("#000000", *SCALE)))


def draw_exponents(runs, bands, step, limits):
    curves = [(runs[m.key], bands[m.key], EXPONENT_COLOURS[m.key], m.label) for m in BY_EXPONENT]
    return panels_with_bands(curves, energy, STEP[step][1], AGAINST, limits)


def checks_exponents(runs, bands, place):
    """Common rows of figures A-8 and A-9."""
    inc = [r for m in BY_EXPONENT[1:] for r in (runs[m.key], *bands[m.key])]
    return [
        compare(f"{place}.snc", [lost(r) for r in bands["snc"]]),
        compare(f"{place}.inc", missing_after(inc)),
        constant_row("INC", inc, "modified_energy", "-"),
    ] + checks_of_runs(runs_and_bands(runs, bands))


def runs_and_bands(runs, bands):
    """The runs of a figure."""
    return [r for m in BY_EXPONENT for r in (runs[m.key], *bands[m.key])]
