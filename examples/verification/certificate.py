#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether the bars of --certify hold: random bars with exact solutions.

    certificate.py [--bars 200] [--seed 1] [--write]     the table, and with --write into
                                                         doc/certificate.md

Both bar programs with a treatment, a scheme, a mesh, a step and a final time drawn at random.
The exact numbers are those of waves by d'Alembert's formula, below, and not by the library's."""

from __future__ import annotations

import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "doc" / "certificate.md"
sys.path.insert(0, str(ROOT / "python"))
from ricochet.programs import ONE_THREAD, choices_of, find_program  # noqa: E402

Numbers = dict[str, float]


def exact(program: str, end: float) -> Numbers:
    """Numbers of the summary of a bar of unit length, modulus and density at the time `end`.

    w = u_t + u_x comes from the right, v = u_t - u_x from the left, and both are constant over
    unit intervals of time at the ends: a free end returns them as they are, a closed or held one
    with the other sign, and a closed one is pressed by -w on the left and v on the right.
    """
    if program == "bar_sd":
        strain, velocity, gaps, held = -0.5, 0.0, [0.5, math.inf], True
    else:
        strain, velocity, gaps, held = -0.5, -0.5, [1.0, 0.0], False
    w, v = [velocity + strain], [velocity - strain]
    pressures: list[list[float]] = [[], []]
    first = [math.inf, math.inf]
    n = math.ceil(end) + 1
    for k in range(n):
        # Positive towards the obstacle.
        coming = (-w[k], v[k])
        closed = [abs(gap) < 1e-9 and speed >= 0 for gap, speed in zip(gaps, coming)]
        for side in (0, 1):
            if closed[side]:
                first[side] = min(first[side], k)
            else:
                gaps[side] -= coming[side]
            pressures[side].append(coming[side] if closed[side] else 0.0)
        v.append(-w[k] if closed[0] else w[k])
        w.append(-v[k] if closed[1] or held else v[k])

    def part(values: list[float], age: float) -> float:
        # values[0] is that of the start, values[k + 1] leaves an end in [k, k + 1).
        return values[max(0, math.floor(end - age + 1e-12) + 1)]

    rest = end - math.floor(end + 1e-12)
    places = sorted({0.0, 1.0, min(max(rest, 0.0), 1.0), min(max(1 - rest, 0.0), 1.0)})
    kinetic = elastic = 0.0
    for a, b in zip(places, places[1:]):
        x = (a + b) / 2
        left_going, right_going = part(w, 1 - x), part(v, x)
        kinetic += (b - a) / 2 * ((left_going + right_going) / 2) ** 2
        elastic += (b - a) / 2 * ((left_going - right_going) / 2) ** 2
    numbers = {
        "energy.at_end.kinetic": kinetic,
        "energy.at_end.elastic": elastic,
        "energy.at_end.all": kinetic + elastic,
        "energy.lost.contact": 0.0,
        "energy.lost.time_scheme": 0.0,
    }
    for side, name in enumerate(("left", "right")[: 1 if held else 2]):
        times = [max(0.0, min(k + 1, end) - k) for k in range(n)]
        contact = f"contacts.{name}."
        numbers[contact + "largest_force"] = max(
            p for p, time in zip(pressures[side], times) if time > 0
        )
        numbers[contact + "deepest_penetration"] = 0.0
        numbers[contact + "impulse_of_force"] = sum(
            p * time for p, time in zip(pressures[side], times)
        )
        if first[side] < end:
            numbers[contact + "first_touch"] = first[side]
    return numbers


def run(program: str, settings: dict[str, object], folder: pathlib.Path) -> dict | None:
    """The certificate and the end of a run; None where it is refused or fails."""
    command = [str(find_program(program)), "--certify", "--quiet", "--output-dir", str(folder)]
    for name, value in settings.items():
        command += ["--set", f"{name}={value}"]
    code = subprocess.run(
        command, capture_output=True, env={**os.environ, **ONE_THREAD}, check=False
    ).returncode
    if code not in (0, 4):
        return None
    certificate = json.loads((folder / "certificate.json").read_text())["numbers"]
    steps = json.loads((folder / "summary.json").read_text())["steps"]
    shutil.rmtree(folder)
    return {"program": program, "settings": settings, "end": steps["end"], "numbers": certificate}


