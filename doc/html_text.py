# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of a page for the checkers: its links, its anchors and its prose."""

from __future__ import annotations

import html.parser
import pathlib
from dataclasses import dataclass, field

# Elements without an end.
EMPTY = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source",
         "track", "wbr"}  # fmt: skip
# Elements without prose.
SILENT = {"script", "style", "pre", "code", "kbd", "svg", "math", "nav", "footer", "form"}
SILENT_CLASSES = {"math", "highlight", "headerlink", "toc-drawer", "sidebar-drawer", "sig", "skip"}
# After these a sentence does not go on.
BLOCKS = {"p", "li", "td", "th", "dt", "dd", "h1", "h2", "h3", "h4", "h5", "h6", "summary", "div"}


@dataclass
class Page:
    """A page of HTML."""

    #: Addresses in href, src and poster.
    links: list[str] = field(default_factory=list)
    #: Targets of links behind their "#".
    anchors: set[str] = field(default_factory=set)
    #: The prose of the element <article>, or of all if there is none.
    prose: str = ""


class _Reader(html.parser.HTMLParser):
    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.page = Page()
        self.open: list[tuple[str, bool]] = []
        self.text: list[str] = []
        self.has_article = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        for name in ("href", "src", "poster"):
            if name in values:
                self.page.links.append(values[name])
        for name in ("id", "name"):
            if name in values:
                self.page.anchors.add(values[name])
        if tag == "article" and not self.has_article:
            self.has_article = True
            self.text.clear()
        if tag in BLOCKS or tag == "br":
            self.text.append("\n")
        if tag not in EMPTY:
            classes = set(values.get("class", "").split())
            silent = tag in SILENT or bool(classes & SILENT_CLASSES)
            self.open.append((tag, silent))

    def handle_endtag(self, tag: str) -> None:
        if tag in (name for name, _ in self.open):
            while self.open.pop()[0] != tag:
                pass

    def handle_data(self, data: str) -> None:
        in_article = not self.has_article or any(name == "article" for name, _ in self.open)
        if in_article and not any(silent for _, silent in self.open):
            self.text.append(data)


def read(path: pathlib.Path) -> Page:
    """Read a page."""
    reader = _Reader()
    reader.feed(path.read_text(encoding="utf-8", errors="replace"))
    reader.page.prose = "".join(reader.text)
    return reader.page
