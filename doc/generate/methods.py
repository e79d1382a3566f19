# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of doc/methods, with a table of what each treatment conserves and its energy curve.

A page may begin with lines between two lines of three dashes; lists are separated by commas:

    names: improved normal compliance       as in parameter files; else from the file's name
    kind: treatment                         or scheme, material
    source: lib/contact/laws/normal_compliance.h
    conserves: energy and contact potential, at the end of an impact
"""

from __future__ import annotations

import ast
import functools
import re
import shutil
from dataclasses import dataclass

from ricochet import Run, curves, prm

from . import api, figures, parameters, site, text

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
    "scheme": "Time schemes",
    "material": "Materials",
    "viscosity": "Viscosity",
    "": "More",
}

# What tests/integration/common.py has lists of: treatments whose energy is tested, with the
# midpoint scheme and without friction and viscosity.
TESTED = {
    "KEEP_ENERGY": "the energy, in each step",
    "KEEP_MODIFIED_ENERGY": "the energy with its contact potential, in each step",
    "LOSE_ENERGY": "nothing; the energy never grows",
}


@dataclass
class Method:
    """A page of doc/methods."""

    path: site.pathlib.Path
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
def choices(programs: site.pathlib.Path) -> dict[str, list[str]]:
    """The names of all methods, as the programs have them."""
    found = {}
    for kind, (program, name) in CHOICES.items():
        allowed = parameters.try_impossible(programs / program, name)
        found[kind] = allowed.removeprefix("one of: ").split(", ")
    return found


def tested() -> dict[str, str]:
    """Of each treatment, what the tests say that it conserves."""
    tree = ast.parse((site.ROOT / "tests/integration/common.py").read_text(encoding="utf-8"))
    found = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            words = TESTED.get(node.targets[0].id)
            if words:
                found.update({name: words for name in ast.literal_eval(node.value)})
    return found


def read(path: site.pathlib.Path, names: dict[str, list[str]]) -> Method:
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
        data.get("conserves", ""),
    )


def _list(words: str) -> list[str]:
    return [word.strip() for word in words.strip("[]").split(",") if word.strip()]


# Energy curves --------------------------------------------------------------


def ball_runs(gallery: figures.Gallery) -> dict[str, Run]:
    """The runs of the elastic ball that are there, by their treatment, with steps of 1 ms."""
    found: dict[str, Run] = {}
    for entry in gallery.of_program("elastic_ball"):
        for run in entry.figure.runs:
            folder = gallery.site.output / run.folder.relative_to(site.ROOT / "output")
            if not (folder / run.table).is_file() or not (folder / "parameters.prm").is_file():
                continue
            values = prm.read(folder / "parameters.prm").values
            name = values.get("Contact/Treatment", "")
            elastic = float(values.get("Material/Viscosity eta", 0)) == 0
            no_friction = float(values.get("Contact/Friction coefficient", 0)) == 0
            step = float(values.get("Time/Time step", 0))
            consistent = values.get("Time/Mass") == "consistent"
            if name not in found and elastic and no_friction and consistent and step == 1e-3:
                found[name] = Run(folder)
    return found


def _curve(made: site.Site, page: str, name: str, run: Run) -> str:
    """Draw the energies of a run; returns HTML."""
    file = f"{FOLDER}/energy_{text.slug(name)}.png"
    with curves.settings():
        figure = curves.energies(curves.lines_of([run]))
        curves.save(figure, made.extra(file))
    address = site.link(page, file)
    what = f"Energies of the elastic ball through an impact, {name}, steps of 1 ms"
    return (
        f'<a class="picture" href="{address}"><img src="{address}" alt="{text.escape(what)}">'
        f"</a>\n\n*{text.plain(what)}.*"
    )


# Pages ----------------------------------------------------------------------


def _page(made: site.Site, method: Method, runs: dict[str, Run]) -> str:
    links = []
    for file in method.source:
        if not (site.ROOT / file).is_file():
            raise site.SiteError(f"{site.shown(method.path)}: there is no file {file}.")
        links.append(
            text.anchor(site.link(method.page, api.address(file)), f"<code>{file}</code>")
        )
    rows = [("in parameter files", ", ".join(f"<code>{name}</code>" for name in method.names))]
    rows += [("source", "<br>".join(links))]
    conserves = _conserves(method, method.names)
    rows += [("conserves", text.escape(conserves))]
    pieces = [f"# {method.title}", text.facts(row for row in rows if row[1])]
    pieces.append(text.with_includes(method.body, method.page))
    with_curve = [name for name in method.names if name in runs]
    if with_curve:
        pieces.append("## Its energy on the elastic ball")
        pieces += [_curve(made, method.page, name, runs[name]) for name in with_curve]
    elif method.kind == "treatment":
        pieces.append(
            "*Its energy curve on the elastic ball is shown here once `figures/make.py A-4 B-4` "
            "has made the run, if the treatment is one of that figure.*"
        )
    return "\n\n".join(pieces)


def _conserves(method: Method | None, names: list[str]) -> str:
    if method and method.conserves:
        return method.conserves
    known = tested()
    return "; ".join(dict.fromkeys(known[name] for name in names if name in known))


def make(made: site.Site, gallery: figures.Gallery) -> None:
    """Write the pages of the methods, and their table."""
    names = choices(made.programs)
    folder = site.DOC / "methods"
    pages = [
        read(path, names) for path in sorted(folder.glob("**/*.md")) if path.stem != "index"
    ]
    for path in folder.glob("**/*"):
        if path.is_file() and path.suffix != ".md":
            copy = made.target / path.relative_to(site.DOC)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, copy)
    runs = ball_runs(gallery)
    for method in pages:
        made.page(method.page, _page(made, method, runs))

    by_name = {name: method for method in pages for name in method.names}
    pieces = [
        "# Methods",
        "What can be chosen in a parameter file: how contact is treated, how time is "
        "integrated, of what a body is made. Each choice is one file of the library.",
    ]
    index = f"{FOLDER}/index"
    for kind, title in TITLES.items():
        listed = names.get(kind, [])
        rows = []
        for name in listed:
            method = by_name.get(name)
            shown = f"<code>{text.escape(name)}</code>"
            if method:
                shown = text.anchor(site.page_link(index, method.page), shown)
            rows.append((shown, text.escape(_conserves(method, [name])) or "–"))
        more = [each for each in pages if each.kind == kind and not set(each.names) & set(listed)]
        for method in more:
            link = text.anchor(site.page_link(index, method.page), text.escape(method.title))
            rows.append((link, text.escape(method.conserves) or "–"))
        if not rows:
            continue
        pieces.append(f"## {title}")
        if kind in ("treatment", "scheme"):
            pieces.append(text.table(("name", "conserves"), rows))
        else:
            pieces.append("\n".join(f"- {row[0]}" for row in rows))
        if kind == "treatment":
            pieces.append(
                "Without friction and viscosity, with the midpoint scheme where the treatment "
                "takes it; each line is tested."
            )
    pieces.append(text.toctree([f"/{method.page}" for method in pages]) if pages else "")
    made.page(index, "\n\n".join(piece for piece in pieces if piece))
