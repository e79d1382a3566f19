# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a comparison: its table and figures in one HTML file."""

from __future__ import annotations

import base64
import html
import io
import pathlib
from collections.abc import Callable

import numpy as np

from . import curves, measures
from .comparison import Comparison, number, orders, quantities
from .tables import Array, Table

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

STYLE = """
body { max-width: 76em; margin: 2em auto; padding: 0 1em; font: 16px/1.5 sans-serif; color: #222 }
h2 { margin-top: 2em; border-top: 1px solid #ccc; padding-top: 1em }
img { max-width: 100%; height: auto }
div.table { overflow-x: auto }
table { border-collapse: collapse; font-size: 88% }
td, th { padding: .25em .8em; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top }
td.number { white-space: nowrap } td.refused { color: #a00 } small { color: #666 }
code { background: #f3f3f3; padding: 0 .3em }
"""


def _image(figure: Figure, what: str) -> str:
    """A figure as part of the page."""
    data = io.BytesIO()
    figure.savefig(data, format="png", bbox_inches="tight")
    plt.close(figure)
    code = base64.b64encode(data.getvalue()).decode()
    return f'<img src="data:image/png;base64,{code}" alt="{html.escape(what)}">'


def _since_touch(table: Table) -> Array:
    """The time since the first touch."""
    approach = measures.first_approach(table)
    return np.subtract(table["time"], approach.time if approach else table["time"][0])


def _history(comparison: Comparison, title: str, values: Callable[[Table], Array]) -> Figure:
    """A quantity over time, of all methods: the run that is shown, and the range of all."""
    several = any(len(method.runs) > 1 for method in comparison.methods)
    figure, axes = plt.subplots(figsize=(8.5, 3.8), layout="constrained")
    methods = [method for method in comparison.methods if method.shown]
    for k, method in enumerate(methods):
        assert method.shown is not None
        style = curves.look(k, len(methods))
        # Runs with other gaps are compared from their impacts on.
        time = _since_touch if several else lambda table: table["time"]
        axes.plot(
            time(method.shown.table),
            values(method.shown.table),
            label=method.name,
            zorder=3,
            **style,
        )
        if len(method.runs) > 1:
            tables = [run.table for run in method.runs]
            first = max(time(table)[0] for table in tables)
            last = min(time(table)[-1] for table in tables)
            common = np.linspace(first, last, 800)
            all_values = [np.interp(common, time(table), values(table)) for table in tables]
            axes.fill_between(
                common,
                np.min(all_values, axis=0),
                np.max(all_values, axis=0),
                color=style["color"],
                alpha=0.16,
                linewidth=0,
            )
    _keep_within(axes)
    unit = curves.plain(comparison.units.get("time", ""))
    axes.set_xlabel(f"time since the impact ({unit})" if several else f"time ({unit})")
    axes.set_ylabel(curves.plain(title))
    curves.legend_below(figure, axes)
    return figure


def _keep_within(axes: Axes) -> None:
    """Limits that show most curves, if a few go far beyond all others; those are named above."""
    largest = {line: float(np.nanmax(np.abs(line.get_ydata()))) for line in axes.lines}
    usual = 8 * float(np.median([*largest.values()]))
    beyond = [line for line, size in largest.items() if size > usual > 0]
    if not beyond:
        return
    inside = np.concatenate([line.get_ydata() for line in largest if line not in beyond])
    low, high = min(float(np.nanmin(inside)), 0.0), max(float(np.nanmax(inside)), 0.0)
    axes.set_ylim(low - 0.25 * (high - low), high + 0.25 * (high - low))
    names = [f"{curves.plain(line.get_label())} goes to {number(largest[line])}" for line in beyond]
    axes.set_title("\n".join(names), fontsize=9, loc="left")


def _spread(comparison: Comparison) -> Figure:
    """Loss of each method: all runs as points, their mean as a bar."""
    column = next(q for q in quantities(comparison) if q.name == "energy lost")
    methods = [method for method in comparison.methods if method.runs]
    figure, axes = plt.subplots(figsize=(8.5, 0.42 * len(methods) + 1.1), layout="constrained")
    for k, method in enumerate(methods):
        values = column.values[method.name]
        colour = curves.COLOURS[k % len(curves.COLOURS)]
        if values:
            axes.plot(values, [k] * len(values), "o", color=colour, markersize=5, alpha=0.7)
            axes.plot([np.mean(values)], [k], "|", color="black", markersize=16)
    axes.axvline(0, color="0.6", linewidth=0.8)
    means = [abs(float(np.mean(v))) for v in column.values.values() if v]
    if max(means) > 30 * np.median(means) > 0:
        axes.set_xscale("symlog", linthresh=max(2 * float(np.median(means)), 1e-12))
    axes.set_yticks(range(len(methods)), [curves.plain(method.name) for method in methods])
    axes.set_ylim(len(methods) - 0.5, -0.5)
    axes.set_xlabel("energy lost (% of the first)")
    return figure


