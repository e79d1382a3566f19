# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures and checks: the parts of the file of a figure."""

from collections.abc import Callable
from dataclasses import dataclass

# Possible verdicts of a row of the table.
YES = "yes"  # the number meets its criterion
NO = "NO"  # it does not: make.py fails
DIFFERS = "differs"  # it is ours as written down, and the paper's is known to be another one


@dataclass
class Check:
    """A number of a figure, beside the paper's and the exact one."""

    quantity: str
    ours: str
    status: str
    paper: str = "-"
    exact: str = "-"
    criterion: str = ""  # the criterion for the number
    figure: str = ""  # filled in by make.py
    number: str = ""  # its name in figures/numbers


def check(quantity, ours, passed, criterion, paper="-", exact="-"):
    """A row that fails when `passed` is false."""
    return Check(quantity, ours, YES if passed else NO, paper, exact, criterion)


@dataclass(frozen=True)
class Table:
    """Cells of text, for the page of the figures."""

    header: list
    rows: list


@dataclass
class Figure:
    """A figure of a paper, or one of our own.

    `text` is the docstring of its file: the title, an empty line, the caption. `draw()`
    returns a matplotlib figure, `table()` a `Table`, `checks()` a list of rows. They read the
    results of `runs`, which are there when they are called. A figure has a picture, a table
    or both.
    """

    name: str  # paper and number, such as C-6; D, O, R, S for those of no paper
    text: str
    runs: list
    draw: Callable | None
    checks: Callable = list
    timed: bool = False  # shows seconds: made by its name or "timed" only, one run at a time
    animate: Callable | None = None  # `animate(path)` writes a GIF
    table: Callable | None = None

    @property
    def title(self):
        return self.text.partition("\n\n")[0].strip().removesuffix(".")

    @property
    def caption(self):
        return " ".join(self.text.partition("\n\n")[2].split())

    @property
    def is_short(self):
        """Whether its runs take less than 60 s, all of them together, on one core."""
        return not self.timed and not self.animate and sum(run.cost for run in self.runs) < 60

    @property
    def image(self):
        return f"{self.name}.png" if self.draw else None

    @property
    def table_file(self):
        return f"{self.name}.csv" if self.table else None

    @property
    def animation(self):
        return f"{self.name}.gif" if self.animate else None
