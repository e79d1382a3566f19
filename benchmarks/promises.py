#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Total energy in contact where nodes, ends and edges of equal bodies meet.

Runs blocks on blocks and blocks against blocks, in 2D and 3D, with each contact treatment for
bodies, and prints a table: the largest promise residual (change or rise of the total energy, over
the largest sum of energies and works), whether the run says that a promise is broken, the deepest
penetration over the size of a cell, halved steps, and points that were dropped or entered behind a
facet. The exit code is 0: a table is no verdict.
"""

import argparse
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))

from ricochet import Run  # noqa: E402

TREATMENTS = ["Signorini active set", "standard normal compliance",
              "improved normal compliance", "Hauret-Le Tallec", "penalty",
              "persistent contact", "Ayyad-Barboteu two-step"]


def block(name, size, cells, place, velocity=None):
    shape = "block" if len(size) == 3 else "rectangle"
    numbers = {"Size": size, "Cells along": cells, "Translation": place,
               "Velocity": velocity or [0] * len(size)}
    lines = [f"subsection Body {name}", f"  set Shape = {shape}",
             "  set Law = neo-Hookean", "  set Young modulus = 1e6",
             "  set Density = 1000"]
    lines += [f"  set {key} = {', '.join(map(str, value))}"
              for key, value in numbers.items()]
    return lines + ["end"]


def scene(bodies, contacts, gravity, held, end, step, friction=0):
    """The text of a parameter file; {treatment} stands for the treatment."""
    dim = 3 if "block" in bodies[0][1] else 2
    lines = ["set Program = ricochet", f"set Dimension = {dim}"]
    for body in bodies:
        lines += body
    for number, (first, second) in enumerate(contacts):
        lines += [f"subsection Contact c{number}", f"  set Surface = {first}",
                  f"  set Against = {second}", "  set Treatment = {treatment}",
                  "  set Coupling = {coupling}",
                  f"  set Friction coefficient = {friction}", "end"]
    for number, boundary in enumerate(held):
        lines += [f"subsection Condition foot{number}", f"  set Boundary = {boundary}",
                  "  set Kind = fixed", "end"]
    if gravity:
        down = ", ".join(["0"] * (dim - 1) + ["-9.81"])
        lines += ["subsection Start", f"  set Gravity = {down}", "end"]
    lines += ["subsection Time", f"  set Final time = {end}", f"  set Time step = {step}",
              "end", "subsection Output", "  set Fields every = 0", "  set Log every = 0",
              "end"]
    return "\n".join(lines) + "\n"


def scenes():
    pairs = [("b1: lower", "b0: upper"), ("b2: lower", "b1: upper")]
    for dim in (2, 3):
        def sized(*numbers, dim=dim):
            return list(numbers[-dim:]) if dim == 3 else [numbers[0], numbers[-1]]

        def at(height, dim=dim):
            return [0] * (dim - 1) + [height]

        yield (f"equal blocks {dim}D", scene(
            [block(f"b{k}", sized(1, 1, 1), sized(2, 2, 2), at(k)) for k in (0, 1)],
            pairs[:1], True, ["b0: lower"], 1, 4e-3))
        yield (f"stack of three {dim}D", scene(
            [block(f"b{k}", sized(1, 1, .5), sized(4, 4, 2), at(.5 * k))
             for k in (0, 1, 2)], pairs, True, ["b0: lower"], 1, 4e-3))
        yield (f"dropped flat {dim}D", scene(
            [block("b0", sized(1, 1, 1), sized(4, 4, 4), at(0)),
             block("b1", sized(1, 1, 1), sized(4, 4, 4), at(1.01), at(-1))],
            pairs[:1], False, ["b0: lower"], .2, 2e-3))
        yield (f"other mesh {dim}D", scene(
            [block("b0", sized(1, 1, 1), sized(4, 4, 4), at(0)),
             block("b1", sized(1, 1, 1), sized(3, 3, 3), at(1.01), at(-1))],
            pairs[:1], False, ["b0: lower"], .2, 2e-3))

        def beside(x, height, dim=dim):
            return [x] + [.03] * (dim - 2) + [height]

        # Half a cell beside each other, wider, and one over the end of the other.
        yield (f"shifted by half a cell {dim}D", scene(
            [block("b0", sized(1, 1, 1), sized(4, 4, 4), at(0)),
             block("b1", sized(1, 1, 1), sized(4, 4, 4), beside(.125, 1.01), at(-1))],
            pairs[:1], False, ["b0: lower"], .2, 2e-3))
        yield (f"wider {dim}D", scene(
            [block("b0", sized(1, 1, 1), sized(4, 4, 4), at(0)),
             block("b1", sized(1.4, 1.4, 1), sized(4, 4, 4), beside(-.2, 1.01), at(-1))],
            pairs[:1], False, ["b0: lower"], .2, 2e-3))
        # Over the end of a table, and from it onto another one that is a little lower.
        for friction in (0, .1):
            how = "with friction " if friction else ""
            table = [block("b0", sized(1, 1, .25), sized(4, 3, 1), at(0)),
                     block("b1", sized(1, 1, .25), sized(4, 3, 1), beside(1.2, -.005))]
            sled = block("b2", sized(.5, .5, .25), sized(3, 2, 1), beside(.4, .251),
                         [2] + [0] * (dim - 1))
            yield (f"off a table {how}{dim}D", scene(
                [table[0], sled], [("b2: lower", "b0: upper")], True, ["b0: lower"],
                .5, 2e-3, friction))
            yield (f"onto a table {how}{dim}D", scene(
                table + [sled],
                [("b2: lower", "b0: upper; b1: upper")], True,
                ["b0: lower", "b1: lower"], .6, 2e-3, friction))
            yield (f"under a sled {how}{dim}D", scene(
                [table[0], sled], [("b0: upper", "b2: lower")], True, ["b0: lower"],
                .5, 2e-3, friction))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build-dir", default=ROOT / "build" / "release", type=pathlib.Path)
    parser.add_argument("--output", default=ROOT / "output" / "promises", type=pathlib.Path)
    parser.add_argument("--only", default="", help="part of the names of scenes")
    parser.add_argument("--coupling", default="points",
                        help="points, mortar or dual mortar")
    options = parser.parse_args()
    print("| scene | treatment | residual | | depth / cell | halvings | dropped | entered |\n"
          "|---|---|---|---|---|---|---|---|")
    for name, text in scenes():
        if options.only not in name:
            continue
        for treatment in TREATMENTS:
            folder = options.output / options.coupling / f"{name} {treatment}"
            folder = pathlib.Path(str(folder).replace(" ", "_"))
            folder.mkdir(parents=True, exist_ok=True)
            file = folder / "scene.prm"
            file.write_text(
                text.replace("{treatment}", treatment).replace("{coupling}", options.coupling),
                encoding="utf-8")
            code = subprocess.run(
                [str(options.build_dir / "ricochet"), str(file), "--output-dir",
                 str(folder / "run"), "--overwrite", "--quiet"],
                capture_output=True, check=False).returncode
            if code == 1:  # refused
                continue
            if code not in (0, 4):
                print(f"| {name} | {treatment} | exit code {code} | | | | | |", flush=True)
                continue
            table = Run(folder / "run").table

            def last(beginning, table=table):
                return int(sum(table[column][-1] for column in table.columns
                               if column.startswith(beginning)))

            depth = max(np.nanmax(table[column]) for column in table.columns
                        if column.startswith("penetration_"))
            print(f"| {name} | {treatment} | {np.nanmax(table['promise_residual']):.1e} | "
                  f"{'broken' if code == 4 else 'kept'} | {depth / .25:.1e} | "
                  f"{last('step_halvings')} | {last('dropped_')} | {last('entered_')} |",
                  flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
