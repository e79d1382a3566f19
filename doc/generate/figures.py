# SPDX-License-Identifier: LGPL-2.1-or-later
"""The gallery: each figure with its picture, caption, runs and numbers."""

from __future__ import annotations

import csv
import importlib
import pathlib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ricochet import prm
from shared import finding, keeping  # of figures/

from . import site, text

FOLDER = "gallery"

# Parameters of output, without effect on the computed problem.
NOT_TOLD = prm.ASIDE

COLUMNS = ("quantity", "paper", "exact", "ours", "ok?", "criterion")
VERDICTS = {
    "yes": "the number meets its criterion",
    "NO": "it does not",
    "note": "a statement of the paper that does not hold in our results",
    "info": "a number without a criterion",
}


@dataclass(frozen=True)
class Entry:
    """A figure, with the folder of figures/ in which it is."""

    figure: Any  # shared.figure.Figure
    group: str

    @property
    def name(self) -> str:
        return str(self.figure.name)

    @property
    def anchor(self) -> str:
        return "figure-" + text.slug(self.name)

    @property
    def programs(self) -> list[str]:
        """The programs whose results it shows."""
        if self.figure.runs:
            return sorted({run.program for run in self.figure.runs})
        if self.group == "bars":
            return ["bar_ss" if "1D-SS" in self.figure.title else "bar_sd"]
        return [self.group]


def load() -> list[Entry]:
    """All figures, group by group, those of a paper in their order."""
    order = list(finding.find())
    folder = site.ROOT / "figures"
    entries = [
        Entry(importlib.import_module(f"{path.parent.name}.{path.stem}").FIGURE, path.parent.name)
        for path in [*folder.glob("*/figure_*.py"), *folder.glob("*/table_*.py")]
    ]
    groups = {name: number for number, name in enumerate(["bars", *site.steps()])}
    return sorted(entries, key=lambda each: (groups.get(each.group, 99), order.index(each.name)))


def _title(group: str) -> tuple[str, str]:
    """Title and introduction of a group, from the docstring of its folder."""
    words = (importlib.import_module(group).__doc__ or group).strip()
    title = " ".join(words.partition("\n\n")[0].split()).removesuffix(".")
    before, _, after = title.partition(": ")
    short = after if before.startswith("Paper") and after else before
    return short[:1].upper() + short[1:], words


