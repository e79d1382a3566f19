# SPDX-License-Identifier: LGPL-2.1-or-later
"""Running the programs: one of them, or several on all cores."""

from __future__ import annotations

import concurrent.futures
import hashlib
import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from . import files, prm
from .errors import (
    BadParameterFile,
    Failed,
    OpenRun,
    ProgramError,
    Refused,
    RicochetError,
)
from .names import NoSuchName, nearest, no_such
from .results import WORD, Run

#: Where the programs of a checkout are built.
BUILD = pathlib.Path(__file__).resolve().parents[2] / "build" / "release"

#: The programs that a parameter file may name.
NAMES = (
    "ricochet",
    "bar_sd",
    "bar_by_hand",
    "bar_ss",
    "elastic_ball",
    "disk_step_by_step",
    "hyperelastic_ring",
    "sphere",
    "stent_artery",
    "sliding_block",
    "obstacle_course",
    "colliding_disks",
    "colliding_spheres",
    "colliding_tori",
)

#: The environment of one of several runs at a time: one core for each.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1"}

#: A file in the folder of a run that is complete: the checksum of what went in and of summary.json.
MARK = "inputs.sha256"

#: The exit code of a run that is complete, but whose balance or promise is violated.
OPEN = 4

PathLike = str | os.PathLike[str]
Overrides = Mapping[str, object]


def find_program(program: PathLike, programs: PathLike | None = None) -> pathlib.Path:
    """The file of a program: a path as it is, a name from a folder.

    The folder is `programs`, or else that which the environment variable RICOCHET_PROGRAMS
    names, or build/release of the checkout; those of Ricochet are found in the PATH, too.

    Raises:
        RicochetError: there is no such program.
    """
    if os.sep in str(program):
        path = pathlib.Path(program)
        if not path.is_file():
            raise RicochetError(f"There is no program '{path}'.")
        return path.resolve()
    named = programs or os.environ.get("RICOCHET_PROGRAMS")
    path = pathlib.Path(named or BUILD) / program
    if path.is_file():
        return path.resolve()
    # A name may come from a stranger's run.txt, and the PATH has programs of all kinds.
    in_path = shutil.which(str(program)) if not named and str(program) in NAMES else None
    if in_path:
        return pathlib.Path(in_path)
    if str(program) not in NAMES:
        raise RicochetError(
            f"There is no program '{path}'. Is '{nearest(str(program), NAMES)}' meant?"
        )
    raise RicochetError(
        f"There is no program '{path}'. Build the project, or name the folder with the programs."
    )


def find_program_of_file(name: str, programs: PathLike | None = None) -> pathlib.Path:
    """The file of the program that a parameter file names, which may be a stranger's: a
    program of Ricochet, or one that lies in the folder that the user has named.

    Raises:
        RicochetError: there is no such program, or the name is none.
    """
    if name not in NAMES and (programs is None or not re.fullmatch(WORD, name)):
        raise RicochetError(
            f"'{name[:60]}' is no program of Ricochet; those are {', '.join(NAMES)}. One of your "
            "own is named by a word, and its folder by --programs."
        )
    return find_program(name, programs)


def program_of_file(parameter_file: PathLike, programs: PathLike | None = None) -> pathlib.Path:
    """The file of the program that a parameter file names, see `find_program_of_file`.

    Raises:
        BadParameterFile: it cannot be read, or names none.
        RicochetError: there is no such program.
    """
    text = prm.read(parameter_file)
    if "Program" not in text.values:
        raise BadParameterFile(
            f"The parameter file '{parameter_file}' does not name its program: it needs a line "
            "'set Program = NAME'."
        )
    return find_program_of_file(text.values["Program"], programs)


