#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Unknowns a second of each part of a time step, against the bandwidth of memory.

Runs the program `kernels` with a parameter file that names bodies, meshes, sizes and
kernels (see it and kernels/kernels.cc), and prints a table of its numbers: unknowns a
second, and the part of the machine's own bandwidth, measured in the same run, that the
kernel would use if it moved no more bytes than it has to. Two machines, or two commits on
two machines, are compared by these parts. Besides, the loading of the libraries and the start of a
program. The folder gets kernels.csv, throughput.json and throughput.svg.
"""

import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1",
              "OMP_NUM_THREADS": "1"}


def processor():
    """The name of the processor, as Linux has it."""
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return "unknown"
    return next((line.split(":", 1)[1].strip() for line in lines
                 if line.startswith("model name")), "unknown")


def measure_kernels(arguments, folder):
    """The rows of kernels.csv, with numbers where there are numbers."""
    command = [] if arguments.ranks == 1 else ["mpirun", "-n", str(arguments.ranks)]
    command += [str(arguments.build_dir / "benchmarks" / "kernels"),
                str(arguments.parameters), "--output-dir", str(folder), "--overwrite"]
    for assignment in arguments.set:
        command += ["--set", assignment]
    subprocess.run(command, check=True, env={**os.environ, **ONE_THREAD},
                   stdout=sys.stderr)
    with open(folder / "kernels.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for key in ("seconds", "bytes", "unknowns_per_second", "bandwidth"):
            row[key] = float(row[key])
        row["unknowns"] = int(row["unknowns"])
        # 1 would be as fast as memory allows.
        row["part"] = row["bytes"] / row["seconds"] / row["bandwidth"]
    return rows


def seconds_of(commands, repetitions):
    """The median of the wall time of each command, run in turns."""
    times = [[] for _ in commands]
    for repetition in range(repetitions + 1):
        for one, command in zip(times, commands):
            begin = time.perf_counter()
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL,
                           env={**os.environ, **ONE_THREAD})
            # The first of all fills the cache of files.
            if repetition > 0:
                one.append(time.perf_counter() - begin)
    return [statistics.median(one) for one in times]


def measure_start(build_dir, repetitions):
    """Seconds of the libraries alone, of one of our programs that only says its version,
    and of a run of one step."""
    program = str(build_dir / "bar_sd")
    with tempfile.TemporaryDirectory() as folder:
        libraries, version, step = seconds_of(
            [[str(build_dir / "benchmarks" / "start_up")],
             [program, "--version"],
             [program, "--quiet", "--overwrite", "--output-dir", folder,
              "--set", "Time/Final time=.05", "--set", "Output/Fields every=0"]],
            repetitions)
    return {"libraries": libraries, "version": version, "one step": step}


def print_kernels(rows):
    print("| body | cells | unknowns | kernel | ms | million unknowns a second "
          "| GB/s at least | of the triad |\n|---|---|---|---|---|---|---|---|")
    for row in rows:
        print(f"| {row['material']} | {row['elements']} | {row['unknowns']} "
              f"| {row['kernel']} | {1e3 * row['seconds']:.3g} "
              f"| {1e-6 * row['unknowns_per_second']:.3g} "
              f"| {1e-9 * row['bytes'] / row['seconds']:.3g} "
              f"| {100 * row['part']:.0f} % |")


def draw(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    bodies = list(dict.fromkeys((row["material"], row["elements"]) for row in rows))
    kernels = list(dict.fromkeys(row["kernel"] for row in rows))
    figure, axes = plt.subplots(2, len(bodies), sharex=True, sharey="row", squeeze=False,
                                figsize=(2 + 3 * len(bodies), 6), layout="constrained")
    for column, body in enumerate(bodies):
        for number, kernel in enumerate(kernels):
            points = [row for row in rows
                      if (row["material"], row["elements"]) == body
                      and row["kernel"] == kernel]
            if not points:
                continue
            unknowns = [row["unknowns"] for row in points]
            for line, key in enumerate(("unknowns_per_second", "part")):
                axes[line][column].loglog(unknowns, [row[key] for row in points],
                                          "o-", color=f"C{number}", label=kernel)
        axes[0][column].set_title(", ".join(body))
        axes[1][column].axhline(1, color="black", linewidth=.8)
        axes[1][column].set_xlabel("unknowns")
    axes[0][0].set_ylabel("unknowns a second")
    axes[1][0].set_ylabel("part of the bandwidth of memory")
    # Each kernel once, to the right of all.
    entries = {}
    for row in axes[0]:
        for handle, label in zip(*row.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    axes[0][-1].legend(entries.values(), entries.keys(), loc="upper left",
                       bbox_to_anchor=(1.02, 1.), frameon=False)
    figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="build/release", type=pathlib.Path)
    parser.add_argument("--parameters", type=pathlib.Path,
                        default=pathlib.Path(__file__).with_name("throughput.prm"))
    parser.add_argument("--set", action="append", default=[], metavar="SECTION/NAME=VALUE",
                        help="override a parameter of the file; may be repeated")
    parser.add_argument("--ranks", default=1, type=int)
    parser.add_argument("--repetitions", default=5, type=int,
                        help="of the start of a program; 0 leaves it out")
    parser.add_argument("--output-dir", default="output/throughput", type=pathlib.Path)
    arguments = parser.parse_args()
    folder = arguments.output_dir
    rows = measure_kernels(arguments, folder)
    bandwidths = [row["bandwidth"] for row in rows]
    result = {"processor": processor(), "ranks": arguments.ranks,
              "bandwidth": [min(bandwidths), max(bandwidths)], "kernels": rows}
    print(f"{result['processor']}, {arguments.ranks} rank(s), triad "
          f"{1e-9 * min(bandwidths):.3g} to {1e-9 * max(bandwidths):.3g} GB/s\n")
    print_kernels(rows)
    if arguments.repetitions > 0:
        result["start"] = start = measure_start(arguments.build_dir,
                                                arguments.repetitions)
        print(f"\nstart: the libraries {start['libraries']:.3f} s; beyond them, a program "
              f"that says its version {start['version'] - start['libraries']:.3f} s, and "
              f"one with a time step {start['one step'] - start['libraries']:.3f} s")
    with open(folder / "throughput.json", "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
    draw(rows, folder / "throughput.svg")


if __name__ == "__main__":
    main()
