# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost against degrees of freedom: figure A-12 and table A-T4."""

from shared.methods import INC, PERSISTENT, SIGNORINI, SNC
from shared.paper_numbers import series

from .common import run

PAPER = series("A.table_4")
# Steps of the paper: 10 s in steps of 10 ms.
PAPER_STEPS = 1000
COST_METHODS = (SIGNORINI, PERSISTENT, INC[3], SNC)
FAMILY = {32: (32, 3), 64: (64, 3), 128: (128, 7), 256: (256, 9), 512: (512, 15)}
NODES = {n: a * b for n, (a, b) in FAMILY.items()}
RUNS = {
    (m.key, n): run(
        "A-T4",
        f"{m.key}_{n}",
        "figure_A13_inc3.prm" if m is INC[3] else f"figure_A11_{m.key}.prm",
        (
            f"Mesh/Nodes around={around}",
            f"Mesh/Nodes across={across}",
            "Time/Final time=1",
            *(("Contact/Compliance exponent=3",) if m is SNC else ()),
        ),
        cost=n,
    )
    for m in COST_METHODS
    for n, (around, across) in FAMILY.items()
}