def draw(generator: random.Random, choices: dict[str, list[str]]) -> dict[str, object]:
    size = 1 / generator.choice([10, 16, 20, 25, 32, 40, 50])
    courant = math.exp(generator.uniform(math.log(0.3), math.log(2)))
    return {
        **{name: generator.choice(values) for name, values in choices.items()},
        "Mesh/Mesh size": size,
        "Time/Time step": float(f"{courant * size:.4g}"),
        "Time/Final time": round(generator.uniform(1.5, 12), 3),
        "Output/Fields every": 0,
    }


def study(n: int, seed: int) -> list[dict]:
    """`n` runs that are not refused."""
    generator = random.Random(seed)
    bar = find_program("bar_sd")
    choices = {name: choices_of(bar, None, name) for name in ("Contact/Treatment", "Time/Scheme")}
    # Bars do not stand still, and ARKODE has no certificate.
    choices["Time/Scheme"] = [
        each for each in choices["Time/Scheme"] if each not in ("static", "ARKODE")
    ]
    cases = [
        (generator.choice(["bar_sd", "bar_ss"]), draw(generator, choices)) for _ in range(8 * n)
    ]
    results: list[dict] = []
    with (
        tempfile.TemporaryDirectory() as folder,
        concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool,
    ):
        for begin in range(0, len(cases), 16):
            part = cases[begin : begin + 16]
            folders = [pathlib.Path(folder) / str(begin + k) for k in range(len(part))]
            done = pool.map(run, *zip(*part), folders)
            results += [each for each in done if each]
            if len(results) >= n:
                break
    return results[:n]


def rows(results: list[dict]) -> list[tuple[str, int, int, int, float]]:
    """For each kind of number, and for all: how many, how many with a bar, how many of these
    hold, and the median of bar over error where there is an error."""
    table: dict[str, list] = {}
    for result in results:
        truth = exact(result["program"], result["end"])
        for name, number in result["numbers"].items():
            if name not in truth:
                continue
            error = abs(number["value"] - truth[name])
            bar = number["error_bar"]
            kind = re.sub(r"^contacts\.[a-z]+\.", "", name)
            for key in (kind, "all"):
                entry = table.setdefault(key, [0, 0, 0, []])
                entry[0] += 1
                if bar is not None:
                    entry[1] += 1
                    entry[2] += error <= bar + 1e-9
                    if error > 1e-8:
                        entry[3].append(bar / error)
    order = sorted(table, key=lambda key: (key == "all", key))
    return [
        (key, *table[key][:3], statistics.median(table[key][3] or [math.nan])) for key in order
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--bars", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--results", type=pathlib.Path, help="keep the results of the runs here")
    arguments = parser.parse_args()
    results = study(arguments.bars, arguments.seed)
    if arguments.results:
        arguments.results.write_text(json.dumps(results))
    lines = ["| number | of them | with a bar | that hold | bar over error, median |", "|---|---|---|---|---|"]
    for kind, n, with_bar, held, ratio in rows(results):
        shares = [f"{x} ({100 * x / max(y, 1):.0f} %)" for x, y in ((with_bar, n), (held, with_bar))]
        lines.append(f"| `{kind}` | {n} | {shares[0]} | {shares[1]} | {ratio:.1f} |")
    print("\n".join(lines))
    if arguments.write:
        text = PAGE.read_text(encoding="utf-8")
        marks = ("<!-- certificate: begin -->", "<!-- certificate: end -->")
        begin, end = (text.index(mark) for mark in marks)
        PAGE.write_text(
            text[:begin] + marks[0] + "\n\n" + "\n".join(lines) + "\n\n" + text[end:],
            encoding="utf-8",
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
