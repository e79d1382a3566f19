# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bar at several times: figures C-5 and C-11."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Rectangle

from shared.figure import check
from shared.meshes import read_bar

from . import characteristics
from .rows import checks_of_runs

BETWEEN = 10  # steps from one picture to the next
HALF = 0.17  # s on the axis: the height of the exact bar, and of the computed one below it
POINTS = np.linspace(0, 1, 6)  # whose paths are drawn
WALL = {"facecolor": "0.9", "edgecolor": "0.45", "hatch": "///", "linewidth": 0}


def _bar(ends, bottom, pressures):
    """Rectangles of the elements of a bar, coloured by pressure."""
    boxes = PatchCollection(
        [Rectangle((a, bottom), b - a, HALF) for a, b in zip(ends, ends[1:])],
        cmap="viridis",
        edgecolor="white",
        linewidth=0.3,
    )
    boxes.set_array(pressures)
    return boxes


def draw_bar(bar, run, final_time, walls, limits):
    """The deformed bar between walls: above, the exact one; below, that of the run."""
    steps = range(0, round(final_time / 0.05) + 1, BETWEEN)
    figure, axes = plt.subplots(figsize=(6.8, 1.6 + 0.47 * len(steps)), layout="constrained")
    times = np.linspace(0, final_time, 40 * round(final_time) + 1)
    for x in POINTS:
        way = [x + characteristics.displacement(bar, x, t) for t in times]
        axes.plot(way, times, color="0.75", linewidth=0.9, zorder=1)
    table = run.read()
    for step in steps:
        time = table["time"][step]
        nodes, moved, _, stress = read_bar(run.field_file(step))
        exact = [x + characteristics.displacement(bar, x, time) for x in nodes]
        # After the jump that may be there, as a picture of that time has it.
        pressure = -characteristics.strain(bar, 0.5 * (nodes[1:] + nodes[:-1]), time)
        for place, bottom, shown in (
            (exact, time, pressure),
            (nodes + moved, time - HALF, -stress),
        ):
            drawn = _bar(place, bottom, shown)
            drawn.set_clim(*limits)
            axes.add_collection(drawn)
    left, right = -0.08, walls[-1] + 0.08
    axes.axvspan(left, 0, **WALL)
    axes.axvspan(walls[-1], right, **WALL)
    axes.set(xlim=(left, right), ylim=(-0.3, final_time + 0.3), yticks=np.arange(final_time + 1))
    axes.set_xlabel("place of the deformed bar (m)")
    axes.set_ylabel("time (s)")
    axes.grid(False)
    figure.colorbar(
        drawn,
        ax=axes,
        location="top",
        label="pressure in the bar (Pa)",
        extend="both",
        aspect=40,
        shrink=0.7,
        pad=0.02,
    )
    return figure


def checks_bar(bar, run, final_time):
    """The exact solution drawn here against the program's own, by the error of the run."""
    table = run.read()
    steps = range(0, round(final_time / 0.05) + 1, BETWEEN)
    ours = [characteristics.h1_error(bar, run.field_file(n), table["time"][n]) for n in steps]
    difference = np.abs(np.array(ours) - table["h1_error"][list(steps)]).max()
    return [
        check(
            "H1 error of the pictures, by the exact solution drawn and by the program's",
            f"{difference:.1e}",
            difference < 1e-5,
            "differ by < 1e-5: fields have single precision",
            exact="0",
        )
    ] + checks_of_runs(bar, [run])