def _table(comparison: Comparison) -> list[str]:
    text = html.escape
    columns = quantities(comparison)
    lines = ['<div class="table"><table><tr><th>method</th>']
    lines += [f"<th>{text(q.title)}</th>" for q in columns]
    lines.append("</tr>")
    for method in comparison.methods:
        lines.append(f"<tr><td>{text(method.name)}")
        notes = [method.problem] if method.runs and method.problem else []
        if method.runs and method.finest and method.finest.error:
            notes.append(f"the finest run: {method.finest.error.sentence}")
        lines += [f"<br><small>{text(note)}</small>" for note in notes]
        lines.append("</td>")
        if not method.runs:
            lines.append(
                f'<td class="refused" colspan="{len(columns)}">{text(method.problem)}</td>'
            )
        else:
            for q in columns:
                values = q.values[method.name]
                shown = number(float(np.mean(values))) if values else "-"
                if len(values) > 1:
                    shown += f"<br><small>{number(min(values))} to {number(max(values))}</small>"
                lines.append(f'<td class="number">{shown}</td>')
        lines.append("</tr>")
    lines.append("</table></div>")
    lines += [f"<p>{text(line)}</p>" for line in orders(comparison)]
    return lines


def write(comparison: Comparison) -> pathlib.Path:
    """Write index.html into the folder of the comparison; return its path."""
    text = html.escape
    settings = [*comparison.settings.items()]
    several = any(len(method.runs) > 1 for method in comparison.methods)
    lines = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>{text(comparison.case.stem)}: methods compared</title>",
        f"<style>{STYLE}</style></head><body>",
        f"<h1>{text(comparison.case.stem)}: {len(comparison.methods)} methods</h1>",
        f"<p>Program <code>{text(comparison.program.name)}</code>, parameter file "
        f"<code>{text(comparison.case.name)}</code>"
        + "".join(f", <code>{text(name)} = {text(value)}</code>" for name, value in settings)
        + ".</p>",
        *_table(comparison),
        "<p>Energy lost: (first energy + work from outside − last energy) / first energy. "
        "Restitution: −(velocity after) / (velocity before) of the centres of mass, along the "
        "normal of contact; of scenes that of summary.json, along the change of the relative "
        "velocity. Largest force: of all contacts together. Contact lasts: all steps at "
        "whose end there is force. Milliseconds: wall time in the steps, "
        + (
            f"with {comparison.jobs} runs at a time sharing the machine. "
            if comparison.jobs > 1
            else "one run at a time. "
        )
        + (
            "Numbers are means over places of the impact within a time step; below them the "
            "smallest and the largest. "
            if several
            else ""
        )
        + (
            "Errors: root of the mean square of the difference from the finest run with the same "
            "method ("
            + ", ".join(f"{text(n)} = {text(v)}" for n, v in comparison.finest.items())
            + "), over the first energy, or over the range of the displacement."
            if comparison.finest
            else ""
        )
        + "</p>",
    ]
    if any(method.runs for method in comparison.methods):
        force = next(
            (u for name, u in comparison.units.items() if name.startswith("contact_force_")), ""
        )
        length = next(
            (u for name, u in comparison.units.items() if name.startswith("penetration_")), ""
        )

        def change(table: Table) -> Array:
            return 100 * measures.change_of_energy(table)

        tables = [run.table for method in comparison.methods for run in method.runs]

        def depth(table: Table) -> Array:
            columns = [table[f"penetration_{name}"] for name in measures.contacts(table)]
            deepest: Array = np.max([np.zeros(len(table)), *columns], axis=0)
            return deepest

        figures: list[tuple[str, Callable[[], Figure]]] = [
            (
                "Energy",
                lambda: _history(
                    comparison, curves.change_label(tables, "change of energy"), change
                ),
            ),
            ("Energy lost", lambda: _spread(comparison)),
            (
                "Contact force",
                lambda: _history(comparison, f"contact force ({force})", measures.contact_force),
            ),
            (
                "Penetration",
                lambda: _history(comparison, f"largest penetration ({length})", depth),
            ),
        ]
        with curves.settings():
            for title, draw in figures:
                lines += [f"<h2>{title}</h2>", _image(draw(), title)]
        if several:
            lines.append(
                "<p>Lines: the impact falls nearest to the middle of a step; bands: the range over "
                "all places.</p>"
            )
    lines.append("</body></html>")
    path = comparison.folder / "index.html"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path
