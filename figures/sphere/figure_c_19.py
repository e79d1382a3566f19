# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: Newton iterations in each step.

Hard sphere, whose number of steps is that of the totals of table 1; grey: it touches. In free
flight a stage takes one iteration, since the equations are linear and the predicted state is not
taken for the solution; TR-BDF2 has two stages.
"""

from shared.curves import name_panel, small_panels
from shared.figure import Figure
from shared.paper_numbers import compare

from .common import HARD, NITSCHE, stages


def draw():
    figure, axes = small_panels(len(NITSCHE), columns=1, height=1.4)
    for panel, scheme in zip(axes.flat, NITSCHE):
        table = HARD.runs[scheme.key].read()
        time, counts = table["time"], table["newton_iterations"]
        touching = table["contact_force_foundation"] > 0
        panel.fill_between(time, 0, 7, where=touching, step="pre", color="0.9", linewidth=0)
        panel.fill_between(time, 0, counts, step="pre", color=scheme.colour, linewidth=0)
        name_panel(panel, scheme.label)
    axes[0, 0].set(xlim=(0, 25), ylim=(0, 6.5), yticks=(0, 2, 4, 6))
    axes[-1, 0].set_xlabel("time (s)")
    figure.supylabel("Newton iterations in a step", fontsize=10)
    return figure


def checks():
    rows = []
    for scheme in NITSCHE:
        name = scheme.key.removeprefix("nitsche_")
        table = HARD.runs[scheme.key].read()
        touching = table["contact_force_foundation"] > 0
        # As the paper counts them: see C-T1.
        counts = table["newton_iterations"] + stages(scheme.key)
        rows.append(compare(f"C.section_4_3_1.contact_{name}", counts[touching].mean()))
        if name != "hybrid":
            rows.append(compare(f"C.section_4_3_1.most_{name}", counts.max()))
        if name in ("cn", "trbdf2"):
            flight = "flight" if name == "cn" else "flight_trbdf2"
            in_flight = counts[1:][~touching[1:] & ~touching[:-1]]
            rows.append(compare(f"C.section_4_3_1.{flight}", in_flight.mean()))
    return rows


FIGURE = Figure("C-19", __doc__, [HARD.runs[scheme.key] for scheme in NITSCHE], draw, checks)
