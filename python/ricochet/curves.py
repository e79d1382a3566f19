# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves over time, of one run or of several in the same axes."""

from __future__ import annotations

import contextlib
import math
import pathlib
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

from . import measures, prm  # noqa: E402
from .results import Run  # noqa: E402
from .tables import Array, Table  # noqa: E402

# Colours that are distinguishable with any eyes (Okabe and Ito), without the yellow one.
COLOURS = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#882255",
)
STYLES: tuple[Any, ...] = (
    "-",
    (0, (6, 2)),
    (0, (1.5, 1.5)),
    (0, (7, 2, 1.5, 2)),
    (0, (3, 1.2)),
    (0, (7, 1.5, 1.5, 1.5, 1.5, 1.5)),
    (0, (10, 3)),
)

SETTINGS = {
    "figure.dpi": 100,
    "savefig.dpi": 130,
    "font.size": 10,
    "axes.titlesize": 11,
    "axes.grid": True,
    "grid.color": "0.9",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "axes.formatter.limits": (-3, 4),
    "axes.formatter.use_mathtext": True,
    # The numbers of ticks, not their distances from another number.
    "axes.formatter.useoffset": False,
    "legend.frameon": False,
}


@dataclass(frozen=True)
class Line:
    """A run as it is drawn: its table, its name in legends, its look."""

    label: str
    table: Table
    look: dict[str, Any]


def look(number: int, of: int) -> dict[str, Any]:
    """Colour, style and width of curve `number` of some: no two have the same colour and style,
    and a curve that lies on an earlier one leaves that visible."""
    return {
        "color": COLOURS[number % len(COLOURS)],
        "linestyle": STYLES[number % len(STYLES)],
        "linewidth": 2.4 - 1.2 * min(number / max(of - 1, 1), 1) if of > 1 else 1.6,
    }


def lines_of(runs: Sequence[Run]) -> list[Line]:
    """Runs with the names of what differs between them, or of their folders."""
    names = [run.folder.resolve().name for run in runs]
    if len(runs) > 1:
        parameters = []
        for run in runs:
            try:
                parameters.append(run.parameters)
            except Exception:  # noqa: BLE001 - a table without parameters can be drawn all the same
                parameters.append({})
        texts = prm.labels(parameters)
        if max(map(len, texts)) > 90:
            # Methods bring values of their own along.
            texts = prm.labels(parameters, telling_only=True)
        if len(set(texts)) == len(runs) and max(map(len, texts)) <= 90:
            names = texts
        elif any(texts):
            names = [
                name + (f" ({text})" if 0 < len(text) <= 60 else "")
                for name, text in zip(names, texts)
            ]
        if len(set(names)) < len(runs):
            names = [f"{run.folder}" for run in runs]
    return [
        Line(name, run.table, look(number, len(runs)))
        for number, (name, run) in enumerate(zip(names, runs))
    ]


@contextlib.contextmanager
def settings() -> Iterator[None]:
    """The look of all figures."""
    with plt.rc_context(SETTINGS):
        yield


def plain(text: str) -> str:
    """A name or a unit for matplotlib, which takes what is between dollar signs as formulas."""
    return text.replace("$", r"\$")


def words(column: str) -> str:
    """The name of a column as words."""
    return plain(column.replace("_", " "))


def _unit(lines: Sequence[Line], column: str) -> str:
    """The unit of a column, in brackets; none where runs differ in it or it is 1."""
    units = {line.table.units[column] for line in lines if column in line.table}
    unit = units.pop() if len(units) == 1 else ""
    return f" ({plain(unit)})" if unit not in ("", "1") else ""


def _draw(axes: Axes, line: Line, column: str, values: Array | None = None) -> None:
    """A column over time, or a function of it, if there is any value."""
    if column not in line.table or np.isnan(line.table[column]).all():
        return
    shown = line.table[column] if values is None else values
    axes.plot(line.table["time"], shown, label=line.label, **line.look)


def _say_if_empty(axes: Axes, text: str) -> None:
    if not axes.lines:
        axes.text(0.5, 0.5, text, ha="center", color="0.4", transform=axes.transAxes)
        axes.set_yticks([])


def legend_below(
    figure: Figure, axes: Axes | Sequence[Axes], columns: int | None = None, width: int = 44
) -> None:
    """A legend of all curves under the axes, where it covers none."""
    handles: dict[str, Any] = {}
    for each in axes if isinstance(axes, (list, tuple, np.ndarray)) else [axes]:
        for handle, label in zip(*each.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    if not handles:
        return
    texts = [plain(textwrap.fill(label, width)) for label in handles]
    longest = max(len(line) for text in texts for line in text.split("\n"))
    if columns is None:
        # About 13 letters in an inch, and the sample of the line.
        fitting = int(figure.get_size_inches()[0] * 12.5 / (longest + 9))
        columns = max(1, min(fitting, len(texts)))
    figure.legend(
        handles.values(),
        texts,
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        ncol=columns,
        handlelength=4.2,
        fontsize=9,
    )


def _grid(n: int, columns: int, width: float, height: float) -> tuple[Figure, list[Axes]]:
    """Axes for `n` panels with a common time."""
    rows = math.ceil(n / columns)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(width * columns, height * rows),
        sharex=True,
        squeeze=False,
        layout="constrained",
    )
    panels = list(axes.flat)
    for empty in panels[n:]:
        empty.remove()
    for number, panel in enumerate(panels[:n]):
        # Sharing hides the labels of panels above a place that is empty.
        if number + columns >= n:
            panel.tick_params(labelbottom=True)
    return figure, panels[:n]


