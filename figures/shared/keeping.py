# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures that are kept in the repository, for a site without an hour of runs: small copies of the
pictures, the tables, and the checks, each with the date and the commit of the programs."""

import csv
import datetime
import io
import re
import subprocess

from ricochet import RicochetError

from . import CHECKOUT, report

FOLDER = CHECKOUT / "figures" / "kept"

#: The largest size of a picture, in bytes.
LARGEST = 40_000

#: Widths in pixels and numbers of colours of small pictures: the first that is small enough is taken.
SIZES = [(1000, 48), (1000, 32), (820, 32), (680, 32), (680, 24), (520, 32), (520, 24), (400, 16)]

#: The columns of `made.csv`.
MADE = ("figure", "date", "commit")


def _git(*words):
    answer = subprocess.run(["git", *words], cwd=CHECKOUT, capture_output=True, text=True)
    if answer.returncode != 0:
        raise RicochetError(f"git {words[0]} failed: {answer.stderr.strip()}")
    return answer.stdout.strip()


def commit(build_dir):
    """The commit of the checkout, short.

    Raises:
        RicochetError: files differ from it, or programs are those of another one, so that the figures
            would not be those of the commit.
    """
    if _git("status", "--porcelain", "--", ".", ":!figures/kept"):
        raise RicochetError("Figures to keep have to be those of a commit, but files differ from it.")
    head = _git("rev-parse", "HEAD")
    said = subprocess.run([build_dir / "bar_sd", "--version"], capture_output=True, text=True).stdout
    built = re.search(r"commit ([0-9a-f]+)", said)
    if not built or not head.startswith(built[1]):
        raise RicochetError(f"The programs in '{build_dir}' are not of the commit {head[:10]}: build.")
    return head[:10]


def small_copy(source, target):
    """Write a picture with few colours, of at most `LARGEST` bytes."""
    from PIL import Image

    with Image.open(source) as file:
        image = file.convert("RGB")
        inches = image.width / file.info.get("dpi", (200,))[0]
    for width, colours in SIZES:
        width = min(width, image.width)
        size = (width, round(image.height * width / image.width))
        small = image.resize(size, Image.Resampling.LANCZOS)
        # An octree keeps the hues of thin lines, of which there are few pixels.
        small = small.quantize(colours, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
        data = io.BytesIO()
        small.save(data, "PNG", optimize=True, dpi=(width / inches,) * 2)
        if data.tell() <= LARGEST:
            target.write_bytes(data.getvalue())
            return
    raise RicochetError(f"{source.name} has no copy of {LARGEST} bytes that one could read.")


def made(folder=FOLDER):
    """Date and commit of each figure that is kept."""
    path = folder / "made.csv"
    if not path.is_file():
        return {}
    with path.open(newline="", encoding="utf-8") as file:
        return {row["figure"]: (row["date"], row["commit"]) for row in csv.DictReader(file)}


def keep(figures, checks, commit_of_programs, source, folder=FOLDER):
    """Put figures that were just made, in the folder `source`, and their checks into the repository."""
    folder.mkdir(exist_ok=True)
    entries = made(folder)
    today = datetime.date.today().isoformat()
    for figure in figures:
        if figure.image:
            small_copy(source / figure.image, folder / figure.image)
        if figure.table_file:
            (folder / figure.table_file).write_bytes((source / figure.table_file).read_bytes())
        entries[figure.name] = (today, commit_of_programs)
    with (folder / "made.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(MADE)
        writer.writerows((name, *entry) for name, entry in sorted(entries.items()))
    report.write_csv(checks, folder / "checks.csv")
