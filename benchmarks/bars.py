#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Start-up and time steps of the bars, in seconds.

A run over one step costs the start-up; a run over the whole time costs the
steps in addition. The difference of medians over several pairs is the time of the steps.
"""

import argparse
import pathlib
import statistics
import subprocess
import tempfile
import time

CASES = [
    ("1D-SD, Nitsche, Crank-Nicolson", "bar_sd", []),
    ("1D-SD, Nitsche, TR-BDF2", "bar_sd", ["Time/Scheme=TR-BDF2"]),
    ("1D-SD, active set, HHT", "bar_sd", ["Time/Scheme=HHT",
                                          "Contact/Treatment=Signorini active set"]),
    ("1D-SS, proximal augmented Lagrangian, TR-BDF2", "bar_ss",
     ["Time/Scheme=TR-BDF2", "Contact/Treatment=proximal augmented Lagrangian"]),
    ("1D-SD, Nitsche, Crank-Nicolson, h = dt = 0.1/64", "bar_sd",
     ["Mesh/Mesh size=0.0015625", "Time/Time step=0.0015625"]),
]


def wall_time(program, parameters, final_time):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "--quiet", "--output-dir", folder]
        for parameter in parameters + ["Output/Fields every=0",
                                       "Output/Log every=0",
                                       f"Time/Final time={final_time}"]:
            command += ["--set", parameter]
        start = time.perf_counter()
        subprocess.run(command, check=True)
        return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="build/release")
    parser.add_argument("--repetitions", type=int, default=5)
    arguments = parser.parse_args()
    print("| run | start-up | steps | a step |\n|---|---|---|---|")
    for name, program, parameters in CASES:
        executable = str(pathlib.Path(arguments.build_dir) / program)
        step = next((float(p.split("=")[1]) for p in parameters
                     if p.startswith("Time/Time step")), .05)
        wall_time(executable, parameters, step)  # warm the file cache
        pairs = [(wall_time(executable, parameters, step),
                  wall_time(executable, parameters, 12))
                 for _ in range(arguments.repetitions)]
        start_up = statistics.median(first for first, _ in pairs)
        steps = statistics.median(second - first for first, second in pairs)
        print(f"| {name} | {start_up:.3f} s | {steps:.3f} s "
              f"| {1e6 * steps / (12 / step):.0f} us |", flush=True)


if __name__ == "__main__":
    main()
