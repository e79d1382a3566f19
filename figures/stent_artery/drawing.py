# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of stent and artery: figures B-13 and B-14."""

from matplotlib.collections import PolyCollection

from shared.pictures import draw_cells, draw_mesh_lines, snapshot

from .common import DEPLOYMENT

LENGTH, THICKNESS = 20.0, 1.0  # mm, of the wall
STRESS = 1.5  # MPa, the largest shown
WHOLE = ((-0.45, LENGTH + 0.45), (-0.66, THICKNESS + 0.16))


def draw_mesh(axes, step, coloured, lines=True):
    """Artery and stent at a step; the colour map, if any."""
    _, place, cells, fields = snapshot(DEPLOYMENT, step)
    if coloured:
        stress = fields["von_mises of cells"]
        return draw_cells(axes, place, cells, stress, STRESS, lines)
    for number, colour in ((0, "#F2C9C0"), (1, "#B8C4D0")):
        chosen = cells[fields["part of cells"] == number]
        axes.add_collection(PolyCollection(place[chosen], facecolor=colour, edgecolor="face"))
    draw_mesh_lines(axes, place, cells, lines)
    return None
