# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: mesh.

The mesh of the papers: 7820 nodes, by paper B 128 of them on the circle, which is finer inside
than at its boundary. Right: the framed part; dots are the nodes that can touch the foundation. The
ball is set down on it here; it starts 15 m above, at 10 m/s.
"""

import matplotlib.pyplot as plt

from shared.figure import Figure
from shared.paper_numbers import compare
from shared.pictures import draw_mesh, mesh_checks
from shared.runs import Run

RUN = Run(
    "A-2",
    "mesh",
    "elastic_ball",
    "elastic_ball/default.prm",
    ("Time/Final time=1e-3", "Output/Log every=0"),
    cost=2,
)


def draw():
    figure, (whole, part) = plt.subplots(1, 2, figsize=(6.8, 3.3), layout="constrained")
    draw_mesh(whole, part, RUN.field_file(0), 4.0)
    return figure


def checks():
    figure, (whole, part) = plt.subplots(1, 2)
    mesh = draw_mesh(whole, part, RUN.field_file(0), 4.0)
    plt.close(figure)
    return [compare("A.figure_2.nodes", len(mesh[0])), *mesh_checks("ball", mesh[0], 7820, 128)]


FIGURE = Figure("A-2", __doc__, [RUN], draw, checks)
