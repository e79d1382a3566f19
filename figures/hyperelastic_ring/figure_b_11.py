# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: persistent contact with friction and viscosity.

Energy relative to the start, steps of 1/300 s; the paper's eta of 0.0001 and 0.0004 is read as
MPa s.
"""

import numpy as np

from shared.figure import Figure
from shared.measures import change, energy
from shared.paper_numbers import compare
from shared.rows import checks_of_runs

from .common import share_row
from .dissipation import B11, draw_family


def draw():
    return draw_family(B11, lambda key: rf"$\mu$ = {key[0]}, $\eta$ = {key[1]} Pa s")


def viscous(eta):
    table = B11["0.1", eta].read()
    return table["viscous_dissipation"][-1]


def checks():
    (_, first), *rest = B11.items()
    rises = [np.diff(energy(one)).max() for _, one in rest]
    return [
        compare("B.figure_11.without", change([first])),
        compare("B.figure_11.acceptable", max(0.0, *rises)),
        compare("B.figure_11.proportional", viscous(400) / viscous(100)),
        *(
            share_row(f"mu = {mu}, eta = {eta}", one, "friction_work", "viscous_dissipation")
            for (mu, eta), one in rest
        ),
    ] + checks_of_runs(B11.values())


FIGURE = Figure("B-11", __doc__, list(B11.values()), draw, checks)
