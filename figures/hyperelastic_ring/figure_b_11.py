# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: persistent contact with friction and viscosity.

Energy relative to the start, steps of 1/300 s; the paper's eta of 0.0001 and 0.0004 is read as
MPa s. The mesh has 64 x 5 nodes.
"""

from shared.figure import Figure

from .dissipation import B11, checks_family, draw_family


def draw():
    return draw_family(B11, lambda key: rf"$\mu$ = {key[0]}, $\eta$ = {key[1]} Pa s")


def checks():
    what = "(mu, eta) = (0, 0), (0.1, 0), (0.1, 100), (0.1, 400)"
    return checks_family(B11, what, "grows with eta")


FIGURE = Figure("B-11", __doc__, list(B11.values()), draw, checks)
