# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run one case with several methods on all cores, and lay their numbers beside each other.

The case is a parameter file that names its program (`set Program = NAME`). Methods are all
combinations of the treatments and schemes that are given, and of the values of other parameters
(--vary); without them that of the file. A name that the program does not know ends the command
before any run, and so does a parameter that two options choose; a combination that the program
refuses is in the table with the reason. The table is printed, and FOLDER, without -o
output/compare/CASE, has it as index.html with figures, and as table.csv.

The columns:
  energy lost          (first energy + work from outside - last energy) / first energy, or over
                       the largest energy of bodies that begin at rest
  to contact, ...      the parts of it
  restitution          - (velocity after) / (velocity before), along the normal of contact; of
                       scenes that of summary.json, along the change of the relative velocity,
                       for each contact that has one
  largest force        of all contacts together (their sum at a time)
  largest penetration  of any contact
  contact lasts        all steps at whose end there is force
  ms per step          of wall time in the steps, while as many runs as jobs use the machine
  error of ...         root of the mean square of the difference from the finest run with the same
                       method, over the first energy, or over the range of the displacement

Where --vary gives three or more numbers, the last three of which have one ratio, the observed order
of each quantity follows: "none" where the values do not converge in one direction.

With --impact-positions the initial gap is shifted so that the impact falls at N places evenly
spread over a time step, as this position changes the results of a method. The step is that of the
row, also where --vary changes it: for each combination of varied values the impact is found by one
more run. A number is then the mean, and after "±" stands half the distance from the smallest to the
largest. Figures show the run whose impact is nearest to the middle of a step, and the range of all
of them.

In a file with phases --treatments and --schemes are those of the phases that are not static; static
ones keep what the file sets. --set and --vary reach all phases, by "Phase NAME/Section/Name" one.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import itertools
import os
import pathlib
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from . import measures, prm
from .comparison import Comparison, Method, print_table, write_csv
from .errors import ProgramError, Refused, RicochetError
from .names import nearest
from .programs import (
    Outcome,
    Task,
    check_many,
    check_name,
    choices_of,
    parameters_of,
    program_of_file,
    run_tasks,
)
from .results import Run

GAP = "Start/Initial gap"
#: Parameter of the program ricochet: time that its bodies have flown already.
ADVANCE = "Start/Advance"

# Runs of a comparison need no fields for ParaView and no line per step.
QUIET: dict[str, object] = {"Output/Fields every": 0, "Output/Log every": 0}


def _list(text: str) -> list[str]:
    return [part.strip() for part in text.split(",") if part.strip()]


