# SPDX-License-Identifier: LGPL-2.1-or-later
"""A tutorial page for each program of steps/: its comments as prose, its code in between."""

from __future__ import annotations

import functools
import pathlib
import re
from dataclasses import dataclass, field

from . import figures, site, text

FOLDER = "steps"

@dataclass
class Block:
    """Lines of a program that belong together."""

    is_prose: bool
    lines: list[str] = field(default_factory=list)


@dataclass
class Step:
    """A program as a tutorial."""

    name: str
    title: str
    introduction: str
    blocks: list[Block]
    n_lines: int

    @property
    def page(self) -> str:
        return f"{FOLDER}/{self.name}"


def source(name: str) -> pathlib.Path:
    return site.ROOT / "steps" / name / f"{name}.cc"


_LITERAL = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'')


def _depth(line: str) -> int:
    """By how much a line of code changes the depth in round brackets."""
    code = _LITERAL.sub("", line).split("//")[0]
    return code.count("(") - code.count(")")


def blocks_of(lines: list[str]) -> list[Block]:
    """Split a program into prose and code.

    Prose is a comment that has whole lines for itself, at the beginning of the line or of
    several lines within a function, but not within an expression, nor one for Doxygen.
    """
    blocks: list[Block] = []
    depth = 0
    number = 0
    while number < len(lines):
        end = number
        while end < len(lines) and re.match(r"\s*//(?!/)", lines[end]):
            end += 1
        if end > number and depth == 0 and (lines[number][0] == "/" or end > number + 1):
            blocks.append(
                Block(True, [re.sub(r"^\s*// ?", "", line) for line in lines[number:end]])
            )
            number = end
            continue
        if not blocks or blocks[-1].is_prose:
            blocks.append(Block(False))
        blocks[-1].lines.append(lines[number])
        depth += _depth(lines[number])
        number += 1
    return [block for block in blocks if any(line.strip() for line in block.lines)]


@functools.cache
def read(name: str) -> Step:
    """Read a program.

    Raises:
        SiteError: it does not begin with the licence and an introduction with a title.
    """
    lines = source(name).read_text(encoding="utf-8").splitlines()
    if not lines[0].startswith("// SPDX"):
        raise site.SiteError(f"steps/{name}: the first line is not the licence.")
    blocks = blocks_of(lines[1:])
    first = blocks[0]
    if not first.is_prose or not first.lines[0].startswith("# "):
        raise site.SiteError(f"steps/{name}: there is no introduction that begins with '# '.")
    return Step(
        name,
        first.lines[0].removeprefix("# ").strip(),
        text.prose(first.lines[1:]),
        blocks[1:],
        len(lines),
    )


def program_text(step: Step) -> str:
    """The program as Markdown: prose, and blocks of code in their order."""
    pieces = []
    for block in step.blocks:
        if block.is_prose:
            pieces.append(text.prose(block.lines))
        else:
            lines = "\n".join(block.lines).strip("\n").split("\n")
            pieces.append(text.code("\n".join(lines), "cpp"))
    return text.headings_from("\n\n".join(pieces), 3)


def _own_text(step: Step) -> tuple[str, str]:
    """The text of doc/tutorials for a step: on its results, and its exercises."""
    path = site.DOC / "tutorials" / f"{step.name}.md"
    if not path.is_file():
        return "", ""
    content = path.read_text(encoding="utf-8")
    content = re.sub(r"\A<!--.*?-->\s*(# [^\n]*\n)?", "", content, flags=re.DOTALL)
    content = text.with_includes(content, step.page)
    content = text.with_pictures(content, step.page, path.parent.name)
    before, heading, exercises = content.partition("## Exercises\n")
    return (
        text.headings_from(before.strip(), 3),
        text.headings_from(heading + exercises, 2) if heading else "",
    )


def page_text(step: Step, gallery: figures.Gallery, run: str | None) -> str:
    """The whole page of a step. `run`: the name of the page with a run of it."""
    results, exercises = _own_text(step)
    shown = [results]
    for figure in gallery.of_program(step.name):
        shown.append(gallery.section(figure, step.page, level=3, folded=True))
    if not any(shown):
        shown.append(
            "No figure is made of this program. Run it as the introduction says, and look at its "
            "table and its fields."
        )
    links = text.facts(
        [
            (
                "source",
                f"<code>{site.shown(source(step.name))}</code>, {step.n_lines} lines",
            ),
            (
                "parameters",
                text.anchor(
                    site.page_link(step.page, f"parameters/{step.name}"), "all keys of the program"
                ),
            ),
            (
                "parameter files",
                text.anchor(
                    site.page_link(step.page, f"files/{step.name}"),
                    f"<code>parameter_files/{step.name}/</code>",
                ),
            )
            if (site.ROOT / "parameter_files" / step.name).is_dir()
            else ("parameter files", "none; its defaults are the case"),
            *(
                [("to turn and play", text.anchor(site.link(step.page, run), "a run in the browser"))]
                if run
                else []
            ),
        ]
    )
    page = "\n\n".join(
        [
            f"# {step.title}",
            links,
            text.headings_from(step.introduction, 2),
            "## Results",
            *[part for part in shown if part],
            exercises,
            "## The program",
            program_text(step),
        ]
    )
    return text.with_headers(page, step.page)


def make(made: site.Site, gallery: figures.Gallery, runs: dict[str, str]) -> None:
    """Write the pages of all programs, and their list. `runs`: names of pages with runs of them."""
    names = site.steps()
    for name in names:
        step = read(name)
        made.page(step.page, page_text(step, gallery, runs.get(name)))
    rows = [
        (
            text.anchor(f"{name}.html", f"<code>{name}</code>"),
            text.escape(read(name).title),
            ", ".join(
                text.anchor(
                    site.page_link(f"{FOLDER}/index", gallery.page(figure), figure.anchor),
                    text.escape(figure.name),
                )
                for figure in gallery.of_program(name)
            )
            or "–",
        )
        for name in names
    ]
    made.page(
        f"{FOLDER}/index",
        "\n\n".join(
            [
                "# Tutorials: one page per program",
                "Each page is made of the program's own source: what it computes, with its "
                "equations; the code in its order; what comes out; exercises. Begin with the "
                "first one.",
                text.table(("program", "what it computes", "figures"), rows),
                text.toctree(names),
            ]
        ),
    )
