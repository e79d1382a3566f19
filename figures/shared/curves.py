# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing of curves against time, of bands around them, and of tables."""

import matplotlib.pyplot as plt
import numpy as np

from .methods import touch


def energy_axes(columns=1, **keywords):
    """Axes for the energy relative to the start."""
    figure, axes = plt.subplots(
        1, columns, figsize=(7.5 if columns == 1 else 6 * columns, 4.6), squeeze=False, **keywords
    )
    for panel in axes[0]:
        panel.axhline(1, color="0.6", linewidth=0.7, zorder=1)
    axes[0, 0].set_ylabel(r"energy / initial energy")
    return figure, axes[0] if columns > 1 else axes[0, 0]


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
        common, np.min(lines, axis=0), np.max(lines, axis=0), color=colour, alpha=0.18, linewidth=0
    )


def table_image(header, rows, widths=None):
    """A table as a matplotlib figure."""
    figure, axes = plt.subplots(figsize=(2.0 * len(header), 0.42 * (len(rows) + 1)))
    axes.axis("off")
    table = axes.table(
        cellText=rows, colLabels=header, loc="center", cellLoc="center", colWidths=widths
    )
    table.auto_set_font_size(False)
    table.set_fontsize(9)
    table.scale(1, 1.5)
    for (row, _), cell in table.get_celld().items():
        cell.set_edgecolor("0.8")
        if row == 0:
            cell.set_facecolor("0.93")
            cell.set_text_props(weight="bold")
    return figure