def command_line(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """The options of the command."""
    parser = argparse.ArgumentParser(
        prog="ricochet-compare",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("case", metavar="CASE.prm", type=pathlib.Path)
    parser.add_argument(
        "--treatments", metavar="A,B,...", type=_list, default=[], help="contact treatments"
    )
    parser.add_argument("--schemes", metavar="A,B,...", type=_list, default=[], help="time schemes")
    parser.add_argument(
        "--vary",
        metavar='"Section/Name=a,b,..."',
        action="append",
        default=[],
        help="values of any parameter (between semicolons where they have commas); may be "
        "repeated: all combinations",
    )
    parser.add_argument(
        "--impact-positions",
        metavar="N",
        type=int,
        default=1,
        help=f"so many places of the impact within a time step, by '{GAP}' or '{ADVANCE}'",
    )
    parser.add_argument(
        "--set",
        metavar='"Section/Name=value"',
        action="append",
        default=[],
        dest="settings",
        help="a parameter of all runs; may be repeated. One that a method has no use for is noted "
        "in its log and not refused, except for one of a phase",
    )
    parser.add_argument(
        "--finest",
        metavar='"Section/Name=value"',
        action="append",
        default=[],
        help="what makes a run the finest, say a small Time/Time step; may be repeated",
    )
    parser.add_argument("--jobs", metavar="N", type=int, help="runs at a time (default: cores)")
    parser.add_argument("--programs", metavar="FOLDER", help="folder with the programs")
    parser.add_argument("-o", "--output", metavar="FOLDER", type=pathlib.Path, help="where to")
    options = parser.parse_args(arguments)
    if options.impact_positions < 1:
        parser.error("--impact-positions must be at least 1")
    if options.jobs is not None and options.jobs < 1:
        parser.error("--jobs must be at least 1")
    return options


# Running ------------------------------------------------------------------------------


def _settings(texts: Sequence[str]) -> dict[str, str]:
    """Parameters of the command line. Names of files count from the working folder."""
    values = dict(map(prm.parse_assignment, texts))
    for name, value in values.items():
        if ("/" in value or "." in value) and pathlib.Path(value).is_file():
            values[name] = str(pathlib.Path(value).resolve())
    return values


def variations(texts: Sequence[str]) -> list[dict[str, str]]:
    """All combinations of the values of parameters, each given as "Section/Name=a,b,...".

    Raises:
        RicochetError: a text has another form, or a parameter is there twice.
    """
    names, lists = [], []
    for text in texts:
        name, values = prm.parse_assignment(text)
        parts = [part.strip() for part in values.split(";" if ";" in values else ",")]
        if "" in parts or len(set(parts)) < len(parts):
            raise RicochetError(f"--vary {text}: a value is empty, or there twice.")
        if name in names:
            raise RicochetError(f"--vary {text}: {name} is varied already.")
        names.append(name)
        lists.append(parts)
    return [dict(zip(names, values)) for values in itertools.product(*lists)]


def check_chosen_once(names: Sequence[tuple[str, str]]) -> None:
    """Check that no parameter is chosen by two options, each of (option, parameter): the one would
    win, and rows be headed by the other.

    Raises:
        RicochetError: one is.
    """
    for (option, name), (other, again) in itertools.combinations(names, 2):
        # One that --vary sets in all phases, and another option in one of them, is chosen twice.
        in_all_phases = prm.without_phase(name)
        by_vary = ("--vary", in_all_phases) in ((option, name), (other, again))
        if name == again or (by_vary and in_all_phases == prm.without_phase(again)):
            raise RicochetError(
                f"'{again}' is chosen twice, by {option} and by {other}: leave one of them out."
            )


@dataclass(frozen=True)
class Impact:
    """Time and speed of the impact, from a run of the unchanged file."""

    #: The parameter that shifts it: GAP or ADVANCE.
    parameter: str
    #: Its value in that run (m or s).
    value: float
    speed: float
    time_step: float
    #: Where in its step the impact falls, 0 to 1.
    position: float

    def value_for(self, position: float) -> float:
        """The parameter's value for an impact there; of gaps the nearest positive one."""
        if self.parameter == ADVANCE:
            return self.value + (self.position - position) * self.time_step
        length = self.speed * self.time_step
        gap = self.value + (position - self.position) * length
        while gap <= 0:
            gap += length
        return gap


def find_impact(run: Run, parameter: str, value: float) -> Impact:
    """The impact of a run in which the parameter that shifts it has this value.

    Raises:
        RicochetError: it does not fly towards anything.
    """
    approach = measures.first_approach(run.table)
    if approach is None:
        raise RicochetError(
            f"No impact can be shifted: by '{parameter}' the body must fly for two steps at least "
            "before it touches, and then touch."
        )
    time = run.table["time"]
    step = float(time[1] - time[0])
    return Impact(
        parameter, value, approach.speed, step, (approach.time - float(time[0])) / step % 1.0
    )


def positions(number: int) -> list[float]:
    """Positions within a step: the middles of so many parts of it."""
    return [round((k + 0.5) / number, 6) for k in range(number)]


def check_names(
    program: pathlib.Path, case: pathlib.Path, parameters: Sequence[str], names: Sequence[str]
) -> None:
    """Check that a program knows all names of treatments, or of schemes, and that the file has
    parameters that they are for.

    Raises:
        RicochetError: there is none, or a name is misspelt; the message has the nearest one that is
            known.
    """
    if not names:
        return
    if not parameters:
        raise RicochetError(
            f"No phase of '{case}' is in motion and in contact, and --treatments and --schemes are "
            'for those that are. Static phases are named: --vary "Phase NAME/Section/Name=a,b".'
        )
    parameter = prm.without_phase(parameters[0])
    choices = choices_of(program, case, parameter)
    for name in names:
        if choices and name not in choices:
            raise RicochetError(
                f"There is no {parameter.rpartition('/')[2].lower()} '{name}'. The nearest valid "
                f"name is '{nearest(name, choices)}'; {program.name} knows: {', '.join(choices)}."
            )


def compare(options: argparse.Namespace) -> Comparison:
    """Make all runs of a comparison.

    Raises:
        RicochetError: the case cannot be read or run at all, or a method is misspelt.
    """
    text = prm.read(options.case)
    program = program_of_file(options.case, options.programs)
    settings, finest = _settings(options.settings), _settings(options.finest)
    all_varied = variations(options.vary)
    prm.add(text, settings)
    treatment_names = [f"{section}/Treatment" for section in prm.contact_sections(text)]
    scheme_names = prm.scheme_parameters(text)
    check_names(program, options.case, treatment_names, options.treatments)
    check_names(program, options.case, scheme_names, options.schemes)
    shifted = _shifted_parameter(program, options.case) if options.impact_positions > 1 else None
    by_vary = [("--vary", name) for name in all_varied[0]]
    check_chosen_once(
        [
            *(("--treatments", name) for name in treatment_names if options.treatments),
            *(("--schemes", name) for name in scheme_names if options.schemes),
            *by_vary,
            *(("--set", prm.parse_assignment(each)[0]) for each in options.settings),
        ]
    )
    if shifted:
        check_chosen_once([("--impact-positions", shifted), *by_vary])
    for name, value in {**settings, **finest, **all_varied[0]}.items():
        check_name(program, options.case, name, value)
    folder = options.output or pathlib.Path("output") / "compare" / options.case.stem
    folder.mkdir(parents=True, exist_ok=True)
    # In a file, a parameter without effect is noted; on the command line it is refused.
    case = folder / "compared.prm"
    if case.resolve() == options.case.resolve():
        raise RicochetError(f"'{case}' would be overwritten: name another folder by -o.")
    # A phase is in one file as a whole.
    of_phases = {name: value for name, value in settings.items() if prm.without_phase(name) != name}
    of_file = {name: value for name, value in settings.items() if name not in of_phases}
    case.write_text(prm.write(of_file, include=options.case.resolve()), encoding="utf-8")

    methods = [
        Method(treatment, scheme, dict(varied))
        for treatment, scheme, varied in itertools.product(
            dict.fromkeys(options.treatments or [None]),
            dict.fromkeys(options.schemes or [None]),
            all_varied,
        )
    ]
    jobs = options.jobs or os.cpu_count() or 1

    def progress(outcome: Outcome, done: int, of: int) -> None:
        word = ""
        if outcome.error:
            word = ": refused" if isinstance(outcome.error, Refused) else ": failed"
        print(
            f"  [{done:3}/{of}] {outcome.name}{word}  {outcome.wall_seconds:.1f} s",
            file=sys.stderr,
            flush=True,
        )

    def task(method: Method, name: str, more: dict[str, object]) -> Task:
        number = methods.index(method) + 1
        return Task(
            f"{method.name}{', ' if name else ''}{name}",
            program,
            case,
            {**QUIET, **of_phases, **method.overrides(treatment_names, scheme_names), **more},
            folder / "runs" / f"{number:02}{'-' if name else ''}{name.replace(' ', '_')}",
        )

    #: Positions of the impact, and what shifts it there, for each method.
    gaps: list[list[tuple[float | None, dict[str, object]]]] = [[(None, {})] for _ in methods]
    if shifted:
        value = float(parameters_of(program, case)[shifted])
        impacts = _impacts(shifted, value, methods, task, jobs)
        gaps = [
            [
                (position, {shifted: impact.value_for(position)})
                for position in positions(options.impact_positions)
            ]
            if impact
            else [(None, {})]
            for impact in impacts
        ]
    # A refusal holds for each position: one query suffices.
    if shifted or finest:
        refusals = check_many([task(m, "", each[0][1]) for m, each in zip(methods, gaps)], jobs)
    else:
        refusals = [None] * len(methods)
    tasks, owners, good = [], [], []
    for method, refusal, places in zip(methods, refusals, gaps):
        if refusal:
            method.outcomes.append(Outcome(method.name, {}, None, refusal, 0.0))
            method.positions.append(None)
            print(f"  {method.name}: refused", file=sys.stderr)
            continue
        good.append((method, places))
        for position, more in places:
            name = "" if position is None else f"impact at {position:g}"
            tasks.append(task(method, name, more))
            owners.append(method)
            method.positions.append(position)
    if finest:
        # With the gap of the run that is shown: that nearest to the middle.
        middles = [min(g, key=lambda each: abs((each[0] or 0.5) - 0.5))[1] for _, g in good]
        fine = [task(m, "finest", {**middle, **finest}) for (m, _), middle in zip(good, middles)]
    else:
        fine = []
    # The finest take longest and start first.
    outcomes = run_tasks([*fine, *tasks], jobs, progress)
    for (method, _), outcome in zip(good, outcomes[: len(fine)]):
        method.finest = outcome
    for method, outcome in zip(owners, outcomes[len(fine) :]):
        method.outcomes.append(outcome)
    return Comparison(options.case, program, folder, methods, settings, finest, jobs)


def _shifted_parameter(program: pathlib.Path, case: pathlib.Path) -> str:
    """The parameter by which the impact is shifted.

    Raises:
        RicochetError: the program has none, or the run begins with equilibria.
    """
    text = prm.read(case)
    if prm.phases(text) and prm.is_static(text, prm.phases(text)[0]):
        raise RicochetError(
            "--impact-positions shifts the start of a run, and the first phase of "
            f"'{case}' is static."
        )
    known = parameters_of(program, case)
    parameter = next((name for name in (GAP, ADVANCE) if name in known), None)
    if parameter is None:
        raise RicochetError(
            f"--impact-positions needs a program with the parameter '{GAP}' or '{ADVANCE}', "
            f"which {program.name} has not."
        )
    return parameter


def _impacts(
    parameter: str,
    value: float,
    methods: Sequence[Method],
    task: Callable[[Method, str, dict[str, object]], Task],
    jobs: int,
) -> list[Impact | None]:
    """For each method the impact of the first one with its varied values that runs, as these may
    change the step and the flight; None if none of them runs.

    Raises:
        RicochetError: no method runs at all, or none flies.
    """
    problems: list[ProgramError] = []

    def find(varied: dict[str, str]) -> Impact | None:
        for method in methods:
            if method.varied != varied:
                continue
            outcome = run_tasks([task(method, "as in the file", {})], 1)[0]
            if outcome.run:
                return find_impact(outcome.run, parameter, value)
            if outcome.error:
                problems.append(outcome.error)
        return None

    groups = list({tuple(method.varied.items()): method.varied for method in methods}.values())
    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs) as pool:
        found = list(pool.map(find, groups))
    if not any(found):
        raise RicochetError(f"No method runs: {problems[0].sentence}")
    return [found[groups.index(method.varied)] for method in methods]


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; returns its exit code: 0; 1 if no method runs; 2 with one sentence if the
    case cannot be run at all."""
    options = command_line(arguments)
    try:
        comparison = compare(options)
        print_table(comparison)
        write_csv(comparison, comparison.folder / "table.csv")
        from . import compare_page

        page = compare_page.write(comparison)
        print(f"\nsee {page}")
    except (RicochetError, OSError) as error:
        print(f"ricochet-compare: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    return 0 if any(method.runs for method in comparison.methods) else 1
