# SPDX-License-Identifier: LGPL-2.1-or-later
"""Methods of papers A and B, and positions of the impact within a step.

A: Barboteu, Bonaldi, Danan and El-Hadri, improved normal compliance.
B: the hyper-viscoelastic model with persistent contact.

The position of the impact within a step changes the results of a method. A figure that
compares methods therefore shows a band over ten positions around the curve of the parameter
file, whose impact falls in the middle of a step.
"""

from dataclasses import dataclass

from .runs import Run

SPEED = 10.0  # m/s, of both bodies towards the foundation
# Ten positions of the impact, as parts of a step.
POSITIONS = tuple(round(0.05 + 0.1 * i, 2) for i in range(10))


@dataclass(frozen=True)
class Method:
    """A contact method: the end of its parameter file's name, label, name in tables."""

    key: str
    label: str
    colour: str
    name: str


SIGNORINI = Method("signorini", "Signorini, quasi-Lagrangian", "#000000", "Signorini")
SNC = Method("snc", "standard normal compliance", "#E69F00", "SNC")
EMM = Method("emm", "Signorini, equivalent mass matrix", "#CC79A7", "EMM")
TWO_STEP = Method("two_step", "two steps (Ayyad-Barboteu)", "#56B4E9", "two-step")
HAURET = Method("hauret", "Hauret-Le Tallec", "#009E73", "Hauret")
PERSISTENT = Method("persistent", "persistent contact, leapfrog", "#D55E00", "persistent")
INC = {
    2: Method("inc2", r"improved normal compliance, $\alpha = 2$", "#0072B2", "INC alpha = 2"),
    3: Method("inc3", r"improved normal compliance, $\alpha = 3$", "#009E73", "INC alpha = 3"),
    4: Method("inc4", r"improved normal compliance, $\alpha = 4$", "#CC79A7", "INC alpha = 4"),
    5: Method("inc5", r"improved normal compliance, $\alpha = 5$", "#D55E00", "INC alpha = 5"),
}
# Colours of a parameter, from small to large.
SCALE = ("#56B4E9", "#0072B2", "#009E73", "#E69F00", "#D55E00", "#882255")


def gap(steps, position, time_step):
    """The initial gap (m) for an impact `position` of a step after a number of steps."""
    return round((steps + position) * SPEED * time_step, 12)


def band(run, steps, time_step, cost):
    """The runs that differ from this one by the position of the impact."""
    return [
        Run(
            run.figure,
            f"{run.curve}_at_{position}",
            run.program,
            run.parameter_file,
            (*run.overrides, f"Start/Initial gap={gap(steps, position, time_step):g}"),
            cost=cost,
        )
        for position in POSITIONS
    ]


def touch(run, default):
    """The time (s) of the first touch of a run, were it to fly on."""
    for override in run.overrides:
        name, value = override.split("=")
        if name == "Start/Initial gap":
            return float(value) / SPEED
    return default / SPEED
