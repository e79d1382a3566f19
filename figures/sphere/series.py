# SPDX-License-Identifier: LGPL-2.1-or-later
"""Motion, force and energy against time: figures 16 and 17."""

import itertools

import matplotlib.pyplot as plt

from shared.curves import name_panel

from .common import AUGMENTED, CURVED, HARD, NITSCHE, Scheme
from .measures import conserved

ON_CURVED = Scheme("curved", "Nitsche, CN, curved cells", "#CC79A7")


def draw_velocity(panel, run, scheme):
    table = run.read()
    panel.plot(table["time"], table["lowest_velocity"], color=scheme.colour, linewidth=0.7)
    name_panel(panel, scheme.label)


def draw_series(sphere):
    """Two columns: Nitsche and the augmented Lagrangian.

    Where curves coincide the last ones are the widest, below, so that all are seen. The velocities
    swing too much for that: each has a panel.
    """
    figure, axes = plt.subplots(
        7,
        2,
        figsize=(6.8, 11.5),
        sharex=True,
        layout="constrained",
        height_ratios=(1.5, 1, 1, 1, 1, 1.5, 1.5),
    )
    columns = [[(sphere.runs[s.key], s) for s in schemes] for schemes in (NITSCHE, AUGMENTED)]
    wide = [(run, scheme) for run, scheme in columns[0]]
    if sphere is HARD:
        wide.append((CURVED, ON_CURVED))
    for column, curves in enumerate((wide, columns[1])):
        for number, (run, scheme) in reversed(list(enumerate(curves))):
            width = 0.8 + 1.1 * number
            table = run.read()
            keywords = {"color": scheme.colour, "label": scheme.label}
            time, force = table["time"], table["contact_force_foundation"] / 1e3
            axes[0, column].plot(time, table["lowest_displacement"], linewidth=width, **keywords)
            axes[5, column].plot(time, force, linewidth=width, **keywords)
            axes[6, column].plot(time, conserved(table), linewidth=1.3, **keywords)
        axes[-1, column].set_xlabel("time (s)")
    rows = itertools.zip_longest(*columns)
    for row, (nitsche, augmented) in zip(axes[1:5], rows):
        draw_velocity(row[0], *nitsche)
        if augmented:
            draw_velocity(row[1], *augmented)
        elif sphere is HARD:
            draw_velocity(row[1], CURVED, ON_CURVED)
        else:
            row[1].axis("off")
    for row, label in (
        (0, "displacement (m)"),
        (5, "contact force (kN)"),
        (6, "energy less work\nof gravity (J)"),
    ):
        axes[row, 0].set_ylabel(label)
    for group in (axes[0], axes[1:5].flat, axes[5]):
        share_scale([panel for panel in group if panel.axison])
    figure.align_ylabels(axes[:, 0])
    # One label for the four rows of velocities.
    axes[3, 0].set_ylabel("velocity (m/s)", y=1.0)
    lines, labels = axes[6, 0].get_legend_handles_labels()
    figure.legend(
        lines[::-1],
        labels[::-1],
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncol=2,
    )
    axes[0, 0].set_title("Nitsche")
    axes[0, 1].set_title("augmented Lagrangian")
    return figure


def share_scale(panels):
    """The same lowest and highest value for all panels."""
    low = min(panel.get_ylim()[0] for panel in panels)
    high = max(panel.get_ylim()[1] for panel in panels)
    for panel in panels:
        panel.set_ylim(low, high)
