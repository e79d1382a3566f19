# SPDX-License-Identifier: LGPL-2.1-or-later
"""Methods beside each other on one case: their runs, and the numbers that distinguish them."""

from __future__ import annotations

import csv
import pathlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from . import measures
from .programs import Outcome
from .results import Run


@dataclass
class Method:
    """A contact treatment with a time scheme; None stands for that of the file."""

    treatment: str | None
    scheme: str | None
    #: Other parameters of it, by their names.
    varied: dict[str, str] = field(default_factory=dict)
    #: One for each position of the impact, and of each position (a part of a step).
    outcomes: list[Outcome] = field(default_factory=list)
    positions: list[float | None] = field(default_factory=list)
    finest: Outcome | None = None

    @property
    def name(self) -> str:
        """Name in tables."""
        varied = (f"{name.rpartition('/')[2]} = {value}" for name, value in self.varied.items())
        return ", ".join(filter(None, (self.treatment, self.scheme, *varied))) or "as in the file"

    def overrides(
        self, treatment_names: Sequence[str], scheme_names: Sequence[str]
    ) -> dict[str, object]:
        """The parameters that make it: those of these names have its treatment and its scheme."""
        result: dict[str, object] = {}
        if self.treatment:
            result.update(dict.fromkeys(treatment_names, self.treatment))
        if self.scheme:
            result.update(dict.fromkeys(scheme_names, self.scheme))
        return {**result, **self.varied}

    @property
    def runs(self) -> list[Run]:
        """Runs that ended well."""
        return [outcome.run for outcome in self.outcomes if outcome.run]

    @property
    def problem(self) -> str:
        """Why some run of it did not end well, in one sentence; empty if all did."""
        errors = [outcome.error for outcome in self.outcomes if outcome.error]
        if not errors:
            open_runs = [run for run in self.runs if run.is_open]
            if not open_runs:
                return ""
            lines = "; ".join(dict.fromkeys(line for run in open_runs for line in run.open_lines))
            return f"{len(open_runs)} of {len(self.outcomes)} runs: {lines}"
        count = (
            ""
            if len(errors) == len(self.outcomes)
            else (f"{len(errors)} of {len(self.outcomes)} runs: ")
        )
        return count + errors[0].sentence

    @property
    def shown(self) -> Run | None:
        """The run for the figures: that whose impact is nearest to the middle of a step."""
        good = [
            (abs((position if position is not None else 0.5) - 0.5), number)
            for number, (position, outcome) in enumerate(zip(self.positions, self.outcomes))
            if outcome.run
        ]
        return self.outcomes[min(good)[1]].run if good else None


@dataclass(frozen=True)
class Quantity:
    """A column of the table: the values of a method's runs."""

    name: str
    unit: str
    values: dict[str, list[float]]

    @property
    def title(self) -> str:
        """The name with the unit."""
        return f"{self.name} ({self.unit})" if self.unit not in ("", "1") else self.name


@dataclass
class Comparison:
    """All runs, and their description."""

    case: pathlib.Path
    program: pathlib.Path
    folder: pathlib.Path
    methods: list[Method]
    settings: dict[str, str]
    finest: dict[str, str]
    jobs: int

    @property
    def units(self) -> dict[str, str]:
        """Units of the columns of the energy tables, from the first run that there is."""
        for method in self.methods:
            for run in method.runs:
                return run.units
        return {}


# Numbers ------------------------------------------------------------------------------

#: Quantities that depend on the machine, and those that are round-off.
NOT_COMPARED = (
    "largest balance residual",
    "largest promise residual",
    "Newton iterations",
    "ms per step",
)


