# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 7: odd surroundings: locales, names of folders, neighbours."""

import os
import signal
import time

from case import ACCEPTED, ANY, REFUSED, kill_session
from programs import BARS, FILES, RUNS, THROWN, small

LOCALES = ["de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8", "C", "POSIX", "nonsense",
           "tr_TR.UTF-8", "", "x" * 3000]

FOLDERS = ["with space", "it's", 'double"quote', "a" * 200, "größe-Δt-日本",
           "$HOME", "`id`", "a;b", "-dash", "--set", "a\tb", "#hash", "a=b", "%s%n",
           "a\\b", "*", " ", "a/b/c/d", "./x/../y", "\udcff\udcfe", "<&>", "a\nb"]


def reference(case, program):
    settings = small(program)
    settings["Output/Fields every"] = "0"
    return case.undisturbed(program, settings)


def same_results(case, program, folder, result):
    if result.code == 0:
        case.expect_same_ledger(folder, reference(case, program))


def locale(case, program):
    """Numbers are read and written alike everywhere."""
    environment = {"LC_ALL": case.rng.choice(LOCALES),
                   "LANG": case.rng.choice(LOCALES)}
    if case.rng.random() < .5:
        environment["LC_NUMERIC"] = case.rng.choice(LOCALES)
    result = case.attempt(program, small(program), ACCEPTED,
                          environment=environment)
    same_results(case, program, case.run_folder, result)


def folder_name(case, program):
    """Any name of a folder that the system allows; as that of the output, and as
    the working folder."""
    name = case.rng.choice(FOLDERS)
    folder = case.folder / "names" / name
    if case.rng.random() < .5:
        result = case.attempt(program, small(program), ACCEPTED, folder=folder)
    else:
        folder.mkdir(parents=True)
        settings = small(program)
        words = case.command(program, settings, folder="here")
        result = case.execute(words, cwd=folder)
        folder = folder / "here"
        case.judge(result, program, ACCEPTED, folder)
    same_results(case, program, folder, result)


def working_folder(case, program):
    cwd = case.rng.choice(["/", "/proc", "/dev"])
    result = case.attempt(program, small(program), ACCEPTED, cwd=cwd)
    same_results(case, program, case.run_folder, result)


def read_only(case, program):
    """A folder that cannot be written to."""
    if not case.context.can_mount:
        case.note("no file system can be mounted: skipped")
        return
    case.mount(1 << 20, "ro")
    try:
        options = case.rng.choice([[], ["--resume"], ["--overwrite"]])
        case.attempt(program, small(program), REFUSED, options=options)
    finally:
        case.unmount()


def two_at_once(case, program):
    """The second is refused; the first does not notice. The first is halted as
    soon as it has begun, so that it is there for sure when the second comes."""
    settings = dict(small(program), **{"Output/Fields every": "1"})
    first = case.start(case.command(program, settings))
    process = first[0]
    try:
        ledger = case.run_folder / "energy.csv"
        while process.poll() is None and not ledger.exists():
            time.sleep(.001)
        time.sleep(case.rng.choice([0, .001, .01]))
        if process.poll() is not None:
            case.note("the first had ended before the second began")
            return
        os.kill(process.pid, signal.SIGSTOP)
        case.note("halted (SIGSTOP) while the next runs")
        options = case.rng.choice([[], ["--resume"], ["--overwrite"]])
        second = case.execute(case.command(program, settings, options=options))
        was_there = process.poll() is None and is_halted(process.pid)
        if was_there:
            case.judge(second, program, REFUSED)
        os.kill(process.pid, signal.SIGCONT)
        result = case.finish(first)
        case.judge(result, program, ACCEPTED, case.run_folder)
        same_results(case, program, case.run_folder, result)
    finally:
        kill_session(process)
        process.wait()


def is_halted(pid):
    with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as file:
        return file.read().rsplit(")", 1)[1].split()[0] == "T"


def another_file(case, program):
    """The folder holds the run of another parameter file."""
    lines = [f"subsection {name.split('/')[0]}\n  set {name.split('/')[1]} = {value}"
             "\nend\n" for name, value in small(program).items()]
    if program in FILES:
        lines.insert(0, FILES[program].read_text())
    one = case.write("one.prm", "".join(lines))
    two = case.write("two.prm", "".join(lines)
                     + "subsection Newton\n  set Maximum iterations = 35\nend\n")
    case.attempt(program, prm=one, expected=ACCEPTED)
    before = (case.run_folder / "energy.csv").read_bytes()
    case.attempt(program, prm=two, expected=REFUSED)
    if (case.run_folder / "energy.csv").read_bytes() != before:
        case.finding("a run of another file has been overwritten")
    result = case.attempt(program, prm=two, expected=ACCEPTED,
                          options=["--overwrite"])
    same_results(case, program, case.run_folder, result)


