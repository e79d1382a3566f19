# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: persistent contact with friction.

Energy relative to the start for Coulomb's friction, steps of 1/300 s. The paper prints
no coefficient.
"""

from shared.figure import Figure
from shared.measures import change
from shared.paper_numbers import compare

from .common import rigid_row
from .dissipation import B10, checks_family, draw_family


def checks():
    return [
        compare("B.figure_10.without", change([B10["0"]])),
        *checks_family("B.figure_10", B10, {f"0.{k}": f"lost_0{k}" for k in (1, 2, 3)}),
        *(rigid_row(f"mu = {mu}", float(mu), one) for mu, one in B10.items() if mu != "0"),
    ]


FIGURE = Figure(
    "B-10",
    __doc__,
    list(B10.values()),
    lambda: draw_family(B10, lambda mu: rf"$\mu$ = {mu}"),
    checks,
)
