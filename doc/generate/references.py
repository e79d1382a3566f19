# SPDX-License-Identifier: LGPL-2.1-or-later
"""Literature: entries of doc/references.bib, doc/literature.md, and lists at the ends of pages.

Pages cite an entry by a link to its place in doc/literature.md, whose text is its label:

    [Yeoh 1993](../literature.md#yeoh1993)

    python3 -m generate.references        in doc/: writes doc/literature.md
"""

from __future__ import annotations

import functools
import pathlib
import re
from collections.abc import Iterable
from dataclasses import dataclass

from . import site, text

PAGE = site.DOC / "literature.md"
GROUPS = {
    "papers": "The three papers",
    "time": "Time integration",
    "contact": "Contact",
    "friction": "Friction",
    "materials": "Materials and viscosity",
    "benchmarks": "Benchmarks, and other codes",
}
BEGIN, END = "<!-- literature: begin (made of references.bib) -->", "<!-- literature: end -->"

_ENTRY = re.compile(r"^@\w+\{([\w-]+),\n(.*?)^\}$", re.MULTILINE | re.DOTALL)
_FIELD = re.compile(r"^ +(\w+) += \{(.*)\},$", re.MULTILINE)
_CITED = re.compile(r"\[([^\]]+)\]\((?:[\w./]*/)?literature\.md#([\w-]+)\)")


@dataclass(frozen=True)
class Entry:
    """A reference; fields that BibTeX does not have are empty."""

    key: str
    fields: dict[str, str]

    def __getitem__(self, name: str) -> str:
        return self.fields.get(name, "")

    @property
    def authors(self) -> list[str]:
        """Authors as "Yeoh, O. H."."""
        return self["author"].split(" and ") if self["author"] else []

    @property
    def label(self) -> str:
        """Text of a citation; the letter of "2015a" is that of the key."""
        if self["shorthand"]:
            return self["shorthand"]
        names = [author.partition(",")[0] for author in self.authors]
        names = [f"{names[0]} et al."] if len(names) > 3 else names
        letter = self.key[-1] if re.search(r"\d[a-z]$", self.key) else ""
        return f"{joined(names)} {self['year']}{letter}"

    @property
    def source(self) -> str:
        """Journal with volume, year and pages; or publisher and year."""
        words = " ".join(filter(None, (self["journal"] or self["publisher"], self["volume"])))
        words += f" ({self['year']})" if self["year"] else ""
        return words + (f", {self['pages'].replace('--', '–')}" if self["pages"] else "")

    @property
    def address(self) -> str:
        return f"https://doi.org/{self['doi']}" if self["doi"] else self["url"]

    def sentence(self, emphasised: str, link: str) -> str:
        """Authors, title, source and address, with formats of Markdown or HTML."""
        names = joined(" ".join(reversed(author.split(", "))) for author in self.authors)
        name = f"doi:{self['doi']}" if self["doi"] else self.address.removeprefix("https://")
        parts = (
            names,
            emphasised.format(self["title"]),
            self.source,
            self["note"],
            link.format(name, self.address) if self.address else "",
        )
        return ", ".join(filter(None, parts)) + "."


def joined(names: Iterable[str]) -> str:
    """A list in words: "A, B and C"."""
    *first, last = [*names] or [""]
    return f"{', '.join(first)} and {last}" if first else last


@functools.cache
def entries() -> dict[str, Entry]:
    """All entries, by their keys in lower case."""
    content = (site.DOC / "references.bib").read_text(encoding="utf-8")
    return {
        key.lower(): Entry(key, dict(_FIELD.findall(fields)))
        for key, fields in _ENTRY.findall(content)
    }


def cited(content: str) -> list[tuple[str, str]]:
    """Labels and keys of the citations in a page."""
    return _CITED.findall(content)


def with_references(content: str, page: str) -> str:
    """Markdown of a page for the site, whose citations are links, with a list at its end."""
    keys = {key for _, key in cited(content)}
    if not keys:
        return content
    content = _CITED.sub(
        lambda match: f'<a class="skip" href="{site.page_link(page, "literature", match[2])}">'
        f"{match[1]}</a>",
        content,
    )
    items = "".join(
        f"<li>{text.escape(entry.label)}: "
        + entry.sentence("<em>{}</em>", '<a href="{1}">{0}</a>')
        + "</li>"
        for key, entry in entries().items()
        if key in keys
    )
    # Names and titles are not of the dictionary.
    return f'{content.rstrip()}\n\n## References\n\n<ul class="references skip">{items}</ul>'


def citing_pages() -> dict[str, list[pathlib.Path]]:
    """The pages of doc/ that cite each entry."""
    found: dict[str, list[pathlib.Path]] = {key: [] for key in entries()}
    for path in sorted(site.DOC.rglob("*.md")):
        if path != PAGE:
            for key in sorted({key for _, key in cited(path.read_text(encoding="utf-8"))}):
                found.setdefault(key, []).append(path)
    return found


def _title(path: pathlib.Path) -> str:
    title = re.search(r"^# (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return title[1] if title else path.stem


def literature() -> str:
    """The lists of doc/literature.md."""
    pages = citing_pages()
    pieces = [BEGIN]
    for group, title in GROUPS.items():
        pieces += [f"## {title}", '<div class="skip">']
        for key, entry in entries().items():
            if entry["keywords"] != group:
                continue
            users = ", ".join(
                f"[{_title(path)}]({path.relative_to(site.DOC).as_posix()})" for path in pages[key]
            )
            words = entry.sentence("*{}*", "[{}]({})")
            pieces.append(f'- <a id="{key}"></a>**{entry.label}** {words} Cited by: {users}.')
        pieces.append("</div>")
    return "\n\n".join([*pieces, END])


def page() -> str:
    """doc/literature.md as it has to be."""
    content = PAGE.read_text(encoding="utf-8")
    before, after = content.partition(BEGIN)[0], content.partition(END)[2]
    return before + literature() + after


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
