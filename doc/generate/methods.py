# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of doc/methods, with a table of what each treatment conserves and its energy curve.

A page may begin with lines between two lines of three dashes; lists are separated by commas:

    names: improved normal compliance       as in parameter files; else from the file's name
    kind: treatment                         or scheme, material
    source: lib/contact/laws/normal_compliance.h
    conserves: energy and contact potential, at the end of an impact

A line `<!-- energy-curve: NAME -->` is where the curve of that treatment goes. Text before the
first section of index.md goes before the tables.
"""

from __future__ import annotations

import functools
import pathlib
import posixpath
import re
import subprocess
import sys
from dataclasses import dataclass

from ricochet import Run, curves

from . import api, parameters, references, run_pages, site, text

FOLDER = "methods"

# The parameters whose choices are the methods, in the order of their tables; a program that
# has them.
CHOICES = {
    "treatment": ("bar_sd", "Contact/Treatment"),
    "scheme": ("bar_sd", "Time/Scheme"),
    "material": ("ricochet", "Body NAME/Law"),
    "viscosity": ("ricochet", "Body NAME/Viscosity"),
}
TITLES = {
    "treatment": "Contact treatments",
    "friction": "Friction",
    "scheme": "Time schemes",
    "material": "Materials",
    "viscosity": "Viscosity",
    "mass": "Mass",
    "kinematics": "Contact kinematics",
    "promise": "Promises",
    "": "More",
}


@dataclass
class Method:
    """A page of doc/methods."""

    path: pathlib.Path
    title: str
    body: str
    kind: str
    names: list[str]
    source: list[str]
    conserves: str

    @property
    def page(self) -> str:
        return self.path.relative_to(site.DOC).with_suffix("").as_posix()


@functools.cache
def choices(programs: pathlib.Path) -> dict[str, list[str]]:
    """The names of all methods, as the programs have them."""
    found = {}
    for kind, (program, name) in CHOICES.items():
        of = {each.name: each for each in parameters.declared(programs / program)}
        found[kind] = of[name].allowed.removeprefix("one of: ").split(", ")
    return found


def read(path: pathlib.Path, names: dict[str, list[str]]) -> Method:
    """Read a page.

    Raises:
        SiteError: it has no title.
    """
    content = path.read_text(encoding="utf-8")
    content = re.sub(r"\A<!--.*?-->\s*", "", content, flags=re.DOTALL)
    data: dict[str, str] = {}
    match = re.match(r"---\n(.*?)\n---\n", content, re.DOTALL)
    if match:
        for line in match[1].splitlines():
            key, _, value = line.partition(":")
            data[key.strip()] = value.strip()
        content = content[match.end() :]
        content = re.sub(r"\A\s*<!--.*?-->\s*", "", content, flags=re.DOTALL)
    title = re.match(r"\s*# (.*)\n", content)
    if not title:
        raise site.SiteError(f"{site.shown(path)} has no title.")
    by_slug = {text.slug(name): (kind, name) for kind, list_ in names.items() for name in list_}
    kind, name = by_slug.get(text.slug(path.stem), (data.get("kind", ""), ""))
    return Method(
        path,
        title[1].strip(),
        content[title.end() :].strip("\n"),
        data.get("kind", kind),
        _list(data.get("names", name)),
        _list(data.get("source", "")),
        data.get("conserves", "").strip("\""),
    )


def _list(words: str) -> list[str]:
    return [word.strip() for word in words.strip("[]").split(",") if word.strip()]


# Energy curves --------------------------------------------------------------


def _curve(made: site.Site, page: str, name: str, run: Run) -> str:
    """Draw the energies of a run; returns HTML."""
    file = f"{FOLDER}/energy_{text.slug(name)}.png"
    with curves.settings():
        figure = curves.energies(curves.lines_of([run]))
        curves.save(figure, made.extra(file))
    what = f"Energies of the elastic ball through an impact, {name}, steps of 1 ms"
    picture = text.picture(made.extra(file), site.link(page, file), what)
    return f"{picture}\n\n*{text.plain(what)}.*"


def _draw() -> None:
    """Make the drawings of the pages, unless they are newer than their script."""
    script = site.DOC / "methods" / "drawings.py"
    drawings = list(script.parent.glob("*.svg"))
    if not script.is_file():
        return
    age = script.stat().st_mtime
    if drawings and all(path.stat().st_mtime > age for path in drawings):
        return
    answer = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise site.SiteError(f"{site.shown(script)} failed:\n{answer.stderr}")


# Pages ----------------------------------------------------------------------


def _source(method: Method, file: str) -> str:
    if not (site.ROOT / file).is_file():
        raise site.SiteError(f"{site.shown(method.path)}: there is no file {file}.")
    code = f"<code>{file}</code>"
    if not file.endswith(".h"):
        return code
    return text.anchor(site.link(method.page, api.address(file)), code)


def _page(made: site.Site, method: Method, runs: dict[str, Run]) -> str:
    rows = [("in parameter files", ", ".join(f"<code>{name}</code>" for name in method.names))]
    if "**Source:**" not in method.body:
        rows.append(("source", "<br>".join(_source(method, file) for file in method.source)))
    rows.append(("keeps", text.escape(method.conserves)))

    body = references.with_references(method.body, method.page)
    body = text.with_includes(body, method.page)
    body = text.with_pictures(body, method.page, posixpath.dirname(method.page))
    body = text.with_headers(body, method.page)
    body = _CURVE.sub(
        lambda match: _curve(made, method.page, match[1], runs[match[1]]), body
    )
    return "\n\n".join([f"# {method.title}", text.facts(row for row in rows if row[1]), body])


_CURVE = re.compile(r"^<!-- energy-curve: (.+?) -->$", re.MULTILINE)


def pages(names: dict[str, list[str]]) -> list[Method]:
    """All pages of doc/methods, in the order of the programs' tables."""
    found = [
        read(path, names)
        for path in sorted((site.DOC / "methods").glob("**/*.md"))
        if path.stem != "index"
    ]
    for method in found:
        if method.kind not in TITLES:
            raise site.SiteError(
                f"{site.shown(method.path)}: there is no kind '{method.kind}'; there are "
                f"{', '.join(filter(None, TITLES))}."
            )

    def place(method: Method) -> tuple[int, int, str]:
        listed = names.get(method.kind, [])
        first = min((listed.index(name) for name in method.names if name in listed), default=99)
        return list(TITLES).index(method.kind), first, method.title

    return sorted(found, key=place)


