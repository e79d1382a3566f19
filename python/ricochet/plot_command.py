# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the results of runs: energies, contact forces and gaps over time, and the bodies.

For several runs the curves are in the same axes, and legends name the differences between the runs.
For the folder of a set-up (ricochet FILE.prm --validate --output-dir FOLDER) the bodies are drawn
with the names of their boundaries. Images go to FOLDER, without -o to `plots` in the folder of the
first run.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import resource
import signal
import sys
import traceback
from collections.abc import Callable, Sequence

from .errors import RicochetError
from .fields import COLOURS
from .results import Run


def command_line(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """The options of the command."""
    parser = argparse.ArgumentParser(
        prog="ricochet-plot",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("runs", nargs="+", metavar="RUN", help="the folder of a run")
    parser.add_argument("-o", "--output", metavar="FOLDER", type=pathlib.Path, help="where to")
    parser.add_argument(
        "--fields", action="store_true", help="also pictures of the deformed bodies, by VTK"
    )
    parser.add_argument(
        "--animation", choices=("gif", "mp4"), help="the bodies in motion; mp4 needs ffmpeg"
    )
    parser.add_argument(
        "--html",
        action="store_true",
        help="the bodies in motion and the energies as one page for a browser, below 10 MB",
    )
    parser.add_argument(
        "--colour",
        choices=tuple(COLOURS),
        help="what bodies are coloured by (default: von_mises; of bars stress)",
    )
    parser.add_argument(
        "--frames",
        type=int,
        default=100,
        metavar="N",
        help="an animation or a page has at most so many frames (default: 100)",
    )
    return parser.parse_args(arguments)


def plot(
    runs: Sequence[Run],
    folder: pathlib.Path,
    fields: bool = False,
    animation: str | None = None,
    colour: str | None = None,
    frames: int = 100,
    as_page: bool = False,
) -> list[pathlib.Path]:
    """Draw runs into a folder; return the files. `colour` is one of `fields.COLOURS`.

    Raises:
        RicochetError: a run cannot be read, or something that draws is missing.
    """
    from . import curves, page, pictures

    if animation == "mp4":
        pictures.check_ffmpeg()
    needs_fields = fields or animation or as_page
    colours = [pictures.check_colour(run, colour) if needs_fields else "" for run in runs]
    lines = curves.lines_of(runs)
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    with curves.settings():
        for name, figure in (
            ("energies", curves.energies(lines)),
            ("contact_forces", curves.contact_forces(lines)),
            ("gaps", curves.gaps(lines)),
        ):
            if figure is not None:
                files.append(curves.save(figure, folder / f"{name}.png"))
        endings = [""] if len(runs) == 1 else [f"_{n}" for n in range(1, len(runs) + 1)]
        titles: list[str | None] = [None] if len(runs) == 1 else [curves.plain(line.label) for line in lines]
        for run, shown, ending, title in zip(runs, colours, endings, titles):
            if fields:
                path = folder / f"fields_{shown}{ending}.png"
                files.append(pictures.draw_instants(run, shown, path, title))
            if animation:
                path = folder / f"animation_{shown}{ending}.{animation}"
                files.append(pictures.animate(run, shown, path, title, frames))
            if as_page:
                path = folder / f"run{ending}.html"
                files.append(page.write(run, path, shown, pictures.palette(), frames))
    return files


def main(arguments: Sequence[str] | None = None) -> int:
    """The command; returns its exit code: 0, or 2 with one sentence if it cannot be done."""
    options = command_line(arguments)
    return _in_a_process_of_its_own(lambda: _draw(options))


def _in_a_process_of_its_own(action: Callable[[], int]) -> int:
    """The result of an action in a child process; VTK crashes on some damaged files, or takes all
    memory."""
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 5 * 4
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            code = action()
        except MemoryError:
            print("ricochet-plot: There is not enough memory.", file=sys.stderr)
            code = 2
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    while True:
        try:
            status = os.waitpid(child, 0)[1]
            break
        except KeyboardInterrupt:
            # The child gets it, too.
            continue
    if os.WIFSIGNALED(status):
        name = signal.Signals(os.WTERMSIG(status)).name
        print(
            f"ricochet-plot: VTK crashed ({name}): a file of fields may be damaged.",
            file=sys.stderr,
        )
        return 2
    return os.waitstatus_to_exitcode(status)


def _draw(options: argparse.Namespace) -> int:
    try:
        from . import setup_picture

        setups = [p for p in map(pathlib.Path, options.runs) if setup_picture.is_setup(p)]
        for setup in setups:
            from . import curves

            with curves.settings():
                print(
                    curves.save(setup_picture.draw(setup), (options.output or setup) / "setup.png")
                )
        if len(setups) == len(options.runs):
            return 0
        runs = [Run(folder) for folder in options.runs if pathlib.Path(folder) not in setups]
        folder = options.output or runs[0].folder / "plots"
        for file in plot(
            runs,
            folder,
            options.fields,
            options.animation,
            options.colour,
            options.frames,
            options.html,
        ):
            print(file)
    except (RicochetError, OSError) as error:
        print(f"ricochet-plot: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    return 0
