#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hostile but reproducible input for all programs.

    hostile.py --programs build/release                 # 2000 inputs, 300 kills
    hostile.py --programs build/release --case meshes:17

Each case is held to the contract of contract.py: exit code 0, 1, 2 or 4, in time, a
short report in words, and after success results that are whole. Findings are
listed with the command that shows them; their files are kept.
"""

import argparse
import importlib
import pathlib
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True

from case import Case, Context  # noqa: E402

# Kinds of input, the modules that make them, and their parts of --inputs.
KINDS = {
    "parameter-files": ("parameter_files", .20),
    "command-lines": ("command_lines", .15),
    "combinations": ("combinations", .10),
    "meshes": ("meshes", .10),
    "scenes": ("scenes", .23),
    "scene-meshes": ("scene_meshes", .06),
    "damaged-folders": ("damaged_folders", .06),
    "full-disk": ("full_disk", .05),
    "environments": ("environments", .04),
    "python-commands": ("python_commands", .03),
    "kills": ("kills", None),
}


def shares(n_inputs, n_kills):
    """How many cases of each kind."""
    numbers = {kind: int(n_inputs * share) if share is not None else n_kills
               for kind, (_, share) in KINDS.items()}
    numbers["parameter-files"] += n_inputs - sum(
        n for kind, n in numbers.items() if kind != "kills")
    return numbers


def run_case(context, kind, number):
    """One case; a mistake of the harness itself is a finding, too."""
    case = Case(context, kind, number)
    try:
        importlib.import_module(KINDS[kind][0]).run(case)
    except Exception:  # pylint: disable=broad-except
        case.finding("the harness failed", traceback.format_exc())
    case.close(keep=context.verbose)
    return case


def run_kind(context, kind, n_cases, n_jobs):
    """All cases of a kind, and its line."""
    began = time.monotonic()
    with ThreadPoolExecutor(n_jobs) as pool:
        cases = list(pool.map(lambda k: run_case(context, kind, k),
                              range(n_cases)))
    codes = [code for case in cases for code in case.codes]
    bad = [case for case in cases if case.findings]
    print(f"{kind:16} {n_cases:5} cases: "
          f"{codes.count(1):5} refused with 1, {codes.count(2):4} failed with 2, "
          f"{codes.count(0):5} succeeded, "
          f"{sum(code not in (0, 1, 2, 4) for code in codes):4} otherwise; "
          f"{len(bad):4} with findings; {time.monotonic() - began:.0f} s",
          flush=True)
    return bad


def print_findings(context, cases):
    """All findings, those of a sort together."""
    sorts = defaultdict(list)
    for case in cases:
        for sort, detail, command in case.findings:
            sorts[sort].append((case, detail, command))
    print("\nTo repeat a case: hostile.py --programs "
          f"{context.programs} --seed {context.seed} --case KIND:NUMBER\n"
          "or the commands.sh in its folder, which sets the environment.")
    for sort, findings in sorted(sorts.items(), key=lambda s: -len(s[1])):
        print(f"\n== {sort}: {len(findings)}")
        for case, detail, command in findings:
            print(f"{case.name}  {detail.strip()}\n    {case.folder}\n"
                  f"    {command[:1500]}")


def one_case(context, name):
    kind, number = name.rsplit(":", 1)
    case = run_case(context, kind, int(number))
    print(f"\n{case.name}: exit codes {case.codes}; files in {case.folder}")
    for sort, detail, command in case.findings:
        print(f"FINDING {sort}: {detail}\n    {command[:3000]}")
    return 1 if case.findings else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--programs", required=True,
                        help="folder of the built programs")
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--inputs", type=int, default=2000)
    parser.add_argument("--kills", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", choices=KINDS, help="this kind only")
    parser.add_argument("--case", metavar="KIND:NUMBER",
                        help="this case only, with all that it prints")
    arguments = parser.parse_args()
    # A shell lets what it starts in the background ignore this signal, and so would the
    # programs that cases send it to.
    signal.signal(signal.SIGINT, signal.default_int_handler)

    work = pathlib.Path(tempfile.mkdtemp(prefix="hostile-"))
    context = Context(arguments.programs, arguments.mpiexec, arguments.seed, work,
                      verbose=arguments.case is not None)
    if arguments.case:
        return one_case(context, arguments.case)
    if not context.can_mount:
        print("No file systems can be mounted here: cases that need one are run "
              "with limits to the size of files instead.")

    numbers = shares(arguments.inputs, arguments.kills)
    if arguments.only:
        numbers = {arguments.only: numbers[arguments.only]}
    bad = []
    for kind, n_cases in numbers.items():
        if n_cases > 0:
            bad += run_kind(context, kind, n_cases, arguments.jobs)
    if bad:
        print_findings(context, bad)
    n_findings = sum(len(case.findings) for case in bad)
    n_kills = numbers.pop("kills", 0)
    print(f"\nhostile: {sum(numbers.values())} inputs, {n_kills} kills, "
          f"{n_findings} findings" + (f", kept in {work}" if bad else ""))
    if not bad:
        shutil.rmtree(work)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
