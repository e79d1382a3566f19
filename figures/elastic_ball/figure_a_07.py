# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic ball: number of contact points.

Energy relative to the start for meshes of 25, 96, 392 and 7820 nodes, steps of 10 ms. Bands: ten
positions of the impact within a step. Left: standard normal compliance. Right: improved,
alpha = 3.
"""

from shared.curves import panels_with_bands
from shared.figure import Figure
from shared.measures import dip, energy, lost, mean, missing_after
from shared.methods import INC, SCALE, SNC
from shared.paper_numbers import compare
from shared.rows import checks_of_runs
from shared.runs import QUIET, Run

from .common import AGAINST, COARSE, STEP, positions

NODES = {16: 25, 32: 96, 64: 392, 128: 7820}
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
    for n in NODES:
        bands = {key: BY_MESH_BAND[key, n] for key in ("snc", "inc3")}
        dips = {key: mean([dip(r) for r in band]) for key, band in bands.items()}
        rows += [
            compare(f"A.figure_7.snc_{n}", [lost(r) for r in bands["snc"]]),
            compare(f"A.figure_7.dip_{n}", dips["inc3"] / dips["snc"]),
        ]
    inc = [r for n in NODES for r in (BY_MESH["inc3", n], *BY_MESH_BAND["inc3", n])]
    return rows + [compare("A.figure_7.inc3", missing_after(inc))] + checks_of_runs(RUNS)


FIGURE = Figure("A-7", __doc__, RUNS, draw, checks)
