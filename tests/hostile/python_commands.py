# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 9: the commands in Python with files that others have made or damaged."""

import shutil
import sys

from programs import small

LIMIT = 120.


def changed(rng, data):
    """Some bytes of it are others, or it is cut, or nothing of it is left."""
    data = bytearray(data)
    what = rng.choice(["bytes", "bytes", "cut", "junk", "nothing"])
    if what == "bytes" and data:
        for _ in range(rng.choice([1, 5, 50])):
            data[rng.randrange(len(data))] = rng.randrange(256)
    elif what == "cut":
        del data[rng.randrange(len(data) + 1):]
    elif what == "junk":
        data = bytearray(rng.randbytes(3000))
    else:
        data = bytearray()
    return bytes(data)


def call(case, command, *words):
    """Run a command; it ends with a sentence if not with success, and never with a trace."""
    script = case.context.root / "python" / "bin" / command
    environment = {"RICOCHET_PROGRAMS": str(case.context.programs)}
    result = case.execute([sys.executable, str(script), *map(str, words)],
                          environment=environment, limit=LIMIT)
    case.codes.append(result.code)
    if result.timed_out:
        case.finding("hangs", f"{command}: no end within {result.seconds:.0f} s")
    elif result.code not in (0, 1, 2, 4):
        case.finding("exit code other than 0, 1, 2, 4", f"{command}: {result.code}")
    if "Traceback" in result.err + result.out:
        case.finding("a trace of Python", result.err.strip().splitlines()[-1][:300])
    return result


def plot(case):
    """One file of a run is damaged."""
    settings = dict(small("elastic_ball"), **{"Output/Fields every": "5"})
    run = case.undisturbed("elastic_ball", settings)
    if run is None:
        return
    shutil.copytree(run, case.run_folder)
    file = case.rng.choice(sorted(f for f in case.run_folder.rglob("*") if f.is_file()))
    case.note(f"damaged: {file.name}")
    data = file.read_bytes()
    if file.suffix == ".vtu" and case.rng.random() < .4:
        data = data.replace(b'NumberOfPoints="', b'NumberOfPoints="9999999')
    else:
        data = changed(case.rng, data)
    file.write_bytes(data)
    words = ["--fields"] if case.rng.random() < .3 else []
    call(case, "ricochet-plot", case.run_folder, "-o", case.folder / "plots", *words)


def stranger(case):
    """A parameter file names a program that is none of ours."""
    mark = case.folder / "mark"
    evil = case.write("evil", f"#!/bin/sh\ntouch {mark}\n")
    evil.chmod(0o755)
    name = case.rng.choice([str(evil), "./evil", "bash", "sh", "touch", "../evil", "rm", ""])
    prm = case.write("given.prm", f"set Program = {name}\nsubsection Time\n"
                     "  set Final time = 1\nend\n")
    if case.rng.random() < .3:
        prm = case.write("outer.prm", "include given.prm\n")
    result = call(case, "ricochet-compare", prm, "-o", case.folder / "compared")
    if result.code == 0:
        case.finding("a stranger's program is compared", name)
    if mark.exists():
        case.finding("a stranger's program was run", name)


def parameter_file(case):
    """A parameter file that is damaged."""
    text = (case.context.root / "parameter_files" / "bar_sd" / "default.prm").read_bytes()
    prm = case.write("given.prm", changed(case.rng, b"set Program = bar_sd\n" + text))
    call(case, "ricochet-compare", prm, "--treatments", "penalty", "--set",
         "Time/Final time=0.2", "-o", case.folder / "compared")


SUBKINDS = [plot, plot, stranger, parameter_file]


def run(case):
    subkind = case.rng.choice(SUBKINDS)
    case.note(subkind.__name__)
    subkind(case)
