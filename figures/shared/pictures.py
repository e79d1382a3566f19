# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing of bodies in the plane, from the fields of a run."""

import matplotlib.animation as animation
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from . import meshes

GROUND = {"facecolor": "0.86", "edgecolor": "0.25", "linewidth": 1.2}


def body(axes, path, stretch=1.0, arrow=1.0, stress=False, limit=None):
    """A deformed body with its contact forces, from a VTU file.

    `stretch` multiplies the displacement apart from its mean, `arrow` is the length of
    an arrow in m per N. Returns the total force and what maps colours, if any.
    """
    points, cells, fields = meshes.read(path)
    displacement = fields["displacement"][:, :2]
    mean = displacement.mean(axis=0)
    place = points + mean + stretch * (displacement - mean)
    drawn = PolyCollection(place[cells], linewidth=0.15, edgecolor="0.45", facecolor="#dbe7f3")
    if stress:
        s = fields["stress of cells"].reshape(-1, 3, 3)
        trace = np.einsum("nii->n", s)
        deviator = np.einsum("nij,nij->n", s, s) - trace**2 / 3
        drawn.set_array(np.sqrt(1.5 * np.maximum(deviator, 0)))
        drawn.set_cmap("viridis")
        drawn.set_clim(0, limit)
    axes.add_collection(drawn)
    force = fields["contact_force"][:, :2].astype(float)
    pushed = np.abs(force).sum(axis=1) > 0
    if pushed.any():
        tips = place[pushed] + arrow * force[pushed]
        for foot, tip in zip(place[pushed], tips):
            axes.annotate(
                "",
                xy=tip,
                xytext=foot,
                arrowprops={"arrowstyle": "-|>", "color": "#D55E00", "linewidth": 1.3},
                zorder=4,
            )
    axes.axhline(0, color="black", linewidth=1.5)
    axes.set_aspect("equal")
    return force.sum(axis=0), drawn


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
    """Where a linear function on triangles is zero: a piece of a line in each.

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
    """Deformed bodies with a colour for each triangle; what maps colours."""
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