def quantities(comparison: Comparison) -> list[Quantity]:
    """The columns of the table, with the values of all runs of each method."""
    units = comparison.units

    def unit(begin: str) -> str:
        return next((text for name, text in units.items() if name.startswith(begin)), "")

    def each(function: Callable[[Run], float | None]) -> dict[str, list[float]]:
        result = {}
        for method in comparison.methods:
            values = [function(run) for run in method.runs]
            result[method.name] = [float(v) for v in values if v is not None and np.isfinite(v)]
        return result

    def ms(run: Run) -> float | None:
        seconds = run.seconds_in_steps or run.wall_seconds
        return 1e3 * seconds / max(len(run.table) - 1, 1) if seconds is not None else None

    def force(run: Run) -> float:
        return float(np.nanmax(measures.contact_force(run.table), initial=0.0))

    def penetration(run: Run) -> float:
        return run.summary().largest_penetration

    def part_lost(what: str) -> Callable[[Run], float]:
        return lambda run: 100 * measures.part_lost(run.table, what)

    def restitution_of(name: str) -> Callable[[Run], float | None]:
        def of_contact(run: Run) -> float | None:
            found = run.summary().contacts
            return found[name].restitution if name in found else None

        return of_contact

    def restitutions() -> list[Quantity]:
        runs = [run for method in comparison.methods for run in method.runs]
        names = {
            name: None
            for run in runs
            for name, contact in run.summary().contacts.items()
            if contact.restitution is not None
        }
        # Several contacts have none that is the run's.
        if len(names) > 1:
            return [Quantity(f"restitution of {n}", "", each(restitution_of(n))) for n in names]
        return [Quantity("restitution", "", each(lambda run: run.summary().restitution))]

    result = [
        Quantity("energy lost", "%", each(lambda run: 100 * measures.energy_lost(run.table))),
        *(
            Quantity(f"to {what}", "%", each(part_lost(what)))
            for what in measures.LOSSES
        ),
        *restitutions(),
        Quantity("largest force", unit("contact_force_"), each(force)),
        Quantity("largest penetration", unit("penetration_"), each(penetration)),
        Quantity("contact lasts", unit("time"), each(lambda run: measures.duration(run.table))),
        Quantity(
            "largest balance residual",
            "",
            each(lambda run: measures.largest_balance_residual(run.table)),
        ),
        Quantity(
            "largest promise residual",
            "",
            each(lambda run: measures.largest_promise_residual(run.table)),
        ),
        Quantity("Newton iterations", "", each(lambda run: run.summary().newton_iterations)),
        Quantity("ms per step", "", each(ms)),
    ]
    if comparison.finest:
        for name, function in (
            ("error of energy", measures.error_of_energy),
            ("error of displacement", measures.error_of_displacement),
        ):
            values: dict[str, list[float]] = {}
            for method in comparison.methods:
                shown = method.shown
                fine = method.finest.run if method.finest else None
                error = function(shown.table, fine.table) if shown and fine else float("nan")
                values[method.name] = [100 * error] if np.isfinite(error) else []
            result.append(Quantity(name, "%", values))
    # A quantity without any value, and a loss that no run has, have no column.
    return [
        q
        for q in result
        if any(q.values.values())
        and not (q.name.startswith("to ") and not any(map(any, q.values.values())))
    ]


def cell(values: Sequence[float]) -> str:
    """The mean of some values, and half their range if there are several."""
    if not values:
        return "-"
    mean, half = float(np.mean(values)), 0.5 * (max(values) - min(values))
    text = number(mean)
    return f"{text} ± {half:.2g}" if len(values) > 1 else text


def number(value: float) -> str:
    """Four digits; a whole number in full."""
    if value == round(value) and abs(value) < 1e6:
        return f"{value:.0f}"
    # Round-off has no digits.
    return f"{value:.1e}" if abs(value) < 1e-9 else f"{value:.4g}"


def rows(comparison: Comparison) -> tuple[list[str], list[list[str]]]:
    """The header of the table and its rows; a method without runs has a sentence only."""
    columns = quantities(comparison)
    header = ["method", *(q.title for q in columns)]
    result = []
    for method in comparison.methods:
        if method.runs:
            result.append([method.name, *(cell(q.values[method.name]) for q in columns)])
        else:
            result.append([method.name, method.problem])
    return header, result


