#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw what each contact treatment conserves with each time scheme, one page A4, as PDF.

    doc/make_cheat_sheet.py conserves.pdf                    # with build/release/ricochet
    doc/make_cheat_sheet.py conserves.pdf --build-dir DIR

All names, promises and reasons are those that `ricochet --promises` and `ricochet --combinations`
print. Letters are in the fonts that every viewer has, so that they can be searched and copied.
"""

from __future__ import annotations

import argparse
import pathlib
import subprocess
import textwrap

import make_combinations
import matplotlib
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

ROOT = pathlib.Path(__file__).resolve().parents[1]
STYLE = {"pdf.use14corefonts": True, "pdf.compression": 0, "font.family": "sans-serif"}
# A4 (inches), with a margin; columns and lines in points.
SIZE, MARGIN = (297 / 25.4, 210 / 25.4), 28.0
NAME, SCHEME, LINE, LETTERS = 146.0, 52.0, 8.0, 6.5
# Characters of the last column, and of a line across the page.
WIDE_REASON, WIDE = 54, 235
# Backgrounds by the verbs of promises.
COLOURS = {"keeps": "#9fd8b4", "never gains": "#fce39b", "promises nothing": "#e4e4e4"}
EVERYWHERE = "any with "


def promises(program: pathlib.Path) -> dict[str, tuple[str, str]]:
    """The promise and its reason, by treatment; "any with SCHEME" for schemes that end it."""
    words = [str(program), "--promises"]
    printed = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    rows = [line.strip("| ").split(" | ") for line in printed.splitlines()[2:]]
    return {name: (promise, reason) for name, promise, reason in rows}


def contacts(rows: list[dict[str, str]]) -> dict[str, str]:
    """A letter for each kind of contact."""
    letters: dict[str, str] = {}
    for contact in dict.fromkeys(row["contact"] for row in rows):
        letters[contact] = next(c for c in contact if c not in letters.values())
    return letters


class Sheet:
    """A page that is written from above to below, in points."""

    def __init__(self) -> None:
        self.figure = Figure(figsize=SIZE)
        self.width, self.height = (72 * inches for inches in SIZE)
        self.y = MARGIN

    def text(self, x: float, words: str, line: float = 0.0, **style: object) -> None:
        place = (x / self.width, 1 - (self.y + line) / self.height)
        style = {"fontsize": LETTERS, "va": "top", **style}
        self.figure.text(*place, words, **style)  # type: ignore[arg-type]

    def box(self, x: float, width: float, height: float, colour: str) -> None:
        place = (x / self.width, 1 - (self.y + height) / self.height)
        size = (width / self.width, height / self.height)
        self.figure.add_artist(Rectangle(place, *size, facecolor=colour, edgecolor="white"))

    def paragraph(self, words: str) -> None:
        for line in textwrap.wrap(words, WIDE):
            self.text(MARGIN, line)
            self.y += LINE
        self.y += LINE / 3


def draw(program: pathlib.Path) -> Figure:
    """The page."""
    said = promises(program)
    rows, _ = make_combinations.read(program)
    letters = contacts(rows)
    taken = {
        (row["treatment"], row["scheme"], row["contact"]) for row in rows if row["taken"] == "yes"
    }
    schemes = list(dict.fromkeys(row["scheme"] for row in rows))
    treatments = list(dict.fromkeys(row["treatment"] for row in rows))
    sheet = Sheet()
    sheet.text(MARGIN, "Ricochet: what contact does to the energy", fontsize=14, weight="bold")
    sheet.y += 22
    sheet.paragraph(
        "In each step, for total = energy + contact potential - works from outside + dissipation. "
        "Cells: the kinds of contact that are taken, with at least one choice of mass, friction, "
        "viscosity, material, dimension and degree; empty: none."
    )
    x = MARGIN
    for promise, colour in COLOURS.items():
        sheet.box(x, 90, LINE + 2, colour)
        sheet.text(x + 4, promise, line=2)
        x += 94
    sheet.text(x + 8, ",  ".join(f"{letter}: {name}" for name, letter in letters.items()), line=2)
    sheet.y += 2 * LINE
    reasons_at = MARGIN + NAME + SCHEME * len(schemes) + 6
    for number, scheme in enumerate(schemes):
        sheet.text(MARGIN + NAME + SCHEME * number + 2, scheme, weight="bold", fontsize=5.8)
    sheet.text(reasons_at, "with midpoint, because", weight="bold")
    sheet.y += LINE + 3
    for treatment in treatments:
        promise, reason = said[treatment]
        lines = textwrap.wrap(reason, WIDE_REASON)
        height = LINE * max(2, len(lines)) + 3
        sheet.box(MARGIN, NAME - 1, height, COLOURS[promise])
        sheet.text(MARGIN + 3, treatment, line=2, weight="bold")
        sheet.text(MARGIN + 3, promise, line=2 + LINE)
        for number, scheme in enumerate(schemes):
            found = [
                letter for name, letter in letters.items() if (treatment, scheme, name) in taken
            ]
            if found:
                at = MARGIN + NAME + SCHEME * number
                of_pair = said.get(EVERYWHERE + scheme, said[treatment])[0]
                sheet.box(at, SCHEME - 1, height, COLOURS[of_pair])
                sheet.text(at + 3, " ".join(found), line=2)
        for number, line in enumerate(lines):
            sheet.text(reasons_at, line, line=2 + LINE * number, fontsize=6)
        sheet.y += height
    sheet.y += LINE / 2
    for name, (promise, reason) in said.items():
        if name not in treatments:
            sheet.paragraph(f"{name}: {promise}; {reason}.")
    if sheet.y > sheet.height - MARGIN / 2:
        raise RuntimeError(f"The page ends at {sheet.y:.0f} of {sheet.height:.0f} points.")
    return sheet.figure


def write(program: pathlib.Path, path: pathlib.Path) -> None:
    """Draw the page into a file."""
    with matplotlib.rc_context(STYLE):
        FigureCanvasPdf(draw(program)).print_pdf(path, metadata={"CreationDate": None})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--build-dir", type=pathlib.Path, default=ROOT / "build" / "release")
    arguments = parser.parse_args()
    write(arguments.build_dir / "ricochet", arguments.file)


if __name__ == "__main__":
    main()
