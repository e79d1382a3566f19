# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ball and ring: meshes.

The meshes of most figures of the ball (1580 nodes; the paper's has 7820, figure A-2) and the
paper's of the ring (128 x 13 nodes). Below, the framed parts; dots are the nodes that can touch the
foundation, of which both have 128. The ring's layers are 8.3 cm thick: at 10 m/s it moves farther
than that in a step of 10 ms.
"""

import matplotlib.pyplot as plt

from elastic_ball.pictures import PICTURE
from shared.figure import Figure
from shared.paper_numbers import numbers
from shared.pictures import draw_mesh, mesh_checks

from .common import run

PAPER = numbers("B.figure_2")
RING = run(
    "B-2", "ring", "default.prm", ("Time/Final time=1e-2", "Output/Fields every=1000"), cost=1
)
BODIES = (("ball", PICTURE, 1580), ("ring", RING, 128 * 13))


def draw_all(axes):
    return [
        draw_mesh(*column, one.field_file(0), 4.0) for column, (_, one, _) in zip(axes.T, BODIES)
    ]


def draw():
    figure, axes = plt.subplots(
        2, 2, figsize=(6.8, 6), height_ratios=(1.33, 1), layout="constrained"
    )
    draw_all(axes)
    return figure


def checks():
    figure, axes = plt.subplots(2, 2)
    meshes = draw_all(axes)
    plt.close(figure)
    rows = []
    for (name, _, nodes), mesh in zip(BODIES, meshes):
        paper = f"{PAPER['nodes']}, {PAPER['on_circle']}" if name == "ball" else "-"
        rows += mesh_checks(name, *mesh, nodes, PAPER["on_circle"], paper)
    return rows


FIGURE = Figure("B-2", __doc__, [PICTURE, RING], draw, checks)
