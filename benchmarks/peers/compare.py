#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Another code beside ours: GetFEM and Ricochet on the same mesh with the same steps.

    benchmarks/peers/compare.py                       1D-SD, 1D-SS, the hard sphere until 8 s
    benchmarks/peers/compare.py sd ss                 the bars only
    benchmarks/peers/compare.py soft --final-time 20  the soft sphere (it takes half an hour)
    benchmarks/peers/compare.py curved                the hard sphere on curved cells

Nitsche's method (theta = 1), Crank-Nicolson, consistent mass. For each case: the differences of the
series, over the size of the series; largest contact force, first touch and lift-off; Newton
iterations; seconds in the steps on one core. Needs the Debian package python3-getfem.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "python"))

import ricochet  # noqa: E402

PYTHON = "/usr/bin/python3"
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
BARS = {
    "sd": ("1D-SD", "bar_sd", "bar_sd/figure_06_nitsche_consistent.prm"),
    "ss": ("1D-SS", "bar_ss", "bar_ss/figure_13_nitsche_consistent.prm"),
}
# Title, the sphere, its parameter file, its mesh, the time until which it is computed (s).
SPHERES = {
    "hard": ("hard sphere", "hard", "sphere/figure_17_nitsche_cn.prm", "sphere_h4", 8),
    "curved": ("hard sphere, curved cells", "hard", "sphere/figure_17_curved.prm",
               "sphere_h4_curved", 8),
    "soft": ("soft sphere", "soft", "sphere/figure_16_nitsche_cn.prm", "sphere_h4", 60),
}


def run_getfem(words):
    """Run a script of GetFEM beside this one; returns the seconds of its steps."""
    result = subprocess.run(
        [PYTHON, *map(str, words)],
        cwd=HERE,
        env={**os.environ, **ONE_THREAD},
        capture_output=True,
        text=True,
    )
    if result.returncode != 0:
        sys.exit(f"{words[0]} failed:\n{result.stderr[-2000:]}")
    return float(result.stdout.rsplit("seconds", 1)[1])


def run_ours(program, file, overrides, build_dir, folder):
    """Run a program of ours; returns its table by names, and the seconds of its steps."""
    command = [str(build_dir / program), str(ROOT / "parameter_files" / file), "--quiet"]
    for override in ("Output/Fields every=0", "Output/Log every=0", *overrides):
        command += ["--set", override]
    exit_code, text = ricochet.programs.execute([*command, "--output-dir", str(folder)])
    if exit_code != 0:
        sys.exit(f"{program} failed:\n{text[-2000:]}")
    run = ricochet.Run(folder)
    return run.table.columns, run.seconds_in_steps


def difference_line(name, theirs, ours):
    size = np.abs(theirs).max()
    error = np.abs(ours - theirs) / size
    return f"| {name} | {size:.4g} | {error.max():.1e} | {np.sqrt(np.mean(error**2)):.1e} |"


def contact_times(time, force):
    """First touch, and the first step without force after it (s)."""
    touching = force > 0
    if not touching.any():
        return "none"
    first = touching.argmax()
    off = touching[first:].argmin()
    end = f"{time[first + off]:g}" if off else "the end"
    return f"{time[first]:g} to {end}"


def compare(case, final_time, build_dir, work):
    output = work / f"{case}.csv"
    if case in BARS:
        title, program, file = BARS[case]
        their_seconds = run_getfem(["getfem_bars.py", case, output])
        ours, our_seconds = run_ours(program, file, (), build_dir, work / case)
    else:
        title, sphere, file, mesh, default = SPHERES[case]
        until = final_time or default
        their_seconds = run_getfem(
            ["getfem_sphere.py", sphere, ROOT / "meshes" / f"{mesh}.msh", until, output]
        )
        overrides = (f"Time/Final time={until}",)
        ours, our_seconds = run_ours("sphere", file, overrides, build_dir, work / case)
        ours["contact_force"] = ours["contact_force_foundation"]
    theirs = np.genfromtxt(output, delimiter=",", names=True)
    print(f"\n{title}\n\n| series | size | largest difference | root mean square |")
    print("|---|---|---|---|")
    for name in theirs.dtype.names:
        if name not in ("time", "newton_iterations"):
            print(difference_line(name, theirs[name], ours[name]))
    print("\n| | GetFEM | Ricochet |\n|---|---|---|")
    if "contact_force" in ours:
        forces = theirs["contact_force"], ours["contact_force"]
        print("| largest force (N) | " + " | ".join(f"{f.max():.4g}" for f in forces) + " |")
        spans = (contact_times(theirs["time"], force) for force in forces)
        print("| touches (s) | " + " | ".join(spans) + " |")
    counts = (table["newton_iterations"].sum() for table in (theirs, ours))
    print("| Newton iterations | " + " | ".join(f"{count:.0f}" for count in counts) + " |")
    print(f"| seconds in the steps | {their_seconds:.3g} | {our_seconds:.3g} |", flush=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    cases = [*BARS, *SPHERES]
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(cases)}")
    parser.add_argument("--build-dir", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--final-time", type=float, help="of the spheres (s)")
    arguments = parser.parse_args()
    unknown = [case for case in arguments.cases if case not in cases]
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(cases)}")
    found = subprocess.run([PYTHON, "-c", "import getfem, scipy"], capture_output=True)
    if found.returncode != 0:
        sys.exit("GetFEM is missing: apt-get install python3-getfem python3-scipy")
    with tempfile.TemporaryDirectory() as work:
        for case in arguments.cases or ("sd", "ss", "hard"):
            compare(case, arguments.final_time, arguments.build_dir, pathlib.Path(work))


if __name__ == "__main__":
    main()
