# SPDX-License-Identifier: LGPL-2.1-or-later
"""The site as it is put together: where sources are, and where pages go."""

from __future__ import annotations

import functools
import pathlib
import posixpath
import shutil
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOC = ROOT / "doc"

# Order in which to read the programs. Others come after them.
ORDER = (
    "bar_sd",
    "bar_by_hand",
    "bar_ss",
    "spectral_radius",
    "elastic_ball",
    "disk_step_by_step",
    "hyperelastic_ring",
    "sphere",
    "obstacle_course",
    "colliding_disks",
    "colliding_spheres",
    "colliding_tori",
    "sliding_block",
    "stent_artery",
    "ricochet",
)


class SiteError(Exception):
    """A page cannot be made; the message is for the one who builds the site."""


@functools.cache
def steps() -> list[str]:
    """The names of all programs."""
    names = {path.parent.name for path in (ROOT / "steps").glob("*/*.cc")}
    return [name for name in ORDER if name in names] + sorted(names - set(ORDER))


@dataclass
class Site:
    """Target of the pages, and their sources."""

    #: The folder with the programs.
    programs: pathlib.Path
    #: The folder with the pages, for Sphinx.
    target: pathlib.Path
    #: The folder with pictures of figures: output/ of a checkout.
    output: pathlib.Path
    #: The pages that were written: "parameters/bar_sd".
    pages: list[str] = field(default_factory=list)

    @property
    def runs(self) -> pathlib.Path:
        """The folder with runs of the site itself; those that are complete are not made again."""
        return self.target.parent / "runs"

    def page(self, name: str, text: str) -> None:
        """Write the page `name`, which is Markdown."""
        path = self.target / f"{name}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.rstrip() + "\n", encoding="utf-8")
        self.pages.append(name)

    def extra(self, name: str) -> pathlib.Path:
        """The path of a file that goes into the site as it is."""
        path = self.target / "extra" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def copy(self, source: pathlib.Path, name: str) -> str:
        """Take a file into the site as it is. Returns its name there."""
        shutil.copyfile(source, self.extra(name))
        return name


def link(page: str, to: str) -> str:
    """The address of a page or file of the site, as seen from `page`."""
    return posixpath.relpath(to, posixpath.dirname(page) or ".")


def page_link(page: str, to: str, anchor: str = "") -> str:
    """The address of another page, and of a place in it."""
    return link(page, f"{to}.html") + (f"#{anchor}" if anchor else "")


def shown(path: pathlib.Path) -> str:
    """A path as one writes it in the checkout."""
    return path.resolve().relative_to(ROOT).as_posix()
