# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many runs of one case with parameters drawn at random: a table with a hash and the checks of each
sample."""

from __future__ import annotations

import csv
import hashlib
import json
import os
import pathlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import prm
from .errors import BadParameterFile, NotARun, Refused, RicochetError
from .programs import Outcome, PathLike, Task, find_program_of_file, run_tasks
from .results import Run

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


def _hash(contents: bytes, settings: Mapping[str, Any]) -> str:
    text = json.dumps({name: prm.to_text(value) for name, value in sorted(settings.items())})
    return hashlib.sha256(contents + b"\0" + text.encode()).hexdigest()[:16]


def _row(name: str, settings: Mapping[str, Any], state: str, run: Run | None) -> dict[str, Any]:
    row: dict[str, Any] = {"hash": name, **settings, "state": state}
    if run is None:
        return row
    result = run.result
    row["commit"] = result.get("commit")
    row["balance_closes"] = result["checks"]["balance"]["closes"]
    # Absent where nothing is promised.
    row["promise_kept"] = result["checks"]["total_energy"].get("kept")
    for part, value in result["energy"]["lost"].items():
        row[f"lost_to_{part}"] = value
    for contact, found in result["contacts"].items():
        for quantity in ("largest_force", "deepest_penetration"):
            row[f"{quantity}_{contact}"] = found[quantity]["value"]
        row[f"time_in_touch_{contact}"] = found["time_in_touch"]
        for direction, value in found.get("impulse", {}).items():
            if direction != "unit":
                row[f"impulse_{direction}_{contact}"] = value
    return row


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

    A row has the hash of file and parameters, the parameters, `state` (complete, open, refused or
    failed), whether the balance closes and the promise is kept, what was lost to what, and the
    largest force, penetration, time and impulse of each contact; a sample that was not computed has
    the first three. The rows are in FOLDER/dataset.csv, too, and the run of each sample in
    FOLDER/HASH. What is there already is not computed again, so that a dataset that was stopped
    goes on, and one with a larger `n` of another seed is added to it.

    Args:
        case: a parameter file that names its program.
        ranges: "Section/Name" -> (low, high), or a list of values.
        output: FOLDER; without it output/dataset/CASE.
        jobs: how many run at the same time; without it one for each core.

    Raises:
        RicochetError: the case cannot be read, or a range has nothing to draw from.
    """
    path = pathlib.Path(case)
    text = prm.read(path)
    if "Program" not in text.values:
        raise BadParameterFile(f"The parameter file '{path}' does not name its program.")
    program = find_program_of_file(text.values["Program"], programs)
    contents = b"\0".join(pathlib.Path(file).read_bytes() for file in text.files)
    folder = pathlib.Path(output) if output else pathlib.Path("output") / "dataset" / path.stem
    all_settings = samples(ranges, n, seed)
    names = [_hash(contents, settings) for settings in all_settings]

    def known(name: str) -> Run | None:
        try:
            run = Run(folder / name)
            return run if run.result["run"]["state"] == "complete" else None
        except NotARun:
            return None

    runs = {name: known(name) for name in names}
    missing = {
        name: Task(name, program, path, {"Output/Log every": 0, **settings}, folder / name)
        for name, settings in zip(names, all_settings)
        if runs[name] is None
    }
    outcomes = dict(
        zip(missing, run_tasks(list(missing.values()), jobs or os.cpu_count(), progress))
    )
    rows = []
    for name, settings in zip(names, all_settings):
        outcome = outcomes.get(name)
        run = outcome.run if outcome else runs[name]
        if run is not None:
            state = "open" if run.is_open else "complete"
        else:
            state = "refused" if outcome and isinstance(outcome.error, Refused) else "failed"
        rows.append(_row(name, settings, state, run))
    folder.mkdir(parents=True, exist_ok=True)
    _write(rows, folder / "dataset.csv")
    return rows


def _write(rows: Sequence[Mapping[str, Any]], path: pathlib.Path) -> None:
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)
