#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Make figures of the papers: run what is missing, draw, and check the numbers.

    figures/make.py C-6          one figure (several names may be given)
    figures/make.py all
    figures/make.py short        those that take seconds, one of each kind
    figures/make.py timed        those that show seconds, which "all" leaves out
    figures/make.py --list

Images, checks.csv and index.html go to output/figures/, runs to output/runs/.
The last lines are a table of our numbers beside the paper's and the exact ones;
the exit code is 1 if one of them is off, and 2 if a figure could not be made.
"""

import argparse
import collections
import fcntl
import os
import pathlib
import sys
import time

DEBIAN_PYTHON = "/usr/bin/python3"

try:
    import matplotlib
    import numpy  # noqa: F401
except ImportError:
    # Another Python may come first in the PATH; Debian's has the packages.
    if os.path.exists(DEBIAN_PYTHON) and not os.environ.get("RICOCHET_FIGURES_PYTHON"):
        os.environ["RICOCHET_FIGURES_PYTHON"] = DEBIAN_PYTHON
        os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, *sys.argv])
    sys.exit(
        "The figures need matplotlib and NumPy: install the package python3-matplotlib "
        "(apt-get install python3-matplotlib)."
    )

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402

import bodies  # noqa: E402
import obstacles  # noqa: E402
import paper_ab_ball  # noqa: E402
import paper_ab_ring  # noqa: E402
import paper_c_bars  # noqa: E402
import paper_c_spectral  # noqa: E402
import paper_c_sphere  # noqa: E402
import report  # noqa: E402
import runs  # noqa: E402

# To add figures: write a file like these two, and name it here.
GROUPS = (
    paper_ab_ball,
    paper_ab_ring,
    paper_c_spectral,
    paper_c_bars,
    paper_c_sphere,
    obstacles,
    bodies,
)

FIGURES = {figure.name: figure for group in GROUPS for figure in group.FIGURES}

plt.rcParams.update(
    {
        "figure.dpi": 100,
        "savefig.dpi": 160,
        "font.size": 10,
        "axes.titlesize": 11,
        "axes.grid": True,
        "grid.color": "0.9",
        "grid.linewidth": 0.6,
        "axes.axisbelow": True,
        "legend.frameon": False,
        "lines.linewidth": 1.2,
    }
)


def command_line():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "names", nargs="*", metavar="FIGURE", help="a name such as C-6, or all, short, timed"
    )
    parser.add_argument("--list", action="store_true", help="list the figures and stop")
    parser.add_argument(
        "--build-dir",
        type=pathlib.Path,
        default=runs.CHECKOUT / "build" / "release",
        help="folder with the programs (default: build/release of the checkout)",
    )
    parser.add_argument("--force", action="store_true", help="repeat runs that are there already")
    parser.add_argument(
        "--jobs",
        type=int,
        default=os.cpu_count() or 1,
        help="runs at the same time (default: the number of cores)",
    )
    arguments = parser.parse_args()
    if arguments.list:
        return arguments
    if not arguments.names:
        parser.error("name a figure, or all; --list shows the names")
    if arguments.jobs < 1:
        parser.error("--jobs must be at least 1")
    unknown = [name for name in arguments.names if name not in ("all", "short", "timed", *FIGURES)]
    if unknown:
        parser.error(f"no figure {', '.join(unknown)}; there are {', '.join(FIGURES)}")
    return arguments


def is_short(figure):
    """Whether its runs take less than a quarter of a minute, all of them together."""
    return not figure.timed and not figure.animate and sum(r.cost for r in figure.runs) < 15


def make(names, build_dir, jobs, force):
    """Make the figures; return whether all numbers are as they should be."""
    start = time.monotonic()
    figures = [
        figure
        for name, figure in FIGURES.items()
        if name in names
        or ("timed" if figure.timed else "all") in names
        or ("short" in names and is_short(figure))
    ]
    folder = runs.OUTPUT / "figures"
    folder.mkdir(parents=True, exist_ok=True)

    # Seconds are measured with nothing else at work.
    for timed in (False, True):
        wanted = [run for figure in figures if figure.timed == timed for run in figure.runs]
        if wanted:
            runs.ensure(wanted, build_dir, 1 if timed else jobs, force)

    checks = []
    for figure in figures:
        image = figure.draw()
        image.savefig(folder / figure.image, bbox_inches="tight")
        plt.close(image)
        print(f"  output/figures/{figure.image}", flush=True)
        if figure.animation:
            figure.animate(folder / figure.animation)
            print(f"  output/figures/{figure.animation}", flush=True)
        for check in figure.checks():
            check.figure = figure.name
            checks.append(check)

    report.write_csv(checks, folder / "checks.csv")
    report.write_html(figures, checks, folder / "index.html")
    print()
    report.print_table(checks)
    count = collections.Counter(check.status for check in checks)
    print(
        f"\n{count[report.YES]} checks passed, {count[report.NO]} failed, "
        f"{count[report.NOTE]} notes; {time.monotonic() - start:.0f} s; "
        "see output/figures/index.html"
    )
    return count[report.NO] == 0


def main():
    arguments = command_line()
    if arguments.list:
        for figure in FIGURES.values():
            print(f"{figure.name:<6} {figure.title}")
        return 0

    runs.OUTPUT.mkdir(exist_ok=True)
    with open(runs.OUTPUT / ".figures.lock", "w", encoding="utf-8") as lock:
        # Two of us would write into the same folders.
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            print("Another figures/make.py is at work in this checkout.", file=sys.stderr)
            return 2
        try:
            good = make(
                arguments.names, arguments.build_dir.resolve(), arguments.jobs, arguments.force
            )
        except runs.RunError as error:
            print(error, file=sys.stderr)
            return 2
        except KeyboardInterrupt:
            print("Interrupted; what has finished is kept.", file=sys.stderr)
            return 130
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