def _program_and_file(
    program_or_path: PathLike,
    parameter_file: PathLike | None,
    programs: PathLike | None,
) -> tuple[pathlib.Path, PathLike | None]:
    """The file of a program, and the parameter file; of a parameter file alone the program is that
    which it names.

    Raises:
        RicochetError: there is no such program, or words are at other places.
    """
    is_file = str(program_or_path).endswith(".prm")
    if isinstance(parameter_file, Mapping):
        raise RicochetError(
            f"Overrides stand behind the parameter file, or have their name: '{program_or_path}', "
            "overrides={...}."
        )
    if is_file and parameter_file is not None:
        raise RicochetError(
            f"'{program_or_path}' is a parameter file: it stands alone, or behind the name of a "
            "program."
        )
    if is_file:
        return program_of_file(program_or_path, programs), program_or_path
    return find_program(program_or_path, programs), parameter_file


def _settings(overrides: Overrides | None) -> list[str]:
    """The overrides as options of the command line."""
    words = []
    for name, value in (overrides or {}).items():
        words += ["--set", f"{name}={prm.to_text(value)}"]
    return words


def execute(command: Sequence[str], cwd: PathLike | None = None) -> tuple[int, str]:
    """Run a command with one thread. Returns its exit code and what it said, also as errors.

    Raises:
        RicochetError: it cannot be started.
    """
    try:
        process = subprocess.Popen(
            command,
            cwd=cwd,
            env={**os.environ, **ONE_THREAD},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        )
    except OSError as error:
        raise RicochetError(f"'{command[0]}' cannot be run: {error.strerror}.") from None
    try:
        text, _ = process.communicate()
    except KeyboardInterrupt:
        # The program has got it, too, finishes its step and writes a checkpoint.
        process.wait()
        raise
    return process.returncode, text


def _check(name: str, exit_code: int, text: str) -> None:
    """Raises: Refused or Failed, if the exit code says so."""
    # mpirun has this exit code too, for reasons of its own.
    if exit_code == 1 and "the input is not valid." in text:
        raise Refused(name, exit_code, text)
    if exit_code not in (0, OPEN):
        raise Failed(name, exit_code, text)


def default_output(
    program: str, parameter_file: PathLike | None, overrides: Overrides | None = None
) -> pathlib.Path:
    """The default folder of a program: `Output/Folder`, or output/PROGRAM/FILE."""
    folder = str((overrides or {}).get("Output/Folder", ""))
    if not folder and parameter_file:
        folder = prm.read(parameter_file).values.get("Output/Folder", "")
    stem = pathlib.Path(parameter_file).stem if parameter_file else "without_file"
    return pathlib.Path(folder) if folder else pathlib.Path("output") / program / stem


def run(
    program_or_path: PathLike,
    parameter_file: PathLike | None = None,
    overrides: Overrides | None = None,
    output: PathLike | None = None,
    ranks: int = 1,
    programs: PathLike | None = None,
    *,
    overwrite: bool = False,
    mpiexec: str = "mpirun",
) -> Run:
    """Run a program to its end; the result knows how long that took (`wall_seconds`).

        ricochet.run("bar_sd", overrides={"Time/Scheme": "TR-BDF2", "Time/Time step": 0.01})
        ricochet.run("mine.prm", overrides={"Time/Time step": 0.01})

    Args:
        program_or_path: its name, see `find_program`, or the path of it; or a parameter file
            (`.prm`) alone, which names its program.
        parameter_file: none for the program's defaults.
        overrides: "Section/Name" -> value.
        output: the folder to write to; without it the program's default, output/PROGRAM/FILE.
        ranks: how many MPI ranks.
        programs: the folder with the programs.
        overwrite: replace the run of another parameter file in that folder.
        mpiexec: the command that starts several ranks.

    Raises:
        Refused: the program refused its input.
        Failed: the computation failed.
        RicochetError: the program is missing or cannot be started.

    Warns:
        OpenRun: the balance of energy does not close, or a promise is broken; `is_open` of the
            run says so too.
    """
    program, parameter_file = _program_and_file(program_or_path, parameter_file, programs)
    folder = (
        pathlib.Path(output)
        if output is not None
        else default_output(program.name, parameter_file, overrides)
    )
    command = [mpiexec, "-n", str(ranks)] if ranks > 1 else []
    command.append(str(program))
    if parameter_file is not None:
        command.append(str(parameter_file))
    command += [*_settings(overrides), "--output-dir", str(folder), "--quiet"]
    if overwrite:
        command.append("--overwrite")
    begin = time.monotonic()
    exit_code, text = execute(command)
    seconds = time.monotonic() - begin
    _check(program.name, exit_code, text)
    result = Run(folder)
    result.wall_seconds = seconds
    if exit_code == OPEN:
        warnings.warn(f"{folder}: {'; '.join(result.open_lines)}", OpenRun, stacklevel=2)
    return result


