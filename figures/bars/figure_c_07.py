# SPDX-License-Identifier: LGPL-2.1-or-later
"""1D-SD, penetration of the penalty method and of Nitsche's.

Displacement of the left end near the obstacle, Crank-Nicolson with consistent mass; the obstacle
is at 0. Below: the first contact, with the mean over t = 1.00 ... 2.10 (dotted). That window gives
the digits that the paper prints, and was found by trying: the paper does not print its own.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure
from shared.paper_numbers import compare

from .common import TREATMENTS, bar_run
from .exact import FINAL_TIME, SD
from .panels import draw_exact
from .rows import checks_of_runs

RUNS = {curve.key: bar_run(SD, 7, curve) for curve in TREATMENTS}
# The steps over which the first contact is averaged: the exact contact, t = 1.00, 1.05, ..., 2.00;
# or to 2.10, which gives the paper's digits.
WINDOWS = {"": slice(20, 41), "_to_210": slice(20, 43)}


def mean_displacement(key, window=WINDOWS["_to_210"]):
    return RUNS[key].read()["displacement_left"][window].mean()


def draw():
    figure, (whole, zoom) = plt.subplots(2, 1, figsize=(6.8, 7))
    end = SD.ends[0]
    time = np.arange(FINAL_TIME + 1)
    for panel in (whole, zoom):
        panel.axhline(0, color="0.6", linewidth=0.6)
        draw_exact(panel, time, end.displacement_at(time))
        panel.set_xlabel("time (s)")
        panel.set_ylabel("displacement of the left end (m)")
    for curve in TREATMENTS:
        table = RUNS[curve.key].read()
        for panel in (whole, zoom):
            panel.plot(
                table["time"],
                table["displacement_left"],
                color=curve.colour,
                marker="." if panel is zoom else None,
                label=curve.label,
                zorder=3,
            )
        zoom.plot(
            [1, 2.1],
            [mean_displacement(curve.key)] * 2,
            color=curve.colour,
            linestyle=":",
            linewidth=1.6,
            label=f"{curve.label}, mean: {1e3 * mean_displacement(curve.key):.2f} mm",
        )
    whole.set(xlim=(0, FINAL_TIME), ylim=(-0.015, 0.05))
    whole.set_title("four periods, near the obstacle")
    zoom.set(xlim=(0.9, 2.25), ylim=(-0.0125, 0.0175), title="first contact")
    figure.tight_layout()
    figure.legend(
        *zoom.get_legend_handles_labels(), loc="lower center", bbox_to_anchor=(0.5, 0.98), ncol=2
    )
    return figure


def checks():
    largest = {key: run.read()["penetration_left"].max() for key, run in RUNS.items()}
    return [
        *(
            compare(f"C.figure_7.{key}{end}", mean_displacement(key, WINDOWS[end]))
            for end in WINDOWS
            for key in RUNS
        ),
        compare("C.figure_7.deeper", largest["penalty"] / largest["nitsche"]),
    ] + checks_of_runs(SD, RUNS.values())


FIGURE = Figure("C-7", __doc__, list(RUNS.values()), draw, checks)