def change_label(tables: Sequence[Table], begin: str) -> str:
    """The label of an axis with `measures.change_of_energy` in per cent."""
    scales = {"largest" if measures.begins_at_rest(table) else "first" for table in tables}
    work = any(measures.has_work_from_outside(table) for table in tables)
    return (
        begin
        + ("\nwithout work from outside\n" if work else " ")
        + f"(% of the {' or '.join(sorted(scales))})"
    )


def _time_labels(panels: Sequence[Axes], lines: Sequence[Line], columns: int) -> None:
    for number, panel in enumerate(panels):
        if number + columns >= len(panels):
            panel.set_xlabel(f"time{_unit(lines, 'time')}")


ENERGIES = ("kinetic_energy", "elastic_energy", "energy", "modified_energy")
ENERGY_NAMES = {
    "kinetic_energy": "kinetic energy",
    "elastic_energy": "elastic energy",
    "energy": "energy (kinetic + elastic)",
    "modified_energy": "modified energy (+ contact potential)",
}


def energies(lines: Sequence[Line]) -> Figure:
    """Kinetic, elastic, total and modified energy.

    For one run: all in one panel, and the change of the last two in another. For several: a panel
    for each, the last two as changes, so that losses can be seen.
    """

    def change(line: Line, column: str, panel: Axes) -> None:
        if column in line.table:
            _draw(panel, line, column, 100 * measures.change_of_energy(line.table, column))

    if len(lines) == 1:
        figure, panels = _grid(2, 1, 7.5, 3.1)
        for number, column in enumerate(ENERGIES):
            one = Line(ENERGY_NAMES[column], lines[0].table, look(number, len(ENERGIES)))
            _draw(panels[0], one, column)
            if column in ENERGIES[2:]:
                change(one, column, panels[1])
        panels[0].set_ylabel(f"energy{_unit(lines, 'energy')}")
        panels[1].set_ylabel(change_label([lines[0].table], "change of energy"))
        _time_labels(panels, lines, 1)
        legend_below(figure, panels[0])
        return figure
    figure, panels = _grid(4, 2, 5.2, 3.1)
    for panel, column in zip(panels, ENERGIES):
        relative = column in ENERGIES[2:]
        for line in lines:
            if relative:
                change(line, column, panel)
            else:
                _draw(panel, line, column)
        _say_if_empty(panel, "none of the runs has one")
        panel.set_title(ENERGY_NAMES[column])
        panel.set_ylabel(
            change_label([line.table for line in lines], "change")
            if relative
            else f"energy{_unit(lines, column)}"
        )
    _time_labels(panels, lines, 2)
    legend_below(figure, panels)
    return figure


def _contact_names(lines: Sequence[Line]) -> list[str]:
    return list(dict.fromkeys(name for line in lines for name in measures.contacts(line.table)))


def _by_contact(lines: Sequence[Line], quantities: Sequence[tuple[str, str]]) -> Figure | None:
    """Panels of quantities `(beginning of the column, name)`, one row for each of them.

    For one run the contacts are curves; for several they are panels beside each other.
    """
    names = _contact_names(lines)
    if not names:
        return None
    if len(lines) == 1:
        figure, panels = _grid(len(quantities), 1, 7.5, 3.1)
        for panel, (begin, title) in zip(panels, quantities):
            for number, name in enumerate(names):
                _draw(panel, Line(name, lines[0].table, look(number, len(names))), begin + name)
            panel.set_ylabel(f"{title}{_unit(lines, begin + names[0])}")
        _time_labels(panels, lines, 1)
        legend_below(figure, panels)
        return figure
    columns = min(len(names), 3)
    groups = [names[i : i + columns] for i in range(0, len(names), columns)]
    rows = len(groups) * len(quantities)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(max(7.5, 4.6 * columns), 3.1 * rows),
        sharex=True,
        squeeze=False,
        layout="constrained",
    )
    for g, group in enumerate(groups):
        for q, (begin, title) in enumerate(quantities):
            row = axes[g * len(quantities) + q]
            for panel, name in zip(row, group):
                for line in lines:
                    _draw(panel, line, begin + name)
                panel.set_ylabel(f"{title}{_unit(lines, begin + name)}")
                panel.set_title(words(name))
                _say_if_empty(panel, "no values in the tables")
            for panel in row[len(group) :]:
                panel.remove()
    for panel in axes[-1]:
        panel.set_xlabel(f"time{_unit(lines, 'time')}")
    legend_below(figure, list(axes.flat))
    return figure


def contact_forces(lines: Sequence[Line]) -> Figure | None:
    """The force of each contact; None if there is no contact."""
    return _by_contact(lines, [("contact_force_", "contact force")])


def gaps(lines: Sequence[Line]) -> Figure | None:
    """The smallest gap and the penetration of each contact; None if there is no contact."""
    return _by_contact(lines, [("smallest_gap_", "smallest gap"), ("penetration_", "penetration")])


def save(figure: Figure, path: pathlib.Path) -> pathlib.Path:
    """Write a figure and close it."""
    figure.savefig(path, bbox_inches="tight")
    plt.close(figure)
    return path