def print_table(comparison: Comparison) -> None:
    """The table on the console."""
    header, lines = rows(comparison)
    whole = [header, *(line for line in lines if len(line) == len(header))]
    widths = [max(len(line[i]) for line in whole) for i in range(len(header))]
    widths[0] = max(len(line[0]) for line in [header, *lines])
    for line in [header, *lines]:
        # A sentence is as wide as it is.
        fitting = widths if len(line) == len(header) else [widths[0], 0]
        print(" | ".join(text.ljust(width) for text, width in zip(line, fitting)).rstrip())
        if line is header:
            print("-+-".join("-" * width for width in widths))
    for method in comparison.methods:
        if method.runs and method.problem:
            print(f"{method.name}: {method.problem}")
        if method.runs and method.finest and method.finest.error:
            print(f"{method.name}, the finest run: {method.finest.error.sentence}")
    for line in orders(comparison):
        print(line)


def write_csv(comparison: Comparison, path: pathlib.Path) -> None:
    """The table with all digits: mean, smallest and largest of each number."""
    columns = quantities(comparison)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(
            ["method", "runs", "problem"]
            + [f"{what} {q.title}" for q in columns for what in ("mean", "smallest", "largest")]
        )
        for method in comparison.methods:
            line: list[object] = [method.name, len(method.runs), method.problem]
            for q in columns:
                values = q.values[method.name]
                line += [np.mean(values), min(values), max(values)] if values else ["", "", ""]
            writer.writerow(line)


# Orders -------------------------------------------------------------------------------

#: Parameters that are numbers of cells or nodes: the mesh is finer where they are larger.
COUNTS = ("Nodes", "Nodes around", "Nodes across", "Boundary nodes", "Cells", "Elements")


def order(sizes: Sequence[float], values: Sequence[float]) -> float | None:
    """The observed order of values at three sizes (of a step, of cells) in one ratio, the finest
    last: log(|q1 - q2| / |q2 - q3|) / log(ratio). None where the values do not converge in one
    direction, or no longer change.
    """
    first, second = values[0] - values[1], values[1] - values[2]
    if abs(second) <= 1e-9 * max(abs(value) for value in values) or first * second <= 0:
        return None
    result = float(np.log(first / second) / np.log(sizes[0] / sizes[1]))
    return result if result > 0 else None


def orders(comparison: Comparison) -> list[str]:
    """Sentences on the observed orders, for each parameter that has three or more numbers as
    values, the last three of which have one ratio.
    """
    lines = []
    columns = [q for q in quantities(comparison) if q.name not in NOT_COMPARED]
    for name in dict.fromkeys(n for method in comparison.methods for n in method.varied):
        groups: dict[tuple[object, ...], list[tuple[float, Method]]] = {}
        for method in comparison.methods:
            try:
                size = float(method.varied[name])
            except ValueError:
                break
            others = tuple((n, v) for n, v in method.varied.items() if n != name)
            groups.setdefault((method.treatment, method.scheme, *others), []).append((size, method))
        for key, group in groups.items():
            # Finer is smaller, of numbers of cells larger.
            is_count = name.rpartition("/")[2] in COUNTS
            last = sorted(group, key=lambda one: one[0], reverse=not is_count)[-3:]
            numbers = [one[0] for one in last]
            if (
                len(last) < 3
                or 0.0 in numbers
                or abs(numbers[0] * numbers[2] / numbers[1] ** 2 - 1.0) > 1e-6
            ):
                continue
            sizes = [1.0 / one for one in numbers] if is_count else numbers
            found = []
            for q in columns:
                values = [q.values[method.name] for _, method in last]
                if not all(values) or values[-1] == [0.0]:
                    continue
                own = order(sizes, [float(np.mean(v)) for v in values])
                found.append(f"{q.name} {'none' if own is None else f'{own:.2g}'}")
            others = ", ".join(
                part if isinstance(part, str) else f"{part[0]} = {part[1]}"
                for part in key
                if part is not None
            )
            lines.append(
                f"Observed orders in {name} ({', '.join(f'{one:g}' for one in numbers)})"
                f"{': ' + others if others else ''}: {', '.join(found)}."
            )
    return lines
