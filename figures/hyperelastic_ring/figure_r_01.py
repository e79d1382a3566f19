# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: with contact of the ring with itself, and without.

Persistent contact, 128 x 7 nodes, steps of 5 ms. Left the ring with self-contact, right it passes
through itself, as in the papers; red where it covers itself. Arrows are nodal contact forces.
Below: its depth in itself, by its outline in the pictures alone and by the program's energy table;
energies.
"""

import functools

import matplotlib.pyplot as plt
import numpy as np

from shared import overlap
from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.pictures import body
from shared.rows import constant_row, momentum_row
from shared.runs import Run

RUNS = {
    felt: Run(
        "R-1",
        key,
        "hyperelastic_ring",
        "hyperelastic_ring/feels_itself.prm",
        (f"Contact/Self={str(felt).lower()}", "Output/Fields every=10", "Output/Log every=0"),
        cost=cost,
    )
    for felt, key, cost in ((True, "feels_itself", 55), (False, "passes_through", 30))
}
STEPS = (270, 320, 400, 470)
RED = "#E31A1C"


@functools.cache
def overlaps(felt):
    """Times (s) of the pictures of a run and the overlap of the ring with itself in each."""
    one = RUNS[felt]
    time = one.read()["time"]
    files = [one.field_file(step) for step in range(0, len(time), 10)]
    return time[::10], [overlap.overlap_in(file) for file in files]


def deepest(felt):
    """The overlap's depth (m) after the steps with a picture."""
    return np.array([found.depth for found in overlaps(felt)[1]])


def of_itself(table, name):
    return np.maximum(table[f"{name}_outer_circle"], table[f"{name}_inner_circle"])


def draw():
    figure = plt.figure(figsize=(12, 11.5))
    pictures, plots = figure.subfigures(2, 1, height_ratios=(2.1, 1))
    panels = pictures.subplots(len(STEPS), 2, sharey=True)
    for column, felt in zip(panels.T, (True, False)):
        one = RUNS[felt]
        time, found = one.read()["time"], overlaps(felt)[1]
        for panel, step in zip(column, STEPS):
            place = body(panel, one.field_file(step), arrow=1.5 / 2e5)[2]
            panel.axhline(0, color="black", linewidth=1.5)
            middle = 0.5 * (place[:, 0].min() + place[:, 0].max())
            for line in overlap.regions(found[step // 10].pieces):
                panel.fill(*line.T, color=RED, linewidth=0.8, zorder=3)
            panel.set_xlim(middle - 15, middle + 15)
            panel.set_ylim(-0.7, 8.3)
            panel.text(middle - 14.5, 7.1, f"t = {time[step]:.2f} s")
            panel.grid(False)
        column[0].set_title("self-contact" if felt else "passes through itself")
        column[-1].set_xlabel("$x_1$ (m)")
    for panel in panels[:, 0]:
        panel.set_ylabel("$x_2$ (m)")
    pictures.subplots_adjust(left=0.06, right=0.99, top=0.96, bottom=0.07, wspace=0.05)

    left, right = plots.subplots(1, 2)
    table = RUNS[True].read()
    nodes = of_itself(table, "penetration")
    left.semilogy(
        table["time"],
        np.where(nodes > 0, nodes, np.nan),
        color="#0072B2",
        linewidth=0.8,
        label="self-contact: its nodes, from the table",
    )
    for felt, colour, label in (
        (True, "#0072B2", "self-contact: its outline, from the pictures"),
        (False, RED, "passes through itself: its outline"),
    ):
        depth = deepest(felt)
        depth = np.where(depth > 0, depth, np.nan)
        left.semilogy(overlaps(felt)[0], depth, "o", color=colour, markersize=4, label=label)
        table = RUNS[felt].read()
        for name, shade in (("kinetic", "#0072B2"), ("elastic", "#009E73"), ("both", "black")):
            right.plot(
                table["time"],
                table["energy" if name == "both" else f"{name}_energy"] / table["energy"][0],
                color=shade,
                linestyle="-" if felt else (0, (4, 2)),
                label=name if felt else None,
            )
    left.set_xlim(0, 6)
    left.set_ylim(1e-3, 3)
    left.set_xlabel("time (s)")
    left.set_ylabel("depth of the ring in itself (m)")
    left.legend(fontsize=8, loc="lower right")
    right.set_xlim(0, 6)
    right.set_xlabel("time (s); dashed: passes through itself")
    right.set_ylabel("energy / initial energy")
    right.legend(fontsize=8, loc="center right")
    plots.subplots_adjust(left=0.06, right=0.99, top=0.97, bottom=0.14, wspace=0.15)
    return figure


def checks():
    table = RUNS[True].read()
    felt, through = deepest(True), deepest(False)
    area = {key: max(found.area for found in overlaps(key)[1]) for key in RUNS}
    columns = of_itself(table, "penetration")
    error = np.abs(felt - columns[::10]).max()
    touching = of_itself(table, "contact_force") > 0
    residual = max(np.abs(one.read()["balance_residual"]).max() for one in RUNS.values())
    # Change of the angular momentum in steps in which the foundation does nothing.
    free = table["contact_force_foundation"][1:] == 0
    turning = np.abs(table["angular_momentum"]).max()
    change = np.abs(np.diff(table["angular_momentum"])[free]).max() / turning
    return [
        constant_row("self-contact", RUNS[True], paper="-"),
        constant_row("passes through itself", RUNS[False], paper="-"),
        check(
            "max |balance residual|, 2 runs",
            f"{residual:.1e}",
            residual < 1e-9,
            "< 1e-9 of the energy",
            exact="0",
        ),
        momentum_row(RUNS.values()),
        check(
            "with self-contact: change of angular momentum in a step off the foundation",
            f"{change:.1e}, {np.sum(free & touching[1:])} such steps in contact with itself",
            change < 1e-11 and np.sum(free & touching[1:]) > 10,
            "< 1e-11; some steps in contact with itself alone",
            exact="0",
        ),
        compare("own.ring_itself.through", through.max()),
        compare("own.ring_itself.area", area[False]),
        check(
            "with self-contact: deepest overlap (m), its area (m^2)",
            f"{felt.max():.3f}, {area[True]:.3f}",
            felt.max() < 0.15 and area[True] < 0.01 * area[False],
            "< 0.15: 30 m/s towards each other for a step of 5 ms; the area a hundredth",
        ),
        compare("own.ring_itself.felt", felt.max()),
        check(
            "with self-contact: depth of the outline less the table's penetration (m)",
            f"{error:.1e}",
            error < 1e-3,
            "< 1e-3: beside a corner the nearest side may be another one",
            exact="0",
        ),
        compare("own.ring_itself.deepest", columns.max()),
        compare("own.ring_itself.foundation", table["penetration_foundation"].max()),
        compare("own.ring_itself.seconds", np.diff(table["time"])[touching[1:]].sum()),
        compare("own.ring_itself.force", of_itself(table, "contact_force").max()),
    ]


FIGURE = Figure("R-1", __doc__, list(RUNS.values()), draw, checks)
