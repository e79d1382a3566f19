# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many runs as one table: a row for each, and parameters drawn at random."""

from __future__ import annotations

import csv
import pathlib
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import NotARun, Refused, RicochetError
from .programs import (
    Outcome,
    PathLike,
    Task,
    checksum_of_build,
    checksum_of_file,
    checksum_of_inputs,
    program_of_file,
    run_missing,
)

if TYPE_CHECKING:
    import pandas

Range = tuple[float, float] | list[Any]


def samples(ranges: Mapping[str, Range], n: int, seed: int) -> list[dict[str, Any]]:
    """`n` draws of all parameters: of a pair (low, high) one number from each of n equal parts
    of the range (a Latin hypercube), of a list one of its values. The same for the same seed.

    Raises:
        RicochetError: there is nothing to draw from.
    """
    if n < 1 or not ranges:
        raise RicochetError("A dataset needs at least one sample and one range.")
    generator = np.random.default_rng(seed)
    columns: dict[str, list[Any]] = {}
    for name, values in ranges.items():
        if isinstance(values, tuple):
            if len(values) != 2 or not values[0] < values[1]:
                raise RicochetError(f"The range of '{name}' should be (low, high).")
            low, high = map(float, values)
            places = (generator.permutation(n) + generator.random(n)) / n
            columns[name] = [float(value) for value in low + (high - low) * places]
        else:
            if not values:
                raise RicochetError(f"The list of values of '{name}' is empty.")
            columns[name] = [values[k] for k in generator.integers(len(values), size=n)]
    return [{name: column[k] for name, column in columns.items()} for k in range(n)]


def row(overrides: Mapping[str, Any], outcome: Outcome) -> dict[str, Any]:
    """One row for one run: its overrides, `state` (complete, open, refused or failed), and of one
    that was not computed the `reason`, of others their checks, losses and contacts.

    Raises:
        NotARun: the run has no summary, or one without these numbers.
    """
    if outcome.run is None:
        state = "refused" if isinstance(outcome.error, Refused) else "failed"
        reason = outcome.error.sentence if outcome.error else ""
        return {**overrides, "state": state, "reason": reason}
    found: dict[str, Any] = {**overrides, "state": "open" if outcome.run.is_open else "complete"}
    result = outcome.run.result
    try:
        found["commit"] = result.get("commit")
        found["balance_closes"] = result["checks"]["balance"]["closes"]
        # Absent where nothing is promised.
        found["promise_kept"] = result["checks"]["total_energy"].get("kept")
        for part, value in result["energy"]["lost"].items():
            found[f"lost_to_{part}"] = value
        for contact, one in result["contacts"].items():
            for quantity in ("largest_force", "deepest_penetration"):
                found[f"{quantity}_{contact}"] = one[quantity]["value"]
            found[f"time_in_touch_{contact}"] = one["time_in_touch"]
            for direction, value in one.get("impulse", {}).items():
                if direction != "unit":
                    found[f"impulse_{direction}_{contact}"] = value
    except (AttributeError, LookupError, TypeError) as error:
        raise NotARun(f"The summary in '{outcome.run.folder}' is damaged: {error}") from None
    return found


def frame(outcomes: Sequence[Outcome]) -> pandas.DataFrame | list[dict[str, Any]]:
    """One row for each outcome, see `row`: a pandas.DataFrame, or without pandas a list of
    dictionaries."""
    rows = [row(outcome.overrides, outcome) for outcome in outcomes]
    try:
        import pandas
    except ImportError:
        return rows
    return pandas.DataFrame(rows)


def dataset(
    case: PathLike,
    ranges: Mapping[str, Range],
    n: int,
    seed: int,
    output: PathLike | None = None,
    jobs: int | None = None,
    programs: PathLike | None = None,
    progress: Callable[[Outcome, int, int], None] | None = None,
) -> list[dict[str, Any]]:
    """Run a case `n` times with parameters drawn from ranges, and return one row for each sample.

        rows = ricochet.dataset("mine.prm", {"Variables/height": (0.01, 0.1),
                                             "Body ball/Young modulus": (1e5, 1e7)}, n=200, seed=1)
        pandas.DataFrame(rows)

    A row has the hash of program, file and parameters, and what `row` has. The rows are in
    FOLDER/dataset.csv, too, and the run of each sample in FOLDER/HASH. What is complete there is
    not computed again unless the program was built anew, so that a dataset that was stopped goes
    on, and one with a larger `n` of another seed is added to it.

    Args:
        case: a parameter file that names its program.
        ranges: "Section/Name" -> (low, high), or a list of values.
        output: FOLDER; without it output/dataset/CASE.
        jobs: how many run at the same time; without it one for each core.

    Raises:
        RicochetError: the case cannot be read, or a range has nothing to draw from.
    """
    path = pathlib.Path(case)
    program = program_of_file(path, programs)
    folder = pathlib.Path(output) if output else pathlib.Path("output") / "dataset" / path.stem
    all_settings = samples(ranges, n, seed)
    build, contents = checksum_of_build(program), checksum_of_file(path)
    inputs = [checksum_of_inputs(program, contents, settings) for settings in all_settings]
    names = [checksum[:16] for checksum in inputs]
    outcomes = run_missing(
        [
            Task(
                name,
                program,
                path,
                {"Output/Log every": 0, **settings},
                folder / name,
                inputs=build + checksum,
            )
            for name, settings, checksum in zip(names, all_settings, inputs)
        ],
        jobs,
        progress,
    )
    rows = [
        {"hash": name, **row(settings, outcome)}
        for name, settings, outcome in zip(names, all_settings, outcomes)
    ]
    folder.mkdir(parents=True, exist_ok=True)
    _write(rows, folder / "dataset.csv")
    return rows


def _write(rows: Sequence[Mapping[str, Any]], path: pathlib.Path) -> None:
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)
