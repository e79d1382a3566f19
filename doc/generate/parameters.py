# SPDX-License-Identifier: LGPL-2.1-or-later
"""A page for each program with all its parameters, and one with each of its files."""

from __future__ import annotations

import concurrent.futures
import functools
import os
import pathlib
import re
import subprocess
from dataclasses import dataclass, replace

from ricochet import prm

from . import site, text


@dataclass(frozen=True)
class Parameter:
    """A parameter as the program declares it."""

    name: str  # "Section/Name"
    meaning: str
    default: str
    allowed: str = "a text"
    #: Default and allowed values of a program in 3D, where they are others than in 2D; a parameter
    #: of one dimension has `only`.
    default_in_space: str | None = None
    allowed_in_space: str | None = None
    only: str = ""

    @property
    def section(self) -> str:
        return self.name.rpartition("/")[0]

    @property
    def last(self) -> str:
        return self.name.rpartition("/")[2]

    @property
    def unit(self) -> str:
        return unit_of(self.meaning)


@dataclass(frozen=True)
class SetBy:
    """A parameter file that gives a parameter a value."""

    path: str  # in the checkout
    name: str  # "Body ball/Radius"
    value: str


_UNITS = {"m", "s", "kg", "N", "Pa", "J", "GB", "rad", "mm", "MPa", "t", "alpha"}


def unit_of(meaning: str) -> str:
    """The unit that stands in brackets in a text; empty if there is none."""
    for candidate in re.findall(r"\(([^()]*(?:\([^()]*\)[^()]*)*)\)", meaning):
        words = re.findall(r"[A-Za-z]+", candidate)
        if words and set(words) <= _UNITS and not re.search(r"[=,;]", candidate):
            return candidate
    return ""


def ask(program: pathlib.Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Start a program that prints information about itself."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    return subprocess.run(
        [str(program), *options], capture_output=True, text=True, env=environment, check=False
    )


@functools.cache
def description(program: pathlib.Path) -> str:
    """Description of a program by itself."""
    answer = ask(program, "--help").stdout
    return " ".join(answer.split("Usage:")[0].split())


def declared(program: pathlib.Path) -> list[Parameter]:
    """The parameters of a program.

    Raises: SiteError: the program does not list them.
    """
    answer = ask(program, "--print-parameters")
    if answer.returncode != 0:
        raise site.SiteError(f"{program} --print-parameters failed: {answer.stderr.strip()}")
    in_plane = parse(answer.stdout)
    if not any(parameter.name == "Dimension" for parameter in in_plane):
        return in_plane
    answer = ask(program, "--print-parameters", "--set", "Dimension=3")
    return in_both_dimensions(in_plane, parse(answer.stdout))


def in_both_dimensions(in_plane: list[Parameter], in_space: list[Parameter]) -> list[Parameter]:
    """The parameters of a program whose file chooses the dimension."""
    found = []
    others = {parameter.name: parameter for parameter in in_space}
    for parameter in in_plane:
        other = others.pop(parameter.name, None)
        if other is None:
            found.append(replace(parameter, only="2D"))
        else:
            found.append(
                replace(
                    parameter,
                    default_in_space=None if other.default == parameter.default else other.default,
                    allowed_in_space=None if other.allowed == parameter.allowed else other.allowed,
                )
            )
    return found + [replace(parameter, only="3D") for parameter in others.values()]


def parse(printed: str) -> list[Parameter]:
    """The parameters in the output of a program, each with the comment before it.

    The allowed values follow after all of them, as "#   Section/Name: A number".
    """
    printed, _, rest = printed.partition("# What is allowed:\n")
    allowed = dict(line.lstrip("# ").split(": ", 1) for line in rest.splitlines() if line)
    found: list[Parameter] = []
    sections: list[str] = []
    comment: list[str] = []
    for line in printed.splitlines():
        line = line.strip()
        if line.startswith("#"):
            if line not in ("# Listing of Parameters", "# ---------------------"):
                comment.append(line.lstrip("# "))
            continue
        if line.startswith("subsection "):
            sections.append(line.removeprefix("subsection "))
        elif line == "end":
            sections.pop()
        elif line.startswith("set "):
            name, _, value = line.removeprefix("set ").partition("=")
            full_name = "/".join([*sections, name.strip()])
            words = {"allowed": in_words(allowed[full_name])} if full_name in allowed else {}
            found.append(Parameter(full_name, " ".join(comment).strip(), value.strip(), **words))
        comment = []
    return found


