# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: Newton iterations in each step.

Soft sphere; grey: it touches. In free flight a stage takes one iteration, since the equations are
linear and the predicted state is not taken for the solution; TR-BDF2 has two stages.
"""

from shared.curves import name_panel, small_panels
from shared.figure import Figure, check
from shared.paper_numbers import numbers

from .common import NITSCHE, SOFT

PAPER = numbers("C.section_4_3_1")["said"]
MOST = numbers("C.section_4_3_1")["most"]


def draw():
    figure, axes = small_panels(len(NITSCHE), columns=1, height=1.4)
    for panel, scheme in zip(axes.flat, NITSCHE):
        table = SOFT.runs[scheme.key].read()
        time, counts = table["time"], table["newton_iterations"]
        touching = table["contact_force_foundation"] > 0
        panel.fill_between(time, 0, 7, where=touching, step="pre", color="0.9", linewidth=0)
        panel.fill_between(time, 0, counts, step="pre", color=scheme.colour, linewidth=0)
        name_panel(panel, scheme.label)
    axes[0, 0].set(xlim=(0, 60), ylim=(0, 6.5), yticks=(0, 2, 4, 6))
    axes[-1, 0].set_xlabel("time (s)")
    figure.supylabel("Newton iterations in a step", fontsize=10)
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
