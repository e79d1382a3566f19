# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ball and ring: meshes.

The meshes of the papers, of 7820 nodes and of 128 x 13 nodes. Below, the framed parts; dots are the
nodes that can touch the foundation, of which both have 128. The ring's layers are 8.3 cm thick: at
10 m/s it moves farther than that in a step of 10 ms.
"""

import matplotlib.pyplot as plt
import numpy as np

from elastic_ball.pictures import PICTURE
from shared.figure import Figure
from shared.paper_numbers import compare
from shared.pictures import draw_mesh

from .common import run

RING = run(
    "B-2", "ring", "default.prm", ("Time/Final time=1e-2", "Output/Fields every=1000"), cost=1
)
BODIES = (("6_1", PICTURE), ("6_2", RING))


def draw_all(axes):
    return [
        draw_mesh(*column, one.field_file(0), 4.0) for column, (_, one) in zip(axes.T, BODIES)
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
    rows = [compare("A.section_6_2.nodes", len(meshes[1][0]))]
    for (section, _), (points, _) in zip(BODIES, meshes):
        radius = np.hypot(*points.T)
        on_circle = (radius > radius.max() * (1 - 1e-6)).sum()
        rows += [
            compare(f"B.section_{section}.nodes", len(points)),
            compare(f"B.section_{section}.on_circle", on_circle),
        ]
    return rows


FIGURE = Figure("B-2", __doc__, [PICTURE, RING], draw, checks)