def _introduction() -> str:
    path = site.DOC / "methods" / "index.md"
    if not path.is_file():
        return "# Methods\n\nWhat can be chosen in a parameter file. Each choice is one page."
    content = path.read_text(encoding="utf-8")
    content = re.sub(r"\A<!--.*?-->\s*", "", content, flags=re.DOTALL)
    return content.partition("\n## ")[0]


def make(made: site.Site) -> None:
    """Write the pages of the methods, and their tables."""
    found = pages(choices(made.programs))
    _draw()
    for path in (site.DOC / "methods").glob("**/*"):
        if path.suffix in (".svg", ".png", ".gif"):
            made.copy(path, path.relative_to(site.DOC).as_posix())
    treatments = [name for method in found for name in _CURVE.findall(method.body)]
    runs = run_pages.of_treatments(made, treatments)
    for method in found:
        made.page(method.page, _page(made, method, runs))

    index = f"{FOLDER}/index"
    pieces = [_introduction()]
    for kind, title in TITLES.items():
        rows = [
            (
                text.anchor(site.page_link(index, method.page), text.escape(method.title)),
                "<br>".join(f"<code>{text.escape(name)}</code>" for name in method.names),
                text.escape(method.conserves),
            )
            for method in found
            if method.kind == kind
        ]
        if rows:
            pieces += [f"## {title}", text.table(("method", "in parameter files", "keeps"), rows)]
    if found:
        pieces.append(text.toctree(f"/{method.page}" for method in found))
    made.page(index, "\n\n".join(pieces))
