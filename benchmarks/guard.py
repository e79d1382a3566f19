#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Is a change slower than the commit that it is compared with?

    benchmarks/guard.py --against COMMIT
    benchmarks/guard.py --against-build DIR

Runs eight cases, each of 3 to 15 s, in turns with the programs of the commit and with those
of --build-dir, on one core. COMMIT is built once, in a git worktree in build/guard/. A
case fails if the median of the ratios of its pairs is above the bound, and the exit code is 1
then.

Ratios are those of seconds in the time steps, as the programs' logs have them. On a machine
that is busy with other jobs, --clock cpu compares seconds of the processor in the whole run:
others disturb them less, but they contain the start of the program and the making of the mesh.
"""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import sphere
import spheres
import thrown_bodies
import two_bodies
from measuring import measure

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Case:
    """A program with its parameters, and a parameter file or the text of one."""

    def __init__(self, program, parameters=(), file=None, scene=None):
        self.program, self.parameters = program, list(parameters)
        self.file, self.scene = file, scene

    def run(self, build_dir):
        """Result of measuring.measure() for a run with the programs in @p build_dir."""
        with tempfile.TemporaryDirectory() as folder:
            file = self.file and str(ROOT / self.file)
            if self.scene:
                file = str(pathlib.Path(folder) / "scene.prm")
                pathlib.Path(file).write_text(self.scene, encoding="utf-8")
            return measure(str(build_dir / self.program), self.parameters, file)


def thrown(program, mesh, final_time, extra=()):
    """Improved normal compliance on a mesh of thrown_bodies.py."""
    parameters, meshes, _, _ = thrown_bodies.BODIES[program]
    return Case(program, parameters + dict(thrown_bodies.METHODS)["INC, alpha = 3"] +
                meshes[mesh] + [f"Time/Final time={final_time}", *extra])


CASES = {
    "soft sphere": Case("sphere", file=sphere.WHOLE),
    "ring, INC": thrown("hyperelastic_ring", -1, 1),
    "elastic ball, INC": thrown("elastic_ball", -1, 2, ["Time/Time step=1e-3"]),
    "Saint Venant-Kirchhoff disks": Case(
        "colliding_disks",
        ["Disks/Rings of the left disk=45", "Disks/Rings of the right disk=45"],
        "parameter_files/colliding_disks/default.prm"),
    "linear disks": Case("ricochet", scene=two_bodies.disks(90, n_bodies=2)),
    "two linear spheres": Case("ricochet", ["Time/Final time=8"],
                               scene=two_bodies.spheres(n_bodies=2)),
    "two neo-Hookean spheres": Case("colliding_spheres", spheres.touching(.09)),
    "ring that feels itself": Case(
        "hyperelastic_ring", ["Time/Final time=1.6"],
        "parameter_files/hyperelastic_ring/feels_itself.prm"),
}

CLOCKS = {"steps": "seconds", "cpu": "cpu"}


class Comparison:
    """Pairs of runs of one case: before and now, as measuring.measure() has them."""

    def __init__(self, pairs, clock="steps"):
        self.pairs, self.clock = pairs, CLOCKS[clock]
        ratios = [now[self.clock] / before[self.clock] for before, now in pairs]
        self.ratio, self.range = statistics.median(ratios), (min(ratios), max(ratios))

    def median(self, which, key):
        """Median of a number of the runs before (0) or now (1)."""
        return statistics.median(pair[which][key] for pair in self.pairs)

    def is_slower(self, bound):
        return self.ratio > bound

    def row(self, name, bound):
        def both(key, form):
            return " | ".join(format(self.median(which, key), form) for which in (0, 1))

        low, high = self.range
        return (f"| {name} | {self.median(1, 'unknowns'):.0f} "
                f"| {both(self.clock, '.3g')} | {self.ratio:.2f} ({low:.2f} to {high:.2f}) "
                f"| {both('iterations', '.0f')} | {both('memory', '.0f')} "
                f"| {'SLOWER' if self.is_slower(bound) else ''} |")


HEAD = ("| case | unknowns | s, before | now | ratio (range) | Newton iterations, before | now "
        "| MB, before | now | |\n|---|---|---|---|---|---|---|---|---|---|")


def compare(run, n_pairs, clock="steps"):
    """@p n_pairs pairs of run(0), before, and run(1), now, neither of which always comes
    first."""
    pairs = []
    for number in range(n_pairs):
        order = (0, 1) if number % 2 == 0 else (1, 0)
        result = {which: run(which) for which in order}
        pairs.append((result[0], result[1]))
    return Comparison(pairs, clock)


def judge(names, run, n_pairs, bound, clock="steps"):
    """Print the table of all cases, run(name, which) being one run.

    @return the names of those that are slower
    """
    print(HEAD)
    slower = []
    for name in names:
        comparison = compare(lambda which, name=name: run(name, which), n_pairs, clock)
        print(comparison.row(name, bound), flush=True)
        if comparison.is_slower(bound):
            slower.append(name)
    return slower


def build_of(commit, programs):
    """The folder of a release build of @p commit, made if it is not there."""
    sha = subprocess.run(["git", "rev-parse", "--verify", "--quiet", commit + "^{commit}"],
                         cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()
    if not sha:
        sys.exit(f"guard.py: git knows no commit {commit}.")
    folder = ROOT / "build" / "guard" / sha[:12]
    if not (folder / "source").is_dir():
        subprocess.run(["git", "worktree", "prune"], cwd=ROOT, check=True)
        subprocess.run(["git", "worktree", "add", "--detach", folder / "source", sha],
                       cwd=ROOT, check=True)
    # A form for commits without presets, too.
    subprocess.run(["cmake", "-S", folder / "source", "-B", folder / "build", "-G", "Ninja",
                    "-DCMAKE_BUILD_TYPE=Release", "-DRICOCHET_UNITY=ON",
                    "-DPython3_EXECUTABLE=/usr/bin/python3"],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", folder / "build", *programs], check=True)
    return folder / "build"


def positive(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("has to be at least 1")
    return number


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    against = parser.add_mutually_exclusive_group(required=True)
    against.add_argument("--against", metavar="COMMIT")
    against.add_argument("--against-build", metavar="DIR", type=pathlib.Path)
    parser.add_argument("--build-dir", default=ROOT / "build" / "release", type=pathlib.Path)
    parser.add_argument("--pairs", default=5, type=positive)
    parser.add_argument("--bound", default=1.25, type=float, help="default: 1.25")
    parser.add_argument("--clock", default="steps", choices=CLOCKS)
    parser.add_argument("--only", action="append", choices=CASES, metavar="CASE",
                        help="may be repeated; one of: " + ", ".join(CASES))
    arguments = parser.parse_args()
    names = arguments.only or list(CASES)
    programs = sorted({CASES[name].program for name in names})
    builds = (arguments.against_build or build_of(arguments.against, programs),
              arguments.build_dir)
    for build in builds:
        for program in programs:
            if not (build / program).is_file():
                sys.exit(f"guard.py: there is no program {build / program}.")
    # All runs are on one core, that with the largest number: the first ones serve interrupts.
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    try:
        slower = judge(names, lambda name, which: CASES[name].run(builds[which].resolve()),
                       arguments.pairs, arguments.bound, arguments.clock)
    except subprocess.CalledProcessError as error:
        sys.exit(f"guard.py: a run failed: {' '.join(map(str, error.cmd))}\n{error.stderr}")
    if slower:
        print(f"guard.py: slower than {arguments.bound:g} times what it was: "
              f"{', '.join(slower)}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
