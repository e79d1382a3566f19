# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SS, displacement in each region of the x-t diagram.

One period of the exact solution. Characteristics x + t and x - t = const. leave the ends at whole
seconds; between them the displacement u (m) is linear, with the formula in the region. Colours are
the pressure in the bar, of which there is none, or tension, while it flies. The bars along the
ends say what an end does: it is free, touches its obstacle without pressure (grazing contact), or
presses on it.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch

from shared.figure import Figure, check
from shared.paper_numbers import compare

from . import characteristics
from .common import SS_FIELDS
from .exact import SS
from .several_times import checks_bar

PERIOD = 6
FONT = 13  # of fractions, whose letters are smaller
PRESSURE = {-0.5: "#F9DCC8", 0.0: "#F7F7F7", 0.5: "#BBD7E8", 1.0: "#79AECD"}  # Pa
END = {"free": "white", "touches": "#F0E442", "presses": "#D55E00"}


def regions():
    """The regions: corners (t, x), and u = a + b t + c x as (a, b, c)."""
    # Triangles between the lines x + t = m and t - x = n, joined where u is the same.
    triangles = []
    for k in range(PERIOD):
        middle = (k + 0.5, 0.5)
        corners = ((k, 0), (k + 1, 0), (k + 1, 1), (k, 1))
        triangles += [(*pair, middle) for pair in zip(corners, (*corners[1:], corners[0]))]
    found = {}
    for triangle in triangles:
        t, x = np.mean(triangle, axis=0)
        b, c = (float(f(SS, x, t)) for f in (characteristics.velocity, characteristics.strain))
        a = characteristics.displacement(SS, x, t) - b * t - c * x
        found.setdefault((round(a, 9), b, c), []).append(triangle)
    return found


def formula(a, b, c):
    """The text of a + b t + c x, as a fraction if it needs one."""
    below = 1 if all(float(value).is_integer() for value in (a, b, c)) else 2
    text = ""
    # Positive terms first: t - 4, not -4 + t.
    for value, name in sorted(((a, ""), (b, "t"), (c, "x")), key=lambda term: term[0] <= 0):
        size = round(abs(below * value))
        if size:
            sign = "-" if value < 0 else "+" if text else ""
            text += sign + (name if name and size == 1 else f"{size}{name}")
    text = text or "0"
    return f"${text}$" if below == 1 else rf"$\frac{{{text}}}{{{below}}}$"


def connected(triangles):
    """Groups of triangles that are connected by a side."""
    groups = []
    for triangle in triangles:
        near = [g for g in groups if any(len(set(triangle) & set(other)) == 2 for other in g)]
        groups = [g for g in groups if g not in near] + [[triangle, *(t for g in near for t in g)]]
    return groups


def end_state(end, k):
    """State of an end from t = k to k + 1."""
    if end.pressure[k] > 0:
        return "presses"
    lowest = min(end.displacement) if end.name == "left" else max(end.displacement)
    at_obstacle = end.displacement[k] == end.displacement[k + 1] == lowest
    return "touches" if at_obstacle else "free"


def draw():
    figure, axes = plt.subplots(figsize=(6.8, 4.2), layout="constrained")
    for (a, b, c), triangles in regions().items():
        axes.add_collection(
            PolyCollection(triangles, facecolor=PRESSURE[-c + 0.0], edgecolor="face")
        )
        for group in connected(triangles):
            t, x = np.mean([np.mean(triangle, axis=0) for triangle in group], axis=0)
            # The triangles at the start and the end of the period are narrow.
            text, narrow = formula(a, b, c), t < 0.2 or t > PERIOD - 0.2
            axes.text(
                t,
                x,
                text,
                ha="center",
                va="center",
                fontsize=FONT if r"\frac" in text else 10,
                rotation=90 if narrow else 0,
            )
    for k in range(-1, PERIOD):
        axes.plot([k, k + 1], [0, 1], color="0.3", linewidth=0.8)
        axes.plot([k, k + 1], [1, 0], color="0.3", linewidth=0.8)
    for end, bottom in zip(SS.ends, (-0.08, 1.0)):
        for k in range(PERIOD):
            colour = END[end_state(end, k)]
            axes.fill_between([k, k + 1], bottom, bottom + 0.08, color=colour, linewidth=0)
        axes.plot([0, PERIOD], [bottom + (end.name == "left") * 0.08] * 2, "k", linewidth=1)
    axes.set(xlim=(0, PERIOD), ylim=(-0.08, 1.08), yticks=(0, 0.5, 1), xlabel="time t (s)")
    axes.set_ylabel("place x at rest (m)")
    axes.grid(False)
    groups = (
        ({f"{p:g} Pa".replace("-", "\u2212"): c for p, c in PRESSURE.items()}, "pressure", 0.27),
        (END, "an end", 0.76),
    )
    for colours, title, place in groups:
        figure.legend(
            handles=[Patch(facecolor=c, edgecolor="0.6", label=l) for l, c in colours.items()],
            title=title,
            loc="lower center",
            bbox_to_anchor=(place, 1.0),
            ncol=len(colours),
            columnspacing=1.0,
            handlelength=1.2,
            handletextpad=0.4,
        )
    return figure


def checks():
    """Formulas meet on the lines between regions, and at both ends the written-down motion."""
    corners = {}
    for (a, b, c), triangles in regions().items():
        for triangle in triangles:
            for t, x in triangle:
                corners.setdefault((t, x), []).append(a + b * t + c * x)
    jumps = max(max(values) - min(values) for values in corners.values())
    ends = max(
        abs(np.mean(corners[k, x]) - end.displacement[k])
        for x, end in enumerate(SS.ends)
        for k in range(PERIOD + 1)
    )
    states = [end_state(SS.ends[0], k) for k in range(PERIOD)]
    grazing = states.index("touches")
    return [
        compare("C.section_4_2.grazing_from", grazing),
        compare("C.section_4_2.grazing_to", grazing + 1),
        compare("C.section_4_2.states", len(set(states))),
        check(
            "jump of u between regions (m)", f"{jumps:.1e}", jumps < 1e-12, "round-off", exact="0"
        ),
        check(
            "u at the ends against their motion (m)",
            f"{ends:.1e}",
            ends < 1e-12,
            "round-off",
            exact="0",
        ),
    ] + checks_bar(SS, SS_FIELDS, PERIOD)[:1]


FIGURE = Figure("C-12", __doc__, [SS_FIELDS], draw, checks)
