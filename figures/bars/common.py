# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the figures of the bars: curves, names, runs."""

from dataclasses import dataclass

from shared.runs import QUIET, Run

from .exact import SD, SS

MASSES = ("consistent", "redistributed")
BLUE, ORANGE = "#0072B2", "#D55E00"


@dataclass(frozen=True)
class Curve:
    """A method in a figure: the name in its parameter files, label, colour."""

    key: str
    label: str
    colour: str


TREATMENTS = (Curve("nitsche", "Nitsche", BLUE), Curve("penalty", "penalty", ORANGE))
ALPHAS = (
    Curve("alpha_0.05", r"Nitsche, $\tilde\alpha = 0.05$", BLUE),
    Curve("alpha_-0.02", r"Nitsche, $\tilde\alpha = -0.02$", ORANGE),
)
ALPHA = {"alpha_0.05": 0.05, "alpha_-0.02": -0.02}

# Names of the curves in the tables.
PLAIN = {
    "nitsche": "Nitsche",
    "penalty": "penalty",
    "alpha_0.05": "alpha = 0.05",
    "alpha_-0.02": "alpha = -0.02",
}


def bar_run(bar, number, curve, mass=None):
    key = curve.key + (f"_{mass}" if mass else "")
    return Run(
        f"C-{number}",
        key,
        bar.program,
        f"{bar.program}/figure_{number:02}_{key}.prm",
        overrides=QUIET,
    )


def bar_runs(bar, number, curves):
    """The runs of a figure by curve and mass."""
    return {
        (curve.key, mass): bar_run(bar, number, curve, mass) for curve in curves for mass in MASSES
    }


# Crank-Nicolson, HHT and TR-BDF2.
CN_SD = bar_runs(SD, 6, TREATMENTS)
CN_SS = bar_runs(SS, 13, TREATMENTS)
HHT_SD = bar_runs(SD, 8, ALPHAS)
HHT_SS = bar_runs(SS, 14, ALPHAS)
TR_SD = bar_runs(SD, 9, TREATMENTS)
TR_SS = bar_runs(SS, 15, TREATMENTS)


def _fields(bar, figure, number):
    """A calm run whose fields are written every half second."""
    return Run(
        figure,
        "fields",
        bar.program,
        f"{bar.program}/figure_{number:02}_nitsche_redistributed.prm",
        ("Output/Fields every=10", "Output/Log every=0"),
    )


SD_FIELDS, SS_FIELDS = _fields(SD, "C-5", 9), _fields(SS, "C-11", 15)