def parameters_of(
    program_or_path: PathLike,
    parameter_file: PathLike | None = None,
    overrides: Overrides | None = None,
    programs: PathLike | None = None,
) -> dict[str, str]:
    """All parameters that a run would have, without running it: "Section/Name" -> value.

    The arguments are those of `run`. Of a run in phases they are those of the last phase, and
    others that an earlier one has.

    Raises:
        Refused: there is a parameter or a value that the program does not know.
        RicochetError: the program is missing or cannot be started.
    """
    program, parameter_file = _program_and_file(program_or_path, parameter_file, programs)
    command = [str(program), *([str(parameter_file)] if parameter_file else [])]
    exit_code, text = execute([*command, *_settings(overrides), "--print-parameters"])
    _check(program.name, exit_code, text)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "parameters.prm"
        file.write_text(text, encoding="utf-8")
        return prm.read(file).values


def choices_of(program: pathlib.Path, parameter_file: PathLike | None, name: str) -> list[str]:
    """The values that a parameter may have, as the program prints them.

    Empty if it is no choice, or if the file is refused.

    Raises:
        RicochetError: the program cannot be started.
    """
    command = [str(program), *([str(parameter_file)] if parameter_file else [])]
    _, text = execute([*command, "--print-parameters"])
    match = re.search(rf"^#   {re.escape(name)}: Any one of (.+)$", text, re.MULTILINE)
    return [choice.strip() for choice in match.group(1).split(",")] if match else []


def check_name(
    program: pathlib.Path, parameter_file: PathLike, name: str, value: object
) -> None:
    """Check that a program knows a parameter; whether it takes the value is seen in the run.

    Raises:
        NoSuchName: it does not; the message has the nearest one that it knows.
        RicochetError: the program cannot be started.
    """
    phase, _, rest = name.partition("/")
    known = prm.phases(prm.read(parameter_file))
    if rest and phase.startswith("Phase ") and phase not in known:
        raise no_such("section", phase, known)
    command = [str(program), str(parameter_file), *_settings({name: value})]
    _, text = execute([*command, "--list", "--json"])
    try:
        refusal, _ = json.JSONDecoder().raw_decode(text[text.index("{") :])
        is_unknown = refusal["code"] == "unknown_parameter"
        key, nearest_names = refusal["key"], refusal["nearest"]
    except (LookupError, TypeError, ValueError):
        # It knows all names, and lists them.
        return
    if is_unknown and key == prm.without_phase(name):
        begin = name.removesuffix(key)
        raise NoSuchName(
            f"There is no parameter '{name}'."
            + (f" Is '{begin}{nearest_names[0]}' meant?" if nearest_names else "")
        )


@dataclass(frozen=True)
class Task:
    """A run to be made; the arguments are those of `run`."""

    name: str
    program: pathlib.Path
    parameter_file: pathlib.Path | None
    overrides: dict[str, object]
    output: pathlib.Path
    ranks: int = 1
    #: Checksum of what goes in; see `run_missing`.
    inputs: str = ""


def check_many(tasks: Sequence[Task], jobs: int | None = None) -> list[ProgramError | None]:
    """Let the programs check the parameters of some runs, without running them.

    For each task the reason why it is refused, or None.
    """

    def work(task: Task) -> ProgramError | None:
        command = [str(task.program), *([str(task.parameter_file)] if task.parameter_file else [])]
        try:
            code_and_text = execute([*command, *_settings(task.overrides), "--validate"])
            _check(task.program.name, *code_and_text)
        except ProgramError as error:
            return error
        return None

    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs or os.cpu_count() or 1) as pool:
        return list(pool.map(work, tasks))


