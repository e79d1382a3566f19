#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures and animations of collisions in 3D in doc/images: tori, and spheres that spin.

    figures/collisions_in_space.py [--build-dir build/release] [--output output/collisions]

Runs in the output folder are taken as they are. The tori take some minutes, the spheres seconds.
"""

import argparse
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")

import ricochet  # noqa: E402
from PIL import Image  # noqa: E402
from ricochet import pictures  # noqa: E402

# Program: parameter file, steps between pictures.
COLLISIONS = {
    "colliding_tori": ("default", 3),
    "colliding_spheres": ("oblique_spin", 2),
}
FRAMES = 50
WIDTH, HEIGHT = 1500, 1200


def run(program, file, every, folder, build):
    """The run in the folder, made if it is not there."""
    if not (folder / "energy.csv").exists():
        subprocess.run(
            [build / program, ROOT / f"parameter_files/{program}/{file}.prm",
             "--output-dir", folder, "--set", f"Output/Fields every={every}", "--quiet"],
            check=True)
    return ricochet.Run(folder)


def draw(one, path):
    """The bodies, coloured by their velocity: first, squashed most, last."""
    pictures.draw_instants(one, "velocity", path)
    with Image.open(path) as picture:
        small = picture.convert("RGB")
    width = min(WIDTH, HEIGHT * small.width // small.height)
    small = small.resize((width, small.height * width // small.width), Image.LANCZOS)
    small.quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build-dir", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--output", default=ROOT / "output/collisions", type=pathlib.Path,
                        help="folder of the runs")
    options = parser.parse_args()
    images = ROOT / "doc" / "images"
    for program, (file, every) in COLLISIONS.items():
        one = run(program, file, every, options.output / program, options.build_dir)
        draw(one, images / f"{program}.png")
        pictures.animate(one, "velocity", images / f"{program}.gif", most_frames=FRAMES)
        print(f"doc/images/{program}.png, doc/images/{program}.gif")


if __name__ == "__main__":
    main()