def in_words(pattern: str) -> str:
    """Allowed values of a parameter as printed by a program, within a sentence."""
    pattern = pattern.strip()
    if pattern.startswith("Any one of "):
        return "one of: " + pattern.removeprefix("Any one of ")
    if pattern.startswith("A boolean value"):
        return "true or false"
    words = pattern[:1].lower() + pattern[1:]
    if words in _NAMES:
        return _NAMES[words]
    words = _NUMBER.sub(lambda match: _readable(match[0]), words)
    several = re.fullmatch(r"(any number of|[\d to]+) values, each a (whole )?number(.*)", words)
    if several:
        count = several[1].removeprefix("any number of")
        words = f"{count} {several[2] or ''}numbers{several[3]}, separated by commas".strip()
    return words


_NAMES = {
    "a directory name": "a folder",
    "an input filename": "a file",
    "a whole number from 1 to 2": "1 or 2",
}
_NUMBER = re.compile(r"-?\d[\d.]*(e[-+]\d+)?")
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _readable(number: str) -> str:
    """A number of a program as in a text: 10⁻⁶, 1/3, 100 000."""
    sign, number = ("−", number[1:]) if number.startswith("-") else ("", number)
    if number == "0.333333":
        return f"{sign}1/3"
    digits, exponent, power = number.partition("e")
    if exponent:
        base = "" if digits == "1" else f"{digits}·"
        return f"{sign}{base}10{str(int(power)).translate(_SUPERSCRIPTS)}"
    if number.isdigit() and len(number) > 4:
        number = f"{int(number):,}".replace(",", "\u202f")
    return sign + number


# Parameter files ------------------------------------------------------------


@functools.cache
def files_of(program: str) -> list[pathlib.Path]:
    """The parameter files of a program; of `ricochet` also the examples."""
    files = sorted((site.ROOT / "parameter_files" / program).glob("*.prm"))
    if program == "ricochet":
        files += sorted((site.ROOT / "examples").glob("*.prm"))
    # Files that others include come first.
    return sorted(files, key=lambda path: (path.parent.name, path.stem != "default"))


def general_name(name: str, sections: set[str]) -> str:
    """The name with NAME in place of a name of the user's: "Body ball/Radius" is "Body NAME"'s."""
    section, slash, last = name.partition("/")
    kind = section.split(" ", 1)[0]
    if section not in sections and f"{kind} NAME" in sections:
        return f"{kind} NAME{slash}{last}"
    return name


@functools.cache
def settings_of(program: str) -> list[SetBy]:
    """Settings of each parameter file of a program, without the files that it includes."""
    found = []
    for path in files_of(program):
        everything = prm.read(path)
        included: dict[str, str] = {}
        for other in everything.files[1:]:
            included.update(prm.read(other).values)
        found += [
            SetBy(site.shown(path), name, value)
            for name, value in everything.values.items()
            if included.get(name) != value
        ]
    return found


def _set_by(program: str, parameter: Parameter, sections: set[str], page: str) -> str:
    users: dict[str, list[str]] = {}
    for setting in settings_of(program):
        if general_name(setting.name, sections) == parameter.name:
            values = users.setdefault(setting.path, [])
            if setting.value not in values:
                values.append(setting.value)
    if not users:
        return "no file"
    rows = [
        text.anchor(
            text.parameter_file_link(page, path), f"<code>{pathlib.PurePosixPath(path).name}</code>"
        )
        + " <span>= "
        + "; ".join(f"<code>{text.escape(value) or '(empty)'}</code>" for value in values)
        + "</span>"
        for path, values in users.items()
    ]
    items = "".join(f"<li>{row}</li>" for row in rows)
    count = f"{len(rows)} file{'s' if len(rows) > 1 else ''}"
    return f"<details><summary>{count}</summary><ul>{items}</ul></details>"


def page_name(program: str) -> str:
    return f"parameters/{program}"


def anchor_of(parameter: Parameter) -> str:
    return "parameter-" + text.slug(parameter.name)


