# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing of curves against time, and of bands around them."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .methods import touch


ENERGY = "energy / initial energy"
FULL_WIDTH = (6.8, 4.2)  # inches: letters can be read on a telephone


def energy_axes():
    """Axes for the energy relative to the start."""
    figure, axes = plt.subplots(figsize=FULL_WIDTH)
    axes.axhline(1, color="0.6", linewidth=0.7, zorder=1)
    axes.set_ylabel(ENERGY)
    return figure, axes


def legend_above(axes, columns=2, **keywords):
    """A legend that no curve can run through."""
    axes.legend(
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=columns,
        borderaxespad=0.3,
        columnspacing=1.2,
        **keywords,
    )


def small_panels(count, columns=2, height=1.75):
    """Panels with the same scales, one for each curve; those left over are invisible."""
    rows = -(-count // columns)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(FULL_WIDTH[0], height * rows + 0.5),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    for panel in axes.flat[count:]:
        panel.axis("off")
        # The panel above has nothing below it.
        axes[-2, columns - 1].tick_params(labelbottom=True)
    return figure, axes


def name_panel(panel, text):
    panel.set_title(text, loc="left", fontsize=10, pad=4)


def key_of_bands(figure, axes, colour="0.35"):
    """Legend of line and band: in an unused panel, or above all."""
    line = Line2D([], [], color=colour, marker=".", label="impact in the middle of a step")
    band = Patch(color=colour, alpha=0.25, linewidth=0, label="other positions in the step")
    free = [panel for panel in axes.flat if not panel.axison]
    if free:
        free[0].legend(handles=[line, band], loc="lower left")
    else:
        figure.legend(handles=[line, band], loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)


def panels_with_bands(curves, values, start, against, limits, scale=1e3, marker="."):
    """A panel with a curve and its band for each (run, runs of the band, colour, name)."""
    figure, axes = small_panels(len(curves))
    for panel, (one, others, colour, name) in zip(axes.flat, curves):
        panel.axhline(1, color="0.6", linewidth=0.7, zorder=1)
        fill(panel, others, values, start, colour, scale)
        curve(panel, one, values, start, colour, None, scale, marker=marker, markersize=4)
        name_panel(panel, name)
    axes[0, 0].set_xlim(*limits)
    figure.supxlabel(against, fontsize=10)
    figure.supylabel(ENERGY, fontsize=10)
    key_of_bands(figure, axes)
    return figure


def curve(axes, run, values, start, colour, label, scale=1e3, **keywords):
    """A quantity against the time since the first touch."""
    time = scale * (run.read()["time"] - touch(run, start))
    axes.plot(time, values(run), color=colour, label=label, zorder=3, **keywords)


def fill(axes, runs, values, start, colour, scale=1e3):
    """The band that a quantity covers over the positions of the impact."""
    tables = [(scale * (run.read()["time"] - touch(run, start)), values(run)) for run in runs]
    first = max(time[0] for time, _ in tables)
    last = min(time[-1] for time, _ in tables)
    common = np.linspace(first, last, 500)
    lines = [np.interp(common, *table) for table in tables]
    axes.fill_between(
        common, np.min(lines, axis=0), np.max(lines, axis=0), color=colour, alpha=0.25, linewidth=0
    )