@dataclass(frozen=True)
class Outcome:
    """Outcome of one run of several."""

    name: str
    overrides: dict[str, object]
    #: None if it was refused or failed.
    run: Run | None
    #: Why, if it was.
    error: ProgramError | None
    #: How long it took (s), also if that was earlier.
    wall_seconds: float


def run_tasks(
    tasks: Sequence[Task],
    jobs: int | None = None,
    progress: Callable[[Outcome, int, int], None] | None = None,
) -> list[Outcome]:
    """Make runs, `jobs` at a time (all cores without it), each with one thread per process.

    A run that is refused or fails does not stop the others. `progress` is called after each
    with what came of it, and how many are done of how many. Outcomes are in the order of tasks.
    """

    def work(task: Task) -> Outcome:
        begin = time.monotonic()
        result, problem = None, None
        try:
            result = run(
                task.program,
                task.parameter_file,
                task.overrides,
                task.output,
                task.ranks,
                overwrite=True,
            )
        except ProgramError as error:
            problem = error
        seconds = time.monotonic() - begin
        return Outcome(task.name, task.overrides, result, problem, seconds)

    workers = jobs or os.cpu_count() or 1
    with concurrent.futures.ThreadPoolExecutor(max_workers=workers) as pool:
        futures = [pool.submit(work, task) for task in tasks]
        try:
            for done, future in enumerate(concurrent.futures.as_completed(futures), start=1):
                outcome = future.result()
                if progress:
                    progress(outcome, done, len(tasks))
        except BaseException:
            # Started runs end by themselves; no other one starts.
            for future in futures:
                future.cancel()
            raise
    return [future.result() for future in futures]


# Runs of an earlier time -----------------------------------------------------------------


def _contents_named_by(value: str, folder: pathlib.Path) -> bytes:
    """The contents of the file that a value names, or of the state of the run that it names."""
    for path in (folder / value, folder / value / "checkpoint.bin") if value else ():
        try:
            return files.read_bytes(path, None)
        except (OSError, ValueError):
            continue
    return b""


def checksum_of_build(program: pathlib.Path) -> str:
    """The checksum of a program and of Ricochet's library that it loads."""
    _, text = execute(["ldd", str(program)])
    paths = [program, *map(pathlib.Path, re.findall(r"libricochet\S* => (\S+)", text))]
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()


def checksum_of_file(parameter_file: pathlib.Path | None) -> str:
    """The checksum of a parameter file, of all that it includes, and of the files that its
    parameters name. What a geometry or a mesh includes is not seen.

    Raises:
        BadParameterFile: it cannot be read.
    """
    if parameter_file is None:
        return ""
    text = prm.read(parameter_file)
    checksum = hashlib.sha256(b"\0".join(text.contents))
    for folder in dict.fromkeys(file.parent for file in text.files):
        for value in text.values.values():
            checksum.update(_contents_named_by(value, folder))
    return checksum.hexdigest()


def checksum_of_inputs(program: pathlib.Path, file: str, overrides: Overrides) -> str:
    """The checksum of what is computed: the name of the program, the checksum of the file, and the
    overrides with the files that they name."""
    values = {name: prm.to_text(value) for name, value in sorted(overrides.items())}
    checksum = hashlib.sha256(json.dumps([program.name, file, values]).encode())
    for value in values.values():
        checksum.update(_contents_named_by(value, pathlib.Path()))
    return checksum.hexdigest()


def _mark(task: Task) -> str:
    """The contents of MARK; another run in the folder has another summary.

    Raises:
        OSError: there is no summary.
    """
    summary = (task.output / "summary.json").read_bytes()
    return hashlib.sha256(task.inputs.encode() + summary).hexdigest()