def _page(program: str, parameters: list[Parameter], says: str) -> str:
    page = page_name(program)
    sections = {parameter.section for parameter in parameters}
    pieces = [
        f"# Parameters of `{program}`",
        text.plain(says),
        text.facts(
            [
                ("tutorial", text.anchor(f"../steps/{program}.html", text.escape(program))),
                (
                    "its files",
                    text.anchor(f"../files/{program}.html", "with their contents")
                    if files_of(program)
                    else "none",
                ),
                ("the same in a terminal", f"<code>{program} --print-parameters</code>"),
            ]
        ),
    ]
    here = None
    # Files that the others depend on come first.
    order = list(dict.fromkeys(each.section for each in parameters))
    for parameter in sorted(
        parameters,
        key=lambda each: (
            each.section != "",
            order.index(each.section),
            each.last not in ("Treatment", "Scheme", "Law", "Shape", "Quantity", "Kind"),
        ),
    ):
        if parameter.section != here:
            here = parameter.section
            pieces.append(f"## {text.plain(here) if here else 'At the top level'}")
        default = f"<code>{text.escape(parameter.default)}</code>" if parameter.default else "empty"
        rows = [("default", default)]
        if parameter.unit:
            rows.append(("unit", text.escape(parameter.unit)))
        if parameter.default_in_space is not None:
            rows.append(("default in 3D", f"<code>{text.escape(parameter.default_in_space)}</code>"))
        rows.append(("allowed", text.escape(parameter.allowed)))
        if parameter.allowed_in_space is not None:
            rows.append(("allowed in 3D", text.escape(parameter.allowed_in_space)))
        if parameter.only:
            rows.append(("available", f"in {parameter.only} only"))
        rows.append(("set in", _set_by(program, parameter, sections, page)))
        pieces += [
            f"({anchor_of(parameter)}-of-{text.slug(program)})=\n### {text.plain(parameter.last)}",
            text.plain(parameter.meaning),
            text.facts(rows),
        ]
    return "\n\n".join(pieces)


def _index(of: dict[str, list[Parameter]]) -> str:
    names: dict[str, list[str]] = {}
    for program, parameters in of.items():
        for parameter in parameters:
            names.setdefault(parameter.name, []).append(program)
    rows = []
    for name in sorted(names, key=str.lower):
        links = [
            text.anchor(
                f"{program}.html#parameter-{text.slug(name)}-of-{text.slug(program)}", program
            )
            for program in names[name]
        ]
        rows.append((f"<code>{text.escape(name)}</code>", ", ".join(links)))
    return "\n\n".join(
        [
            "# Parameters",
            "Values that a program reads from its parameter file, or from `--set "
            '"Section/Name=value"` on the command line. The pages are made of the output of '
            "`--print-parameters`. Where a text names a unit, the default is in this unit; the "
            "program `ricochet` takes any consistent units.",
            text.toctree((f"{name} <{name}>" for name in of), hidden=False),
            "## All names",
            text.table(("parameter", "programs"), rows),
        ]
    )


def _files_page(program: str) -> str:
    pieces = [
        f"# Parameter files of `{program}`",
        "A file that begins with `include` has the values of the included file, except for those "
        "that it sets.",
    ]
    folder = None
    for path in files_of(program):
        if path.parent != folder:
            folder = path.parent
            pieces.append(f"## {text.plain(site.shown(folder))}/")
        content = path.read_text(encoding="utf-8")
        pieces += [
            f"({text.parameter_file_label(site.shown(path))})=\n### {text.plain(path.name)}",
            text.code(content, "prm"),
        ]
    return "\n\n".join(pieces)


def make(made: site.Site) -> None:
    """Write the pages of parameters and of parameter files."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        lists = pool.map(lambda name: declared(made.programs / name), site.steps())
        of = dict(zip(site.steps(), lists))
    for program, list_ in of.items():
        made.page(page_name(program), _page(program, list_, description(made.programs / program)))
    made.page("parameters/index", _index(of))

    with_files = [program for program in site.steps() if files_of(program)]
    for program in with_files:
        made.page(f"files/{program}", _files_page(program))
    made.page(
        "files/index",
        "\n\n".join(
            [
                "# Parameter files",
                "Each curve of a figure is a small file with its changes to the default.",
                text.toctree((f"{name} <{name}>" for name in with_files), hidden=False),
            ]
        ),
    )
