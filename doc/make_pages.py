#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the sources of the site's pages, and the API.

    python3 doc/make_pages.py --programs build/release --to build/doc/source
    python3 doc/make_pages.py --api output/doc
    python3 doc/make_pages.py --without-api output/doc

The first is for Sphinx; the second is Doxygen's work, or the third removes the links to it.
scripts/docs.sh calls them.
"""

from __future__ import annotations

import argparse
import pathlib
import shutil
import sys
import time

import make_cheat_sheet
from generate import (
    api,
    examples,
    figures,
    how_to,
    methods,
    parameters,
    results,
    run_pages,
    site,
    slides,
    steps,
)

MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")


def copy_mathjax(made: site.Site) -> None:
    """Files for formulas, so that the site needs no network: TeX in, SVG out."""
    for part in ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/input/TeX",
                 "jax/element", "jax/output/SVG"):  # fmt: skip
        source, target = MATHJAX / part, made.extra(f"_static/mathjax/{part}")
        if source.is_dir():
            shutil.copytree(source, target, dirs_exist_ok=True, ignore=only_fonts_of_tex)
        else:
            shutil.copyfile(source, target)


def only_fonts_of_tex(folder: str, names: list[str]) -> list[str]:
    return [name for name in names if folder.endswith("SVG/fonts") and name != "TeX"]


def copy_pictures(made: site.Site) -> None:
    """The pictures of README.md, which other pages include."""
    for path in (site.DOC / "images").iterdir():
        made.copy(path, f"images/{path.name}")


def copy_notebooks(made: site.Site) -> None:
    """The notebooks, which index.md lists."""
    for path in how_to.notebooks():
        target = made.target / "notebooks" / path.name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)
        made.copy(path, f"notebooks/{path.name}")  # to be downloaded


def write_pages(arguments: argparse.Namespace) -> None:
    """All pages but those of the API."""
    shutil.rmtree(arguments.to, ignore_errors=True)
    folders = (arguments.programs, arguments.to, arguments.output)
    made = site.Site(*(folder.resolve() for folder in folders))
    gallery = figures.Gallery(made)
    runs: dict[str, str] = {}
    for name, work in (
        ("runs", lambda: runs.update({} if arguments.short else run_pages.of_tutorials(made))),
        ("tutorials", lambda: steps.make(made, gallery, runs)),
        ("parameters", lambda: parameters.make(made)),
        ("figures", lambda: figures.make(made, gallery, runs)),
        ("slides", lambda: slides.make(made, gallery)),
        ("examples", lambda: examples.make(made)),
        ("methods", lambda: methods.make(made)),
        ("results", lambda: results.make(made)),
        ("pages by hand", lambda: how_to.make(made)),
        ("cheat sheet", lambda: make_cheat_sheet.write(
            made.programs / "ricochet", made.extra("teaching/conserves.pdf"))),
        ("pictures", lambda: copy_pictures(made)),
        ("notebooks", lambda: copy_notebooks(made)),
        ("MathJax", lambda: copy_mathjax(made)),
    ):
        begin = time.monotonic()
        work()
        print(f"  {name}: {time.monotonic() - begin:.1f} s", flush=True)
    print(f"{len(made.pages)} pages")


def write_api(output: pathlib.Path) -> int:
    """The pages of Doxygen; returns the number of its unknown warnings."""
    warnings = api.make(output.resolve(), site.ROOT / "build" / "doc")
    new = api.not_known(warnings)
    for warning in new:
        print(warning, file=sys.stderr)
    print(f"API: {len(warnings)} warnings, {len(new)} of them new")
    return len(new)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--programs", type=pathlib.Path, default=site.ROOT / "build/release")
    parser.add_argument("--to", type=pathlib.Path, help="where the pages go")
    parser.add_argument("--output", type=pathlib.Path, default=site.ROOT / "output")
    parser.add_argument("--short", action="store_true", help="leave out the runs of tutorials")
    parser.add_argument("--api", type=pathlib.Path, help="where the API goes: into api/ of this")
    parser.add_argument(
        "--without-api", type=pathlib.Path, help="the site in which links to the API become words"
    )
    arguments = parser.parse_args()
    try:
        if arguments.to:
            write_pages(arguments)
        if arguments.without_api:
            api.remove_links(arguments.without_api)
        return 1 if arguments.api and write_api(arguments.api) else 0
    except site.SiteError as error:
        print(error, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
