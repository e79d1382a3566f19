# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces of Markdown and HTML."""

from __future__ import annotations

import functools
import html
import pathlib
import posixpath
import re
from collections.abc import Callable, Iterable, Sequence

from . import api, site

escape = html.escape

# The class of cells that a narrow screen leaves out.
NOTHING = ' class="nothing"'

_CODE_OR_MATH = re.compile(r"(`+[^`]+`+|\$\$.+?\$\$|\$[^$\n]+\$)", re.DOTALL)


def slug(text: str) -> str:
    """A name for an anchor, as docutils makes it of a text."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")


def plain(text: str) -> str:
    """Markdown that shows this text as it is."""
    return re.sub(r"([\\`*_\[\]<>$|#~])", r"\\\1", text)


def without_tags(text: str) -> str:
    """Markdown in which `<dim>` is a text and not a tag of HTML."""
    parts = _CODE_OR_MATH.split(text)
    parts[::2] = [re.sub(r"<(?=[A-Za-z/!])", r"\\<", part) for part in parts[::2]]
    return "".join(parts)


def prose(lines: Iterable[str]) -> str:
    """Markdown of the lines of a comment: tags escaped, but not in code that is indented."""
    pieces: list[str] = []
    paragraph: list[str] = []
    in_code = False
    for line in [*lines, ""]:
        # Code begins after an empty line; a paragraph may have indented lines too.
        in_code = line.startswith("    ") and (in_code or not paragraph)
        if line.strip() and not in_code:
            paragraph.append(line)
            continue
        if paragraph:
            pieces.append(without_tags("\n".join(paragraph)))
            paragraph = []
        pieces.append(line)
    return "\n".join(pieces).strip("\n")


def code(text: str, language: str = "text") -> str:
    """A block of code."""
    fence = "```"
    while fence in text:
        fence += "`"
    return f"{fence}{language}\n{text.rstrip()}\n{fence}"


def details(summary: str, content: str) -> str:
    """Markdown that is folded until one opens it; `summary` is HTML."""
    return f"<details>\n<summary>{summary}</summary>\n\n{content.strip()}\n\n</details>"


def table(
    columns: Sequence[str], rows: Iterable[Sequence[str]], classes: Sequence[str] = ()
) -> str:
    """A table of HTML cells; on a narrow screen each row becomes a block of its own.

    `classes` gives each row a class.
    """
    lines = ['<table class="stacking"><thead><tr>']
    lines += [f"<th>{escape(column)}</th>" for column in columns]
    lines.append("</tr></thead><tbody>")
    for number, row in enumerate(rows):
        of_row = f' class="{classes[number]}"' if number < len(classes) else ""
        cells = ""
        for column, cell in zip(columns, row):
            empty = NOTHING if cell in ("-", "–", "") else ""
            cells += f'<td data-label="{escape(column)}"{empty}>{cell}</td>'
        lines.append(f"<tr{of_row}>{cells}</tr>")
    lines.append("</tbody></table>")
    return "\n".join(lines)


def facts(pairs: Iterable[tuple[str, str]]) -> str:
    """Names with what belongs to them, as HTML."""
    lines = ['<dl class="facts">']
    lines += [f"<dt>{escape(name)}</dt><dd>{value}</dd>" for name, value in pairs]
    lines.append("</dl>")
    return "\n".join(lines)


def anchor(href: str, content: str) -> str:
    """A link as HTML; `content` is HTML, or Markdown where it stands in Markdown."""
    return f'<a href="{escape(href)}">{content}</a>'


def _inches(path: pathlib.Path) -> float:
    """The width of a picture on paper."""
    if path.suffix == ".svg":
        match = re.search(r'<svg[^>]*? width="([0-9.]+)pt"', path.read_text(encoding="utf-8"))
        return float(match[1]) / 72 if match else 6.0
    from PIL import Image

    with Image.open(path) as image:
        return float(image.width / image.info.get("dpi", (100,))[0])


def picture(path: pathlib.Path, address: str, alt: str) -> str:
    """A picture as HTML, which leads to itself at full size.

    On a narrow screen it is at least as wide as its letters need: they have some 10 points on
    paper, and are to have 9 pixels.
    """
    least = round(65 * _inches(path))
    return (
        f'<div class="picture"><a href="{address}"><img src="{address}" loading="lazy" '
        f'style="--least: {least}px" alt="{escape(alt)}"></a></div>'
    )


def with_pictures(content: str, page: str, folder: str = "") -> str:
    """Markdown in which pictures that stand alone lead to themselves at full size.

    Pictures have the same positions in doc/ and in the site: below `folder`, or, with a slash
    before them, at the place that they name.
    """

    def change(match: re.Match[str]) -> str:
        name = posixpath.normpath(posixpath.join("/", folder, match[2])).lstrip("/")
        return picture(site.DOC / name, site.link(page, name), match[1])

    return re.sub(r"^!\[([^\]]*)\]\(([^)\s:]+)\)$", change, content, flags=re.MULTILINE)


def toctree(entries: Iterable[str], caption: str = "", hidden: bool = True) -> str:
    """The directive that says which pages there are."""
    options = [":maxdepth: 1"]
    options += [":hidden:"] if hidden else []
    options += [f":caption: {caption}"] if caption else []
    return "\n".join(["```{toctree}", *options, "", *entries, "```"])


def headings_from(text: str, level: int) -> str:
    """Markdown whose highest heading has this level, and the others follow without gaps."""
    found = sorted({len(mark) for mark, _ in _headings(text)})
    new = {old: min(level + number, 6) for number, old in enumerate(found)}
    return _map_lines(
        text,
        lambda line: re.sub(r"^(#+)(?= )", lambda match: "#" * new.get(len(match[1]), level), line),
    )


def _map_lines(text: str, change: Callable[[str], str]) -> str:
    """Change each line that does not stand in a block of code."""
    result, fence = [], ""
    for line in text.split("\n"):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and not fence:
            fence = mark[1]
        elif mark and mark[1].startswith(fence):
            fence = ""
        elif not fence:
            line = change(line)
        result.append(line)
    return "\n".join(result)


def _headings(text: str) -> list[tuple[str, str]]:
    found: list[tuple[str, str]] = []

    def note(line: str) -> str:
        match = re.match(r"(#{1,6}) +(.*)", line)
        if match:
            found.append((match[1], match[2].strip()))
        return line

    _map_lines(text, note)
    return found


def has_section(text: str, heading: str) -> bool:
    return any(name == heading for _, name in _headings(text))


def section(text: str, heading: str) -> str:
    """Text under a heading, with the headings below it; empty if there is none."""
    level, inside, result, fence = 0, False, [], False
    for line in text.split("\n"):
        if re.match(r"\s*(```|~~~)", line):
            fence = not fence
        match = None if fence else re.match(r"(#{1,6}) +(.*)", line)
        if match and inside and len(match[1]) <= level:
            break
        if inside:
            result.append(line)
        elif match and match[2].strip() == heading:
            level, inside = len(match[1]), True
    return "\n".join(result).strip("\n")


# Links to files of the project, and the pages with their contents.
PAGES_OF_FILES = {
    "lib/README.md": "library",
    "examples": "examples/index",
    "examples/README.md": "examples/index",
    "figures/README.md": "how_to/figures",
    "python/README.md": "how_to/python",
    "benchmarks/README.md": "how_to/speed",
}


def with_links(text: str, page: str, folder: str = "") -> str:
    """Markdown of a file of the project, in `folder`, for a page of the site.

    Links to files within the site lead there; of others the text remains. Pictures are those of
    doc/images.
    """

    def own_picture(match: re.Match[str]) -> str:
        name = pathlib.PurePosixPath(match[2]).name
        return f"![{match[1]}](/images/{name})"

    def change(match: re.Match[str]) -> str:
        label, target = match[1], match[2]
        if re.match(r"[a-z]+:", target):
            return match[0]
        target, sharp, part = target.partition("#")
        if not target:
            return anchor(f"#{part}", label)
        path = posixpath.normpath(posixpath.join(folder, target))
        if path.startswith("doc/") and path.endswith(".md"):
            return anchor(site.page_link(page, path[4:-3]) + sharp + part, label)
        if path.startswith("doc/static/"):
            return anchor(site.link(page, f"_static/{path[11:]}"), label)
        if path.startswith("doc/notebooks/"):
            return anchor(site.page_link(page, path[4:].removesuffix(".ipynb")), label)
        if path.startswith("doc/") and path.endswith((".html", ".pdf", ".csv")):
            return anchor(site.link(page, path[4:]), label)
        if path in PAGES_OF_FILES:
            return anchor(site.page_link(page, PAGES_OF_FILES[path]), label)
        shown = path.startswith(("parameter_files/", "examples/"))
        if shown and path.endswith(".prm") and (site.ROOT / path).is_file():
            return anchor(parameter_file_link(page, path), label)
        return label

    text = re.sub(r"!\[([^\]]*)\]\(([^)\s]+)\)", own_picture, text)
    text = with_pictures(text, page)
    return re.sub(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)", change, text)


def parameter_file_label(path: str) -> str:
    """The anchor of a parameter file, named as in the checkout."""
    return "prm-" + slug(path.removeprefix("parameter_files/").removesuffix(".prm"))


def parameter_file_page(path: str) -> str:
    """The page that shows a parameter file."""
    folder = pathlib.PurePosixPath(path).parent.name
    return f"files/{'ricochet' if folder == 'examples' else folder}"


def parameter_file_link(page: str, path: str) -> str:
    return site.page_link(page, parameter_file_page(path), parameter_file_label(path))


_HEADER = re.compile(r"(?<![\[`>])`(?:lib/)?((?:\w+/)*\w+\.h)`")


@functools.cache
def _headers() -> dict[str, str]:
    """The headers of the library, by their paths below lib/ and by their names alone."""
    found = {}
    for path in (site.ROOT / "lib").rglob("*.h"):
        found[path.relative_to(site.ROOT / "lib").as_posix()] = found[path.name] = site.shown(path)
    return found


def with_headers(content: str, page: str) -> str:
    """Markdown in which headers of the library, as `contact/laws/penalty.h`, are links."""

    def change(match: re.Match[str]) -> str:
        file = _headers().get(match[1])
        return anchor(site.link(page, api.address(file)), match[0]) if file else match[0]

    return _map_lines(content, lambda line: _HEADER.sub(change, line))


_INCLUDE = re.compile(r"^<!-- include: (\S+)(?: # (.+?))? -->$", re.MULTILINE)


def with_includes(text: str, page: str) -> str:
    """Replace lines `<!-- include: README.md # Heading -->` by the text there.

    Without a heading the whole file is included, except for its title. Headings in it are put below
    the one that stands before the line.

    Raises:
        SiteError: there is no such file or heading.
    """

    def replace(match: re.Match[str]) -> str:
        name, heading = match[1], match[2]
        path = site.ROOT / name
        if not path.is_file():
            raise site.SiteError(f"{page}: there is no file {name} to include.")
        content = path.read_text(encoding="utf-8")
        content = section(content, heading) if heading else _without_title(content)
        if heading and not content:
            raise site.SiteError(f"{page}: {name} has nothing under the heading '{heading}'.")
        before = _headings(text[: match.start()])
        level = len(before[-1][0]) + 1 if before else 2
        folder = pathlib.PurePosixPath(name).parent.as_posix()
        return headings_from(with_links(content, page, "" if folder == "." else folder), level)

    return _INCLUDE.sub(replace, text)


def _without_title(text: str) -> str:
    text = re.sub(r"\A<!--.*?-->\s*", "", text, flags=re.DOTALL)
    return re.sub(r"\A# .*\n", "", text).strip("\n")
