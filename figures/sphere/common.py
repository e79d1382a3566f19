# SPDX-License-Identifier: LGPL-2.1-or-later
"""Schemes and spheres: the runs, and their colours."""

from dataclasses import dataclass

import numpy as np

from shared.runs import Run

RADIUS, SPEED = 20.0, np.sqrt(2 * 0.1 * 2)  # of the sphere, and at the impact


@dataclass(frozen=True)
class Scheme:
    """A row of table 1: the end of its parameter files' names, label, colour."""

    key: str
    label: str
    colour: str


NITSCHE = (
    Scheme("nitsche_cn", "Nitsche, Crank-Nicolson", "#000000"),
    Scheme("nitsche_hht", r"Nitsche, HHT $\alpha = 0.05$", "#0072B2"),
    Scheme("nitsche_trbdf2", "Nitsche, TR-BDF2", "#D55E00"),
    Scheme("hybrid", "Nitsche-hybrid", "#009E73"),
)
AUGMENTED = (
    Scheme("alm_cn", "ALM, Crank-Nicolson", "#000000"),
    Scheme("alm_hht", r"ALM, HHT $\alpha = 0.05$", "#0072B2"),
    Scheme("alm_trbdf2", "ALM, TR-BDF2", "#D55E00"),
)
SCHEMES = NITSCHE + AUGMENTED


def stages(key):
    """The stages of a step of a scheme, each of which is a nonlinear problem of its own."""
    return 2 if key.endswith("trbdf2") else 1


@dataclass(frozen=True)
class Sphere:
    """Soft or hard: figure, moment of the picture, what the reference shows."""

    name: str
    number: int  # of the figure
    time_step: float
    picture: float
    first_bounce: float  # s, when the first bounce is over for certain

    def run(self, scheme):
        step = round(self.picture / self.time_step)
        every = step if scheme.key == "nitsche_hht" else 0
        return Run(
            f"C-{self.number}",
            scheme.key,
            "sphere",
            f"sphere/figure_{self.number}_{scheme.key}.prm",
            (f"Output/Fields every={every}", "Output/Log every=0"),
            cost=7.0 if scheme.key.endswith("trbdf2") else 5.0,
        )

    @property
    def runs(self):
        return {scheme.key: self.run(scheme) for scheme in SCHEMES}


SOFT = Sphere("soft", 16, 0.25, 16.0, 33.0)
HARD = Sphere("hard", 17, 0.05, 6.8, 12.0)
SPHERES = (SOFT, HARD)
CURVED = Run(
    "C-17",
    "curved",
    "sphere",
    "sphere/figure_17_curved.prm",
    ("Output/Fields every=0", "Output/Log every=0"),
    cost=5.0,
)
