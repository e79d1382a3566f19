# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: persistent contact with friction.

Energy relative to the start for Coulomb's friction, steps of 1/300 s. The mesh has 64 x 5 nodes.
"""

from shared.figure import Figure

from .common import rigid_row
from .dissipation import B10, checks_family, draw_family


def checks():
    rows = checks_family(B10, "mu = 0, 0.1, 0.2, 0.3", "grows with mu")
    return rows + [rigid_row(f"mu = {mu}", float(mu), one) for mu, one in B10.items() if mu != "0"]


FIGURE = Figure(
    "B-10",
    __doc__,
    list(B10.values()),
    lambda: draw_family(B10, lambda mu: rf"$\mu$ = {mu}"),
    checks,
)
