# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing of bodies in 2D, from the fields of a run."""

import matplotlib.animation as animation
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Rectangle

from . import meshes
from .figure import check

GROUND = {"facecolor": "0.86", "edgecolor": "0.25", "linewidth": 1.2}


FLESH = "#dbe7f3"


def body(axes, path, arrow=1.0, limit=None, offset=(0.0, 0.0), lines=True):
    """A deformed body with its contact forces, from a VTU file.

    `arrow` is the length of an arrow in m per N, `limit` the largest stress (Pa) if that is
    shown, `offset` where to move the picture, `lines` whether to draw the cells. Returns the total
    force, the colour map, if any, and the positions of the nodes.
    """
    points, cells, fields = meshes.read(path)
    place = points + fields["displacement"][:, :2] + offset
    edges = {"linewidth": 0.15, "edgecolor": "0.45"} if lines else {"edgecolor": "face"}
    drawn = PolyCollection(place[cells], facecolor=FLESH, **edges)
    if limit:
        drawn.set_array(fields["von_mises of cells"])
        drawn.set_cmap("viridis")
        drawn.set_clim(0, limit)
    axes.add_collection(drawn)
    axes.add_collection(LineCollection(place[outline(cells)], colors="0.2", linewidths=0.6))
    force = fields["contact_force"][:, :2].astype(float)
    pushed = np.abs(force).sum(axis=1) > 0
    for foot, tip in zip(place[pushed], place[pushed] + arrow * force[pushed]):
        draw_arrow(axes, foot, tip)
    axes.set_aspect("equal")
    return force.sum(axis=0), drawn, place


def draw_mesh(whole, part, path, width):
    """A mesh at rest above the foundation, and its lowest part, `width` m wide, enlarged.

    Dots are the nodes that can touch. The body is set down on the foundation. Returns the
    points at rest about the middle of the body, and the cells.
    """
    points, cells, _ = meshes.read(path)
    points = points - 0.5 * (points.max(axis=0) + points.min(axis=0))
    lowest = points[:, 1].min()
    place = points - (0, lowest)
    outer = np.hypot(*points.T) > -lowest * (1 - 1e-6)
    for panel, line in ((whole, 0.2), (part, 0.6)):
        panel.add_collection(
            PolyCollection(place[cells], facecolor=FLESH, edgecolor="0.35", linewidth=line)
        )
        draw_ground(panel, -20, 20, depth=0.04 * width if panel is part else 0.6)
        panel.set_aspect("equal")
        panel.axis("off")
    part.plot(*place[outer].T, ".", color="#D55E00", markersize=7)
    radius = -lowest
    whole.set(xlim=(-1.05 * radius, 1.05 * radius), ylim=(-2.5, 2.05 * radius))
    part.set(xlim=(-width / 2, width / 2), ylim=(-0.14 * width, 0.75 * width))
    scale_bar(whole, -radius, -2.3, 2)
    scale_bar(part, -0.48 * width, -0.13 * width, 0.5)
    whole.add_patch(
        Rectangle((-width / 2, 0), width, 0.75 * width, fill=False, edgecolor="#D55E00", zorder=5)
    )
    return points, cells


def mesh_checks(name, points, nodes, on_circle):
    """The numbers of nodes."""
    radius = np.hypot(*points.T)
    ours = len(points), int((radius > radius.max() * (1 - 1e-6)).sum())
    return [
        check(
            f"{name}: nodes, and nodes on the circle that can touch",
            f"{ours[0]}, {ours[1]}",
            ours == (nodes, on_circle),
            "equal",
        )
    ]


def draw_arrow(axes, foot, tip):
    axes.annotate(
        "",
        xy=tip,
        xytext=foot,
        arrowprops={
            "arrowstyle": "-|>",
            "color": "#D55E00",
            "linewidth": 1.3,
            "shrinkA": 0,
            "shrinkB": 0,
        },
        zorder=4,
    )