def _rows(folder: pathlib.Path) -> dict[str, list[dict[str, str]]]:
    """The checks of the figures in a folder."""
    rows: dict[str, list[dict[str, str]]] = {}
    table = folder / "checks.csv"
    if table.is_file():
        with table.open(newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                rows.setdefault(row["figure"], []).append(row)
    return rows


class Gallery:
    """The figures, and their files: those of output/figures, or the small ones of figures/kept."""

    def __init__(self, made: site.Site, kept: pathlib.Path = keeping.FOLDER) -> None:
        self.site = made
        self.entries = load()
        self.pictures = made.output / "figures"
        self.kept = kept
        self.kept_of = keeping.made(kept)
        self.rows = _rows(kept) | _rows(self.pictures)
        for entry in self.entries:
            self._take_pictures(entry)

    def _take_pictures(self, entry: Entry) -> None:
        for name in (entry.figure.image, entry.figure.animation):
            source = self.file(name)
            if source:
                self.site.copy(source, f"{FOLDER}/pictures/{name}")
        source = self.file(entry.figure.image)
        if source:
            thumbnail(source, self.site.extra(f"{FOLDER}/thumbnails/{entry.name}.png"))

    def file(self, name: str | None) -> pathlib.Path | None:
        """A picture, an animation or a table, where it is."""
        for folder in (self.pictures, self.kept):
            if name and (folder / name).is_file():
                return folder / name
        return None

    def has_picture(self, entry: Entry) -> bool:
        return self.file(entry.figure.image) is not None

    def is_made(self, entry: Entry) -> bool:
        return self.file(entry.figure.image or entry.figure.table_file) is not None

    def is_kept(self, entry: Entry) -> bool:
        """Whether the figure is the one of the repository, as it has not been made here."""
        file = self.file(entry.figure.image or entry.figure.table_file)
        return file is not None and file.parent == self.kept

    def thumbnail_of(self, entry: Entry) -> str | None:
        """For a card."""
        if self.has_picture(entry):
            return f"thumbnails/{entry.name}.png"
        return None if self.is_made(entry) else ""

    def page(self, entry: Entry) -> str:
        return f"{FOLDER}/{entry.group}"

    def of_program(self, program: str) -> list[Entry]:
        return [entry for entry in self.entries if program in entry.programs]

    def groups(self) -> list[str]:
        return list(dict.fromkeys(entry.group for entry in self.entries))

    # Parts of a page --------------------------------------------------------

    def _picture(self, entry: Entry, page: str) -> str:
        figure = entry.figure
        command = f"figures/make.py {entry.name}"
        seconds = max(1, round(sum(run.cost for run in figure.runs)))
        takes = f"its runs take about {seconds} s on one core" if figure.runs else "it needs no run"
        if not self.is_made(entry):
            return (
                f'<p class="missing">This figure has not been made. <code>{command}</code> makes '
                f"it; {takes}.</p>"
            )
        lines = []
        for name, what in ((figure.image, ""), (figure.animation, ", moving")):
            source = self.file(name)
            if source:
                address = site.link(page, f"{FOLDER}/pictures/{name}")
                lines.append(text.picture(source, address, figure.title + what))
        source = self.file(figure.table_file)
        if source:
            with source.open(newline="", encoding="utf-8") as file:
                header, *rows = csv.reader(file)
            cells = [[text.escape(cell) for cell in row] for row in rows]
            lines.append(text.table(header, cells))
        if self.is_kept(entry):
            date, commit = self.kept_of[entry.name]
            moving = " and moving" if figure.animation else ""
            lines.append(
                f'<p class="kept">Made on {date} with commit <code>{commit}</code> and kept in small. '
                f"<code>{command}</code> makes it at full size{moving}; {takes}.</p>"
            )
        return "\n".join(lines)

    def _curves(self, entry: Entry, page: str) -> str:
        """The parameter files of the runs, each with the changes on the command line."""
        overrides: dict[tuple[str, str], dict[str, list[str]]] = {}
        counts: dict[tuple[str, str], int] = {}
        for run in entry.figure.runs:
            key = (run.program, run.parameter_file)
            counts[key] = counts.get(key, 0) + 1
            changed = overrides.setdefault(key, {})
            for assignment in run.overrides:
                name, value = prm.parse_assignment(assignment)
                values = changed.setdefault(name, [])
                if value not in values and not name.startswith(NOT_TOLD):
                    values.append(value)
        rows = []
        for (program, file), changed in overrides.items():
            what = f"<code>{text.escape(program)}</code>, its defaults"
            if file:
                path = f"parameter_files/{file}"
                href = text.parameter_file_link(page, path)
                what = text.anchor(href, f"<code>{text.escape(file)}</code>")
            told = [
                f"<code>{text.escape(name)}</code> = {_some(values)}"
                for name, values in changed.items()
                if values
            ]
            rows.append((what, "<br>".join(told) or "–", str(counts[program, file])))
        return text.table(("parameter file", "changed on the command line", "runs"), rows)

    def _numbers(self, entry: Entry) -> str:
        found = self.rows.get(entry.name, [])
        cells = [[text.escape(row[column]) for column in COLUMNS] for row in found]
        return text.table(COLUMNS, cells, [f"check-{row['ok?'].lower()}" for row in found])

    def section(self, entry: Entry, page: str, level: int, folded: bool) -> str:
        """All there is of a figure, under a heading."""
        figure = entry.figure
        parts = [
            f"{'#' * level} {text.plain(f'{entry.name}: {figure.title}')}",
            self._picture(entry, page),
            text.without_tags(figure.caption),
        ]
        if not folded:
            parts.insert(0, f"({entry.anchor})=")
        parts.append(f"Command: `figures/make.py {entry.name}`")
        n_rows = len(self.rows.get(entry.name, []))
        if n_rows:
            content = self._numbers(entry)
            parts.append(
                text.details(f"{n_rows} numbers: ours, the paper's, the exact ones", content)
                if folded
                else content
            )
        elif self.is_made(entry):
            parts.append(
                "The table of numbers that is there is of another call of `figures/make.py`, "
                "without this figure."
            )
        if figure.runs:
            n_runs = len({run.folder for run in figure.runs})
            what = "1 run" if n_runs == 1 else f"{n_runs} runs"
            parts.append(text.details(f"{what}, by parameter files", self._curves(entry, page)))
        return "\n\n".join(parts)


def _some(values: list[str], most: int = 10) -> str:
    shown = [f"<code>{text.escape(value)}</code>" for value in values[:most]]
    if len(values) > most:
        shown.append(f"and {len(values) - most} more")
    return ", ".join(shown)


def thumbnail(source: Any, target: Any, width: int = 360) -> None:
    """A small copy of a picture."""
    from PIL import Image

    with Image.open(source) as picture:
        small = picture.convert("RGB")
        small.thumbnail((width, 2 * width))
        small.save(target, optimize=True)


def cards(items: Sequence[tuple[str, str | None, str]]) -> str:
    """Small pictures in a row, each a link: (address, picture, title), as HTML.

    The picture is "" if it is not made, None if there is a table instead.
    """
    lines = ['<div class="cards">']
    for href, picture, title in items:
        image = (
            f'<img src="{picture}" alt="" loading="lazy">'
            if picture
            else f'<span class="no-picture">{"table" if picture is None else "not made"}</span>'
        )
        lines.append(f'<a class="card" href="{href}">{image} <span>{text.escape(title)}</span></a>')
    lines.append("</div>")
    return "\n".join(lines)


def make(made: site.Site, gallery: Gallery, runs: dict[str, str]) -> None:
    """Write a page for each group of figures, and the overview. `runs`: as of `steps.make`."""
    n_made = sum(
        gallery.is_made(entry) and not gallery.is_kept(entry) for entry in gallery.entries
    )
    n_kept = sum(map(gallery.is_kept, gallery.entries))
    n_checks = sum(map(len, gallery.rows.values()))
    failed = sum(row["ok?"] == "NO" for rows in gallery.rows.values() for row in rows)
    overview = [
        "# Figures of the papers",
        f"There are {len(gallery.entries)} figures, of which {n_made or 'none'} have been made here"
        f"{f' and {n_kept} are small copies that are kept in the repository' if n_kept else ''}; "
        f"{n_checks} numbers were checked, {failed or 'none'} of them {'is' if failed == 1 else 'are'} "
        "off. `figures/make.py all` makes "
        "all, `figures/make.py C-6` one of them, with the runs that it needs. Letters A, B and C "
        "are the papers; figures with other letters are our own. Those that have been made are also "
        f"{text.anchor('slides.html', 'slides')}, to be shown or printed.",
    ]
    for group in gallery.groups():
        page = f"{FOLDER}/{group}"
        title, introduction = _title(group)
        entries = [entry for entry in gallery.entries if entry.group == group]
        programs = sorted({name for entry in entries for name in entry.programs})
        links = [
            text.anchor(site.page_link(page, f"steps/{name}"), f"<code>{name}</code>")
            for name in programs
            if name in site.steps()
        ] + [
            text.anchor(site.link(page, runs[name]), f"a run of {name} to turn and play")
            for name in programs
            if name in runs
        ]
        verdicts = ", ".join(f"*{name}*: {what}" for name, what in VERDICTS.items())
        made.page(
            page,
            "\n\n".join(
                [
                    f"# {text.plain(title)}",
                    text.without_tags(introduction),
                    f"How it is computed: {', '.join(links)}.",
                    text.details("What the column “ok?” says", verdicts + "."),
                    *(gallery.section(entry, page, level=2, folded=False) for entry in entries),
                ]
            ),
        )
        overview += [
            f"## {text.plain(title)}",
            cards(
                [
                    (
                        f"{group}.html#{entry.anchor}",
                        gallery.thumbnail_of(entry),
                        f"{entry.name}: {_short(entry.figure.title)}",
                    )
                    for entry in entries
                ]
            ),
        ]
    overview.append(text.toctree(gallery.groups()))
    made.page(f"{FOLDER}/index", "\n\n".join(overview))


def _short(title: str) -> str:
    """A title without the benchmark, which stands above it."""
    return re.sub(r"^(Elastic ball|Hyperelastic ring|Ring|1D-S[DS])[:,] ", "", title)
