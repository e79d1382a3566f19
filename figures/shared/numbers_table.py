# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of all numbers that the papers print, beside ours, in doc/benchmarks.md."""

from . import CHECKOUT
from .paper_numbers import everything

FILE = CHECKOUT / "doc" / "benchmarks.md"
BEGIN = "<!-- Made by figures/make.py --table from figures/numbers, not by hand. -->\n"
END = "<!-- The end of what is made. -->\n"


def _cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def text():
    """The table as Markdown."""
    header = ["figure", "quantity", "paper", "ours", "band", "verdict"]
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    for number in everything().values():
        if number.paper is None:
            continue
        cells = (
            f"{number.name[0]}: {number.source.partition(':')[0]}",
            number.quantity,
            number.paper_text,
            number.ours_text,
            number.band_text,
            number.verdict,
        )
        lines.append("| " + " | ".join(map(_cell, cells)) + " |")
    return "\n".join(lines) + "\n"


def with_table(page):
    """The page with the table between its marks.

    Raises:
        ValueError: the page has no marks.
    """
    before, _, rest = page.partition(BEGIN)
    _, found, after = rest.partition(END)
    if not found:
        raise ValueError(f"{FILE.name} has no place for the table of the papers' numbers.")
    return f"{before}{BEGIN}\n{text()}\n{END}{after}"


def write():
    FILE.write_text(with_table(FILE.read_text(encoding="utf-8")), encoding="utf-8")