def complete_run(task: Task) -> Run | None:
    """The run in the folder of a task, if it is complete and had the same inputs."""
    try:
        if files.read_text(task.output / MARK) != _mark(task):
            return None
        result = Run(task.output)
        result.wall_seconds = float(result.result["run"]["wall_seconds"])
    except (RicochetError, OSError, ValueError, TypeError):
        return None
    return result


def run_missing(
    tasks: Sequence[Task],
    jobs: int | None = None,
    progress: Callable[[Outcome, int, int], None] | None = None,
) -> list[Outcome]:
    """Make the runs that are not complete in their folders already, as `run_tasks`; of the others
    the outcome is read. `progress` is called for those that are made."""
    known = {task.output: complete_run(task) for task in tasks}
    missing = {task.output: task for task in tasks if known[task.output] is None}

    def finish(outcome: Outcome, done: int, of: int) -> None:
        if outcome.run:
            folder = outcome.run.folder
            (folder / MARK).write_text(_mark(missing[folder]), encoding="utf-8")
        if progress:
            progress(outcome, done, of)

    made = dict(zip(missing, run_tasks(list(missing.values()), jobs, finish)))

    def outcome_of(task: Task) -> Outcome:
        found = known[task.output]
        if found is None:
            return made[task.output]
        return Outcome(task.name, task.overrides, found, None, found.wall_seconds or 0.0)

    return [outcome_of(task) for task in tasks]


def sweep(
    program_or_path: PathLike,
    parameter_file: PathLike | None = None,
    overrides: Mapping[str, Sequence[object]] | Iterable[Overrides] = (),
    output: PathLike | None = None,
    jobs: int | None = None,
    programs: PathLike | None = None,
    *,
    common: Overrides | None = None,
    ranks: int = 1,
    progress: Callable[[Outcome, int, int], None] | None = None,
) -> list[Outcome]:
    """Several runs of one program, as many at a time as there are cores.

        outcomes = ricochet.sweep("bar_sd", overrides={"Time/Time step": [0.1, 0.05],
                                                       "Contact/Treatment": ["Nitsche", "penalty"]})
        for outcome in outcomes:
            print(outcome.name, outcome.wall_seconds, outcome.run and outcome.run.summary())
        ricochet.frame(outcomes)  # one row for each run

    Args:
        overrides: lists of values, of which all combinations are run, or a list of overrides,
            one for each run.
        output: the folder in which each run has one of its own; without it
            output/PROGRAM/FILE-sweep. Runs that are complete there and had the same program,
            contents of files and overrides are not computed again; others are overwritten.
        jobs: how many run at the same time; without it one for each core (less with `ranks`).
        common: overrides of all runs.
        progress: see `run_missing`.

    The other arguments are those of `run`. A run that is refused or fails has its `error` in
    its outcome; the others go on.
    """
    program, parameter_file = _program_and_file(program_or_path, parameter_file, programs)
    variations: list[dict[str, Any]]
    if isinstance(overrides, Mapping):
        names = list(overrides)
        variations = [dict(zip(names, values)) for values in itertools.product(*overrides.values())]
    else:
        variations = [dict(each) for each in overrides]
    if not variations:
        raise RicochetError("A sweep needs at least one set of overrides.")
    if output is None:
        folder = default_output(program.name, parameter_file, common)
        folder = folder.parent / f"{folder.name}-sweep"
    else:
        folder = pathlib.Path(output)
    file = pathlib.Path(parameter_file) if parameter_file is not None else None
    if file is not None and not file.is_file():
        raise BadParameterFile(f"There is no parameter file '{file}'.")
    build, contents = checksum_of_build(program), checksum_of_file(file)
    digits = len(str(len(variations)))
    tasks = [
        Task(
            ", ".join(f"{name}={prm.to_text(value)}" for name, value in each.items()),
            program,
            file,
            {**(common or {}), **each},
            folder / f"{number:0{digits}}",
            ranks,
            build + checksum_of_inputs(program, contents, {**(common or {}), **each}),
        )
        for number, each in enumerate(variations, start=1)
    ]
    if jobs is None:
        jobs = max(1, (os.cpu_count() or 1) // ranks)
    return run_missing(tasks, jobs, progress)
