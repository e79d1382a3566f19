# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stent and artery: set-up and meshes at the start.

A longitudinal section in plane stress. The paper gives no drawing to scale. The outer side and
the ends of the artery are clamped; all nodes of the lower side of the stent move towards the wall
and along it, beginning and ending at rest. Contact is between the nodes of the inner wall and the
facets of the upper side of the stent.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Rectangle

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.pictures import bare, scale_bar, snapshot

from .common import DEPLOYMENT
from .drawing import LENGTH, THICKNESS, WHOLE, draw_mesh



def held(axes):
    """Hatches where the wall is clamped."""
    for corner, width, height in (
        ((-0.3, THICKNESS), LENGTH + 0.6, 0.12),
        ((-0.3, 0), 0.3, THICKNESS),
        ((LENGTH, 0), 0.3, THICKNESS),
    ):
        axes.add_patch(
            Rectangle(corner, width, height, facecolor="none", edgecolor="0.4", hatch="/////", lw=0)
        )


def draw_setup(axes):
    """The sketch: held, moved and contact boundaries."""
    rest, place, cells, fields = snapshot(DEPLOYMENT, 0)
    draw_mesh(axes, 0, coloured=False, lines=False)
    held(axes)
    lower = {"color": "#D55E00", "arrowstyle": "-|>", "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0}
    points = rest[fields["part"] == 1]
    for x in np.linspace(4, 15, 8):
        near = points[np.abs(points[:, 0] - x) < 0.1]
        foot = near[near[:, 1].argmin()]
        axes.annotate("", xy=foot + (1.0, 0.4), xytext=foot, arrowprops=lower, zorder=5)
    words = {"ha": "center", "va": "center", "fontsize": 9}
    axes.text(10, 1.28, "clamped: outer side and ends", **words)
    axes.text(10, 0.55, "artery 20 mm x 1 mm, 81 x 9 nodes; inner side: slave nodes", **words)
    axes.text(
        10,
        -0.86,
        "stent, 400 times stiffer, 102 x 4 nodes; upper side: master facets.  "
        "All nodes of its lower side move by (1.0, 0.4) mm in 1 s (arrows)",
        **words,
    )
    axes.set_xlim(*WHOLE[0])
    axes.set_ylim(-1.0, 1.42)
    axes.set_aspect(2)
    axes.axis("off")


def draw():
    figure, axes = plt.subplots(
        3, 1, figsize=(12, 8.2), height_ratios=(2.3, 1, 4.2), layout="constrained"
    )
    draw_setup(axes[0])
    axes[0].set_title("set-up (heights are doubled)")
    for panel, x, y, title in (
        (axes[1], *WHOLE, "meshes at the start"),
        (axes[2], (3.6, 8.0), (-0.62, 1.03), "the same, a part of it"),
    ):
        draw_mesh(panel, 0, coloured=False)
        bare(panel, title, x, y)
    scale_bar(axes[2], 7.35, -0.55, 0.5, "mm")
    return figure


def checks():
    rest, _, cells, fields = snapshot(DEPLOYMENT, 0)
    ends = [rest[fields["part"] == number] for number in (0, 1)]
    gap = ends[0][:, 1].min() - ends[1][:, 1].max()
    return [
        compare("B.section_7.nodes", len(rest)),
        check(
            "distance of the crests of the stent from the wall (mm)",
            f"{gap:.4f}",
            0.05 - 1e-6 < gap < 0.053,
            "nodes next to the crests, up to 0.003 more",
            exact="0.05",
        ),
    ]


FIGURE = Figure("B-13", __doc__, [DEPLOYMENT], draw, checks)
