# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: number of contact points.

Energy relative to the start for meshes of 25, 96, 392 and 1580 nodes, steps of 10 ms. Bands: ten
positions of the impact within a step. Left: standard normal compliance. Right: improved,
alpha = 3.
"""

from shared.curves import panels_with_bands
from shared.figure import Figure
from shared.measures import dip, energy, lost, mean, percent
from shared.methods import INC, SCALE, SNC
from shared.paper_numbers import numbers
from shared.rows import checks_of_runs, recovered_row, statement
from shared.runs import QUIET, Run

from .common import AGAINST, COARSE, STEP, positions

LEAST, MOST = numbers("A.figure_7")["snc_lost"]
NODES = {16: 25, 32: 96, 64: 392, 128: 1580}
BY_MESH = {
    (method.key, n): COARSE[method.key]
    if n == 128
    else Run(
        "A-7",
        f"{method.key}_{n}",
        "elastic_ball",
        f"elastic_ball/figure_A08_{method.key}.prm",
        (*QUIET, f"Mesh/Nodes={NODES[n]}", f"Mesh/Boundary nodes={n}"),
        cost=0.3,
    )
    for method in (SNC, INC[3])
    for n in NODES
}
BY_MESH_BAND = {key: positions(r, "10ms") for key, r in BY_MESH.items()}
RUNS = [r for key in BY_MESH for r in (BY_MESH[key], *BY_MESH_BAND[key])]


def draw():
    curves = [
        (
            BY_MESH[method.key, n],
            BY_MESH_BAND[method.key, n],
            colour,
            f"{method.name}, {n} nodes on the circle",
        )
        for n, colour in zip(NODES, SCALE)
        for method in (SNC, INC[3])
    ]
    return panels_with_bands(curves, energy, STEP["10ms"][1], AGAINST, (-20, 70))


def checks():
    rows = []
    paper = f"{100 * LEAST:g} to {100 * MOST:g} %"
    for n in NODES:
        losses = [lost(r) for r in BY_MESH_BAND["snc", n]]
        reaches = min(losses) <= MOST and max(losses) >= LEAST
        rows.append(
            statement(
                f"SNC, {n} nodes on the circle: energy lost",
                percent(losses),
                reaches,
                f"the ten positions reach {paper}",
                paper,
                "the positions do not reach the paper's range on this mesh",
            )
        )
        group = [BY_MESH["inc3", n], *BY_MESH_BAND["inc3", n]]
        rows.append(recovered_row(f"INC alpha = 3, {n} nodes", group))
    for n in NODES:
        ours = (
            mean([100 * dip(r) for r in BY_MESH_BAND["inc3", n]]),
            mean([100 * dip(r) for r in BY_MESH_BAND["snc", n]]),
        )
        rows.append(
            statement(
                f"mean dip of INC alpha = 3 and of SNC, {n} nodes",
                f"{ours[0]:.1f} %, {ours[1]:.1f} %",
                ours[0] < ours[1],
                "INC less",
                "INC has less fluctuation",
                "INC's dip is no smaller during the impact; what differs is that it comes back",
            )
        )
    return rows + checks_of_runs(RUNS)


FIGURE = Figure("A-7", __doc__, RUNS, draw, checks)
