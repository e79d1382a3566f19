#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The contact treatments between bodies, compared on scenes of all kinds, for the default.

Runs each scene with each treatment, coupling and mass, with the step of the scene and a quarter
of it, and once on a finer mesh with an eighth of the step, which is the reference for impulses
and forces. Prints a table in Markdown: the largest promise residual, the deepest penetration over
the size of a cell, the largest contact force with both steps and the largest impulse over those
of the reference, iterations of Newton's method in a step, and halved steps; and in the end how
often each choice kept its promise and the bounds below. Rows that are there are not computed
again. The exit code is 0: a table is no verdict.
"""

import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))

from promises import TREATMENTS, block, scene  # noqa: E402

from ricochet import Run  # noqa: E402

# Laws in quadrature points have no mortar, and in 3D laws that keep their energy have none.
CHOICES = [(treatment, coupling, mass) for treatment in TREATMENTS
           for coupling in ("points", "mortar") for mass in ("consistent", "redistributed")
           if coupling == "points" or treatment not in ("Hauret-Le Tallec", "penalty")]
# The reference keeps energy, and its force converges with the step.
REFERENCE = ("persistent contact", "points", "redistributed")


def disk(name, radius, nodes, place, velocity):
    return [f"subsection Body {name}", "  set Shape = disk", f"  set Radius = {radius}",
            f"  set Nodes around = {nodes}", "  set Law = neo-Hookean",
            "  set Young modulus = 1e6", "  set Density = 1000",
            f"  set Translation = {', '.join(map(str, place))}",
            f"  set Velocity = {', '.join(map(str, velocity))}", "end"]


def scenes():
    """Names, texts of parameter files, and the size of a cell (m)."""
    head_on = [("b1: left", "b0: right")]
    for dim in (2, 3):
        def at(x, height, dim=dim):
            return [x] + [0] * (dim - 2) + [height]

        cube, cells = [1] * dim, [4] * dim
        yield f"head on {dim}D", scene(
            [block("b0", cube, cells, at(0, 0), at(1, 0)),
             block("b1", cube, cells, at(1.02, 0), at(-1, 0))],
            head_on, False, [], .16, 1e-3), .25
        # More in 3D takes hours.
        if dim == 3:
            continue
        yield "balls 2D", scene(
            [disk("b0", .5, 32, at(0, 0), at(1, 0)),
             disk("b1", .5, 32, at(1.01, .2), at(-1, 0))],
            [("b1", "b0")], False, [], .15, 1e-3), .1
        yield f"head on, other mesh {dim}D", scene(
            [block("b0", cube, cells, at(0, 0), at(1, 0)),
             block("b1", cube, [cells[0] + 1] * dim, at(1.02, 0), at(-1, 0))],
            head_on, False, [], .16, 1e-3), .25
        yield f"dropped beside {dim}D", scene(
            [block("b0", cube, cells, at(0, 0)),
             block("b1", cube, cells, at(.3, 1.01), at(0, -1))],
            [("b1: lower", "b0: upper")], False, ["b0: lower"], .2, 2e-3), .25
    layer = [1, .5]
    yield "stack 2D", scene(
        [block(f"b{k}", layer, [4, 2], [0, .5 * k]) for k in (0, 1, 2)],
        [("b1: lower", "b0: upper"), ("b2: lower", "b1: upper")], True, ["b0: lower"],
        1, 4e-3), .25
    table = block("b0", [1, .25], [4, 2], [0, 0])
    sled = block("b1", [.5, .25], [3, 2], [.4, .251], [2, 0])
    yield "off a table with friction 2D", scene(
        [table, sled], [("b1: lower", "b0: upper")], True, ["b0: lower"], .4, 2e-3, .1), .25
    yield "cradle", (ROOT / "examples/newtons_cradle.prm").read_text(encoding="utf-8"), .002
    yield "dominoes", (ROOT / "examples/dominoes.prm").read_text(encoding="utf-8"), .004


def with_choices(text, treatment, coupling, mass):
    """The scene with these in each contact between bodies."""
    lines, section = [], ""
    for line in text.replace("{treatment}", treatment).splitlines():
        word = line.strip()
        if word.startswith("subsection"):
            section = word
        if word.startswith("set Treatment"):
            continue
        if word == "end" and section.startswith("subsection Contact"):
            lines.append(f"  set Treatment = {treatment}")
            # Against an obstacle there is no coupling.
            if section != "subsection Contact table":
                lines.append(f"  set Coupling = {coupling}")
            section = ""
        if word == "end" and section == "subsection Time":
            lines.append(f"  set Mass = {mass}")
            section = ""
        lines.append(line)
    return "\n".join(lines) + "\n"


def refined(text, cells, steps):
    """With @p cells times as many cells in each direction, and steps."""
    def more(found):
        return found[1] + ", ".join(str(cells * int(number))
                                    for number in found[2].split(","))

    text = re.sub(r"(set (?:Cells along|Nodes around) *= )([\d, ]+)", more, text)
    return re.sub(r"(set Time step *= )([\d.e-]+)",
                  lambda found: found[1] + f"{float(found[2]) / steps:.10g}", text)


def run(options, folder, text):
    """Numbers of the run, from a former one where that is of the same file."""
    folder.mkdir(parents=True, exist_ok=True)
    file, kept = folder / "scene.prm", folder / "numbers.json"
    if kept.exists() and file.exists() and file.read_text(encoding="utf-8") == text:
        return json.loads(kept.read_text(encoding="utf-8"))
    file.write_text(text, encoding="utf-8")
    kept.unlink(missing_ok=True)
    try:
        code = subprocess.run(
            [str(options.build_dir / "ricochet"), str(file), "--output-dir",
             str(folder / "run"), "--overwrite", "--quiet", "--set",
             "Output/Fields every=0"], stderr=(folder / "errors").open("w"),
            stdout=subprocess.DEVNULL, check=False, timeout=options.seconds).returncode
    except subprocess.TimeoutExpired:
        code = -1
    numbers = {"code": code}
    if code in (0, 4):
        table = Run(folder / "run").table

        def columns(beginning):
            return [table[name] for name in table.columns if name.startswith(beginning)]

        force = np.max(columns("contact_force_"), axis=0)
        impulses = [np.linalg.norm(pair, axis=0) for pair in zip(
            columns("impulse_x_"), columns("impulse_y_"))]
        numbers.update(
            residual=np.nanmax(table["promise_residual"]),
            depth=max(np.nanmax(column) for column in columns("penetration_")),
            force=np.nanmax(force), impulse=max(np.max(one) for one in impulses),
            iterations=np.mean(table["newton_iterations"][1:]),
            halvings=int(table["step_halvings"][-1]))
    kept.write_text(json.dumps(numbers), encoding="utf-8")
    return numbers


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build-dir", default=ROOT / "build" / "release", type=pathlib.Path)
    parser.add_argument("--output", default=ROOT / "output" / "defaults", type=pathlib.Path)
    parser.add_argument("--only", default="", help="part of the names of scenes")
    parser.add_argument("--jobs", default=1, type=int, help="runs at a time")
    parser.add_argument("--seconds", default=300, type=float, help="the longest run")
    options = parser.parse_args()
    counts = {choice: [0] * 6 for choice in CHOICES}
    spreads = {choice: [] for choice in CHOICES}
    print("| scene | treatment | coupling | mass | residual | depth / cell | largest force | "
          "with a quarter of the step | impulse | iterations | halvings |\n" + "|---" * 11 + "|")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for name, text, cell in scenes():
            if options.only not in name:
                continue
            folder = options.output / name.replace(" ", "_").replace(",", "")
            # Meshes of files touch as they are, and finer ones overlap.
            reference = pool.submit(run, options, folder / "reference", refined(
                with_choices(text, *REFERENCE), 2 if "D" in name else 1,
                4 if "3D" in name else 8))
            jobs = [(choice, *(pool.submit(
                run, options, folder / "_".join(choice).replace(" ", "_") / str(steps),
                refined(with_choices(text, *choice), 1, steps)) for steps in (1, 4)))
                for choice in CHOICES]
            right = reference.result()
            if right["code"] not in (0, 4):
                sys.exit(f"The reference of '{name}' ended with {right['code']}.")
            for choice, *both in jobs:
                one, fine = (job.result() for job in both)
                beginning = f"| {name} | {' | '.join(choice)} | "
                if one["code"] not in (0, 4) or fine["code"] not in (0, 4):
                    print(beginning + f"exit codes {one['code']}, {fine['code']} "
                          + "| " * 7 + "|", flush=True)
                    continue
                forces = [each["force"] / right["force"] for each in (one, fine)]
                impulse = one["impulse"] / right["impulse"]
                print(beginning + f"{one['residual']:.1e} | {one['depth'] / cell:.1e} | "
                      f"{forces[0]:.2f} | {forces[1]:.2f} | {impulse:.3f} | "
                      f"{one['iterations']:.1f} | {one['halvings']} |", flush=True)
                for k, good in enumerate((
                        True, one["residual"] < 1e-9, abs(impulse - 1) < .05,
                        max(forces) < 1.5 * min(forces), max(forces) < 2,
                        one["iterations"] < 12 and one["halvings"] <= 2)):
                    counts[choice][k] += good
                spreads[choice].append(one["depth"] / cell)
    print("\n| treatment | coupling | mass | runs | promise to 1e-9 | impulse to 5 % | "
          "largest force within 1.5 of that of a quarter of the step | below 2 of the "
          "reference | at most 12 iterations, 2 halvings | median depth / cell |\n"
          + "|---" * 10 + "|")
    for choice in CHOICES:
        if spreads[choice]:
            print(f"| {' | '.join(choice)} | {' | '.join(map(str, counts[choice]))} | "
                  f"{np.median(spreads[choice]):.1e} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
