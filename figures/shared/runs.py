# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the programs: their set-up, a single execution, their results."""

import concurrent.futures
import dataclasses
import functools
import hashlib
import json
import os
import threading
import time
import tomllib
from dataclasses import dataclass

import ricochet
from ricochet import RicochetError, prm, programs, read_table

from . import CHECKOUT

OUTPUT = CHECKOUT / "output"

# Overrides of runs for curves, which need no fields for ParaView and no line per
# step.
QUIET = ("Output/Fields every=0", "Output/Log every=0")

# Written after a run has ended well, with all that its result depends on.
STAMP = "finished.json"


@dataclass(frozen=True)
class Run:
    """One run of a program: a curve of a figure, or a point of one.

    `figure` and `curve` name its folder, output/runs/<figure>/<curve>. `cost`
    is a rough time in seconds: the longest runs start first.
    """

    figure: str
    curve: str
    program: str
    parameter_file: str = ""  # in parameter_files/; none: the program's defaults
    overrides: tuple = ()  # "Section/Name=value"
    table: str = "energy.csv"  # the file that proves that the run wrote something
    cost: float = 0.3

    @property
    def name(self):
        return f"{self.figure}/{self.curve}"

    @property
    def folder(self):
        return OUTPUT / "runs" / self.figure / self.curve

    @property
    def results(self):
        """Results of the run, as read by the package."""
        return ricochet.Run(self.folder)

    def field_file(self, step):
        """The VTU file of a step."""
        return self.results.field_file(step).path

    def command(self, build_dir):
        """The command line, with paths relative to the checkout."""
        command = [os.path.relpath(build_dir / self.program, CHECKOUT)]
        if self.parameter_file:
            command.append(f"parameter_files/{self.parameter_file}")
        for override in self.overrides:
            command += ["--set", override]
        command += [
            "--quiet",
            "--overwrite",
            "--output-dir",
            str(self.folder.relative_to(CHECKOUT)),
        ]
        return command

    def read(self, table=None):
        """The columns of a CSV table of the run, by their names without units."""
        return read_table(self.folder / (table or self.table)).columns


def with_overrides(run, *overrides):
    """A run with more overrides, in the same folder: for what is derived from it."""
    return dataclasses.replace(run, overrides=(*run.overrides, *overrides))


@functools.cache
def _checksum(path, _time):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _fingerprint(run, build_dir):
    """All that the result of a run depends on.

    Programs and meshes count by their contents, and parameter files by the values that they
    set: a build or a checkout may write the same anew.
    """
    program = build_dir / run.program
    if not program.is_file():
        raise RicochetError(
            f"There is no program {program}. Build the project, or name the folder "
            "with the programs by --build-dir."
        )
    binaries = [program, *sorted(build_dir.glob("libricochet*"))]
    parameters = hashlib.sha256()
    folder = CHECKOUT
    values = [override.partition("=")[2] for override in run.overrides]
    if run.parameter_file:
        path = CHECKOUT / "parameter_files" / run.parameter_file
        if not path.is_file():
            raise RicochetError(f"There is no parameter file {path}, which {run.name} needs.")
        text = prm.read(path)
        parameters.update(repr(sorted(text.values.items())).encode())
        folder = path.parent
        values += text.values.values()
    # Some values are names of meshes.
    for value in values:
        for file in dict.fromkeys((CHECKOUT / value, folder / value)):
            if file.is_file():
                parameters.update(file.read_bytes())
    return {
        "command": run.command(build_dir),
        "parameters": parameters.hexdigest(),
        "binaries": {path.name: _checksum(path, path.stat().st_mtime_ns) for path in binaries},
    }


def _is_finished(run, fingerprint):
    """Whether the folder of the run holds the end of the same run."""
    try:
        stamp = json.loads((run.folder / STAMP).read_text(encoding="utf-8"))
        size = (run.folder / run.table).stat().st_size
    except (OSError, ValueError):
        return False
    return stamp == {**fingerprint, "size": size}


@functools.cache
def _known_open():
    """The runs whose promises are known to be broken: residual and reason of each."""
    return tomllib.loads((CHECKOUT / "figures" / "open_runs.toml").read_text(encoding="utf-8"))


def _check_promise(run, is_open):
    """An open balance or promise is one that is listed, with its residual and its reason.

    Raises:
        RicochetError: it is not listed, or has another residual, or is listed and not open.
    """
    known = _known_open().get(run.name)
    if known is None and is_open:
        raise RicochetError(
            f"The run {run.name} is open: {'; '.join(run.results.open_lines)}. Mend it, or list "
            "it in figures/open_runs.toml with its residual and the reason."
        )
    if known is None:
        return
    residual = run.results.summary().largest_promise_residual
    if not is_open or not known["residual"] / 3 <= residual <= 3 * known["residual"]:
        raise RicochetError(
            f"The run {run.name} has the promise residual {residual:.2g}, and is listed in "
            f"figures/open_runs.toml with {known['residual']:.2g}."
        )


def _execute(run, build_dir, fingerprint):
    """Run the program; afterwards, and only if all went well, write the stamp."""
    run.folder.mkdir(parents=True, exist_ok=True)
    for stale in (STAMP, run.table):
        (run.folder / stale).unlink(missing_ok=True)
    # One core for each run, as several of them are made at a time.
    exit_code, text = programs.execute(run.command(build_dir), CHECKOUT)
    table = run.folder / run.table
    _check_promise(run, exit_code == programs.OPEN)
    if exit_code not in (0, programs.OPEN) or not table.is_file():
        raise RicochetError(
            f"The run {run.name} failed (exit code {exit_code}):\n"
            f"  {' '.join(run.command(build_dir))}\n{text.strip()[-2000:]}"
        )
    # The fingerprint was taken before the run: if the program was rebuilt
    # meanwhile, the stamp does not fit the new one and the run is repeated.
    stamp = {**fingerprint, "size": table.stat().st_size}
    (run.folder / STAMP).write_text(json.dumps(stamp, indent=1), encoding="utf-8")


def ensure(runs, build_dir, jobs, force=False):
    """Run what is missing or out of date, `jobs` at a time; print progress."""
    runs = list({run.folder: run for run in runs}.values())
    fingerprints = {run: _fingerprint(run, build_dir) for run in runs}
    todo = [run for run in runs if force or not _is_finished(run, fingerprints[run])]
    todo.sort(key=lambda run: -run.cost)
    print(f"{len(runs)} runs, {len(runs) - len(todo)} of them are there already", flush=True)

    done = 0
    lock = threading.Lock()

    def work(run):
        nonlocal done
        start = time.monotonic()
        _execute(run, build_dir, fingerprints[run])
        with lock:
            done += 1
            seconds = time.monotonic() - start
            print(f"  [{done:3}/{len(todo)}] {run.name:<42} {seconds:6.1f} s", flush=True)

    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs) as pool:
        futures = [pool.submit(work, run) for run in todo]
        try:
            for future in concurrent.futures.as_completed(futures):
                future.result()
        except BaseException:
            # Started runs end by themselves; no other one starts.
            for future in futures:
                future.cancel()
            raise