def draw_ground(axes, left, right, height=0.0, depth=0.6):
    """A piece of the foundation below its surface."""
    axes.fill_between([left, right], height - depth, height, color="0.85", linewidth=0, zorder=0)
    axes.plot([left, right], [height, height], color="black", linewidth=1.2, zorder=2)


def snapshot(one, step):
    """Points at rest and now (m), triangles and fields at a step."""
    points, cells, fields = meshes.read(one.field_file(step))
    return points, points + fields["displacement"][:, :2], cells, fields


def outline(cells):
    """The sides of triangles that have no neighbour: pairs of points."""
    sides = np.sort(np.concatenate((cells[:, :2], cells[:, 1:], cells[:, ::2])), axis=1)
    sides, count = np.unique(sides, axis=0, return_counts=True)
    return sides[count == 1]


def zero_line(place, cells, values):
    """Zero line of a linear function on triangles: a piece in each.

    (tricontour never comes back from values that are zero in a vertex.)
    """
    positive = values[cells] >= 0
    # The vertex that stands alone on its side, and the two others.
    alone = positive != np.roll(positive, 1, axis=1)
    alone &= positive != np.roll(positive, -1, axis=1)
    crossed = np.flatnonzero(alone.any(axis=1))
    first = alone[crossed].argmax(axis=1)
    ends = []
    for k in (1, 2):
        a, b = cells[crossed, first], cells[crossed, (first + k) % 3]
        part = (values[a] / (values[a] - values[b]))[:, None]
        ends.append((1 - part) * place[a] + part * place[b])
    return np.stack(ends, axis=1)


def sides_of(cells):
    """All sides of triangles, each once: pairs of points."""
    sides = np.concatenate((cells[:, :2], cells[:, 1:], cells[:, ::2]))
    return np.unique(np.sort(sides, axis=1), axis=0)


def draw_cells(axes, place, cells, values, limit, lines=True):
    """Deformed bodies with a colour for each triangle; the colour map."""
    # Few colours keep an animation small.
    drawn = PolyCollection(
        place[cells], cmap=plt.get_cmap("YlOrRd", 15), edgecolor="face", linewidth=0.3
    )
    drawn.set_array(values)
    drawn.set_clim(0, limit)
    axes.add_collection(drawn)
    draw_mesh_lines(axes, place, cells, lines)
    return drawn


def draw_mesh_lines(axes, place, cells, inner=True):
    """The outlines of bodies, and the sides of their triangles."""
    if inner:
        axes.add_collection(
            LineCollection(place[sides_of(cells)], colors="0.45", linewidths=0.3, snap=False)
        )
    axes.add_collection(
        LineCollection(place[outline(cells)], colors="black", linewidths=0.8, zorder=3)
    )


def bare(axes, title, x, y):
    """A panel for a picture: a scale of lengths is in it, not around it."""
    axes.set_aspect("equal")
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)
    axes.set_title(title)


def scale_bar(axes, x, y, length, unit="m"):
    """A line of some length that says how long it is."""
    axes.plot([x, x + length], [y, y], color="black", linewidth=2, solid_capstyle="butt", zorder=6)
    axes.annotate(
        f"{length:g} {unit}",
        (x + length / 2, y),
        xytext=(0, 3),
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize=8,
        zorder=6,
    )


def colour_bar(drawn, axes, orientation="horizontal", unit="kPa"):
    """The scale of the stress, in axes of its own."""
    limit = drawn.get_clim()[1]
    bar = axes.figure.colorbar(
        drawn,
        cax=axes,
        extend="max",
        orientation=orientation,
        ticks=np.linspace(0, limit, 5),
        format="%g",
    )
    bar.set_label(f"von Mises stress ({unit})", fontsize=9)
    bar.ax.tick_params(labelsize=8)


def save_frames(path, figure, draw, frames, speed=12):
    """Write an animation: `draw(frame)` draws one of the frames into the figure."""
    # The last frame stays for a second.
    writer = animation.PillowWriter(fps=speed)
    with writer.saving(figure, path, dpi=80):
        for frame in [*frames, *[frames[-1]] * speed]:
            draw(frame)
            writer.grab_frame()
    plt.close(figure)
