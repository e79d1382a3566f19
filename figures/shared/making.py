# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes figures: runs what is missing, draws, checks, and writes table and page."""

import collections
import time

import matplotlib.pyplot as plt

from ricochet import RicochetError

from . import keeping, paper_numbers, report, runs
from .figure import DIFFERS, NO, YES

LOOK = {
    "figure.dpi": 100,
    "savefig.dpi": 200,
    "font.size": 10,
    "axes.titlesize": 11,
    "axes.grid": True,
    "grid.color": "0.9",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "lines.linewidth": 1.2,
}


def _draw(figure, folder):
    """Write the image of a figure, its table and its animation."""
    if figure.image:
        image = figure.draw()
        image.savefig(folder / figure.image, bbox_inches="tight")
        plt.close(image)
        print(f"  output/figures/{figure.image}", flush=True)
    if figure.table:
        report.write_table(figure.table(), folder / figure.table_file)
        print(f"  output/figures/{figure.table_file}", flush=True)
    if figure.animation:
        figure.animate(folder / figure.animation)
        print(f"  output/figures/{figure.animation}", flush=True)


def _checks(figure):
    """The rows of a figure.

    Raises:
        RicochetError: they leave out a number that is written down for the figure, or have one
            of another.
    """
    rows = figure.checks()
    asked = {row.number for row in rows if row.number}
    written = paper_numbers.of_figure(figure.name)
    if asked != written:
        raise RicochetError(
            f"{figure.name} does not check what figures/numbers has for it: "
            f"{', '.join(sorted(asked ^ written))}."
        )
    for row in rows:
        row.figure = figure.name
    return rows


def make(figures, build_dir, jobs, force, keep=False):
    """Make the figures; return whether all numbers are as they should be.

    With `keep` they go into the repository, too, if so.
    """
    start = time.monotonic()
    commit = keeping.commit(build_dir) if keep else None
    folder = runs.OUTPUT / "figures"
    folder.mkdir(parents=True, exist_ok=True)

    # Seconds are measured with nothing else at work.
    for timed in (False, True):
        wanted = [run for figure in figures if figure.timed == timed for run in figure.runs]
        if wanted:
            runs.ensure(wanted, build_dir, 1 if timed else jobs, force)

    plt.rcParams.update(LOOK)
    checks = []
    for figure in figures:
        _draw(figure, folder)
        checks += _checks(figure)

    report.write_csv(checks, folder / "checks.csv")
    report.write_html(figures, checks, folder / "index.html")
    print()
    report.print_table(checks)
    count = collections.Counter(check.status for check in checks)
    print(
        f"\n{count[YES]} checks passed, {count[NO]} failed, "
        f"{count[DIFFERS]} differ from the paper as written down; "
        f"{time.monotonic() - start:.0f} s; see output/figures/index.html"
    )
    if keep and count[NO] == 0:
        keeping.keep(figures, checks, commit, folder)
        print(f"Small copies of {len(figures)} figures, and the checks: figures/kept/")
    return count[NO] == 0
