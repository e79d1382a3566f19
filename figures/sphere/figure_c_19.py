# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: Newton iterations in each step.

Soft sphere; on the right the first contact. In free flight a stage takes one iteration, since the
equations are linear and the predicted state is not taken for the solution.
"""

import matplotlib.pyplot as plt

from shared.figure import Figure, check
from shared.paper_numbers import numbers

from .common import NITSCHE, SOFT

PAPER = numbers("C.section_4_3_1")["said"]
MOST = numbers("C.section_4_3_1")["most"]


def draw():
    figure, axes = plt.subplots(1, 2, figsize=(13, 4.6), sharey=True)
    for panel, (first, last) in zip(axes, ((0, 60), (6, 29))):
        for scheme in NITSCHE:
            table = SOFT.runs[scheme.key].read()
            panel.step(
                table["time"],
                table["newton_iterations"],
                where="pre",
                color=scheme.colour,
                label=scheme.label,
                linewidth=0.9,
            )
        panel.set_xlim(first, last)
        panel.set_xlabel("time (s)")
    axes[0].set_ylabel("Newton iterations in a step")
    axes[0].legend(fontsize=9)
    figure.tight_layout()
    return figure


def checks():
    rows = []
    for scheme in NITSCHE:
        # Ours of the hybrid scheme, of which the paper has more, stay below those of TR-BDF2.
        most = MOST.get(scheme.key, MOST["nitsche_trbdf2"])
        table = SOFT.runs[scheme.key].read()
        touching = table["contact_force_foundation"] > 0
        counts = table["newton_iterations"][touching]
        rows.append(
            check(
                f"{scheme.label}: iterations in contact, mean and most",
                f"{counts.mean():.2f}, {counts.max():.0f}",
                counts.max() <= most,
                f"at most {most}",
                paper=PAPER[scheme.key],
            )
        )
    return rows


FIGURE = Figure("C-19", __doc__, [SOFT.runs[scheme.key] for scheme in NITSCHE], draw, checks)