def closed_streams(case, program):
    """Files must not be written in place of the closed console."""
    close = case.rng.choice(["<&-", ">&-", "<&- >&-", "2>&-", "<&- >&- 2>&-",
                             ">/dev/full", ">/dev/full 2>/dev/full"])
    words = ["sh", "-c", f'exec "$0" "$@" {close}'] \
        + case.command(program, small(program))
    result = case.execute(words)
    if "2>" in close:
        # Nothing can be said; the exit code and the files must be right.
        if result.code not in (0, 1, 2, 4) or result.timed_out:
            case.finding("exit code other than 0, 1, 2, 4 with closed streams",
                         f"exit code {result.code}")
        case.codes.append(result.code)
    else:
        case.judge(result, program, ANY if "full" in close else ACCEPTED,
                   case.run_folder)
    same_results(case, program, case.run_folder, result)


def odd_variables(case, program):
    """Variables of the environment that are missing or full of nonsense."""
    environment = case.rng.choice([
        {"HOME": ""}, {"HOME": "/nowhere"}, {"TERM": "\x1b"}, {"PWD": "/nowhere"},
        {"OMP_NUM_THREADS": "abc"}, {"DEAL_II_NUM_THREADS": "-1"},
        {"OPENBLAS_NUM_THREADS": "nonsense"}, {"TZ": "x" * 5000},
        {"COLUMNS": "-1"}, {"USER": ""}, {"LANGUAGE": "\udcff"}])
    result = case.attempt(program, small(program), ANY, environment=environment)
    same_results(case, program, case.run_folder, result)


def little_memory(case, program):
    """Whatever the limit is, an end: libraries that cannot be loaded have codes of their
    own, and everything else is one sentence."""
    kilobytes = case.rng.randrange(450000, 1500000)
    words = ["sh", "-c", f'ulimit -v {kilobytes}; unset OPENBLAS_NUM_THREADS; exec "$0" "$@"']
    words += case.command(program, small(program))
    result = case.execute(words)
    begins = "loading shared libraries" in result.err or "map segment" in result.err
    if not begins:
        case.judge(result, program, ANY, case.run_folder)
    elif result.timed_out or result.code == 0:
        case.finding("no end without memory for libraries", f"exit code {result.code}")


def files_of_others(case, program):
    """A folder with files that no run has left: they stay."""
    name = case.rng.choice(["solution/step-000000.vtu", "solution/mine.txt", "energy.csv",
                            "log.txt", "solution.pvd", "notes.txt", "parameters.prm",
                            "checkpoint.bin"])
    file = case.run_folder / name
    file.parent.mkdir(parents=True)
    file.write_text("mine")
    is_ours = name != "notes.txt"
    case.attempt(program, small(program), REFUSED if is_ours else ACCEPTED,
                 options=case.rng.choice([[], ["--resume"]]) if is_ours else [])
    if file.read_text() != "mine":
        case.finding("a stranger's file is lost", name)


def options_at_home(case, _program):
    """Gmsh's files in the user's home make no other mesh."""
    home = case.folder / "home"
    home.mkdir()
    for name in (".gmshrc", ".gmsh-options"):
        (home / name).write_text(case.rng.choice(
            ["Mesh.MeshSizeMax = 0.01;\n", "SystemCall \"touch mark\";\n", "Exit;\n", "(("]))
    case.write("plate.geo", 'SetFactory("OpenCASCADE");\nRectangle(1) = {0, 0, 0, 2, 1};\n')
    prm = case.write("given.prm", "set Program = ricochet\nset Dimension = 2\n"
                     "subsection Body plate\n  set File = plate.geo\n"
                     "  set Mesh size = 0.5\nend\n")
    lines = []
    for environment in ({}, {"HOME": str(home)}):
        result = case.attempt("ricochet", prm=prm, expected=ACCEPTED, is_run=False,
                              options=["--validate"], environment=environment)
        lines.append([line for line in result.out.splitlines() if "cells" in line])
    if lines[0] != lines[1]:
        case.finding("options at home make another mesh", str(lines))
    if list(case.folder.rglob("mark")):
        case.finding("a command was run")


SUBKINDS = [little_memory] * 4 + [files_of_others] * 4 + [options_at_home] + [locale] * 4 + [folder_name] * 4 + [two_at_once] * 3 + [
    working_folder, read_only, another_file, closed_streams, closed_streams,
    odd_variables]


def run(case):
    subkind = case.rng.choice(SUBKINDS)
    case.note(subkind.__name__)
    subkind(case, case.rng.choice(RUNS if subkind is not two_at_once
                                  else BARS + THROWN))
