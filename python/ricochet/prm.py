# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameter files: their contents, without knowledge of the declared parameters."""

from __future__ import annotations

import os
import pathlib
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from . import files
from .errors import BadParameterFile

#: Sections of output and solvers, without effect on the computed problem.
ASIDE = ("Output/", "Limits/", "Linear solver/", "Newton/")

#: Characters that are stripped from both ends of words.
BLANKS = " \t\r\n\f\v"

#: Files that include each other, and all of them and their bytes, and sections in each other, as
#: in the programs.
MOST_DEEP, MOST_FILES, MOST_BYTES, MOST_SECTIONS = 100, 1000, 1 << 24, 10

#: The longest name of a section: every parameter of it has it in its own.
MOST_LETTERS = 1000


@dataclass
class ParameterText:
    """Contents of a parameter file, with those that it includes."""

    #: "Section/Name" -> value as text; the last one counts. Sections nest: "A/B/Name".
    values: dict[str, str] = field(default_factory=dict)
    #: The sections that are opened, in their order, also if nothing is set in them: "A", "A/B".
    sections: dict[str, None] = field(default_factory=dict)
    #: The file and all that it includes, in the order in which they are read.
    files: list[pathlib.Path] = field(default_factory=list)
    #: The contents of these files.
    contents: list[bytes] = field(default_factory=list)


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Numbers and texts of the lines, without comments, continued lines joined."""
    # As the programs read it: other signs that end lines elsewhere, such as form feeds,
    # would make settings of comments.
    lines = iter(enumerate(text.lstrip("\ufeff").split("\n"), start=1))
    for number, line in lines:
        parts = [line.split("#", 1)[0].strip(BLANKS)]
        while parts[-1].endswith("\\"):
            parts[-1] = parts[-1][:-1]
            parts.append(next(lines, (0, ""))[1].split("#", 1)[0].strip(BLANKS))
        if line := "".join(parts):
            yield number, line


def read(path: str | os.PathLike[str]) -> ParameterText:
    """Read a parameter file and all that it includes.

    Raises:
        BadParameterFile: it is missing, cannot be read, or has a line without meaning.
    """
    result = ParameterText()
    _read(pathlib.Path(path), "", (), result)
    return result


def _read(
    path: pathlib.Path, origin: str, open_files: tuple[pathlib.Path, ...], result: ParameterText
) -> None:
    """Add the contents of a file; `origin` is the line that includes it."""
    if path.resolve() in open_files:
        raise BadParameterFile(f"{origin}the parameter file '{path}' includes itself.")
    if len(open_files) >= MOST_DEEP or len(result.files) >= MOST_FILES:
        raise BadParameterFile(
            f"{origin}the parameter file '{path}' is one of more than {MOST_DEEP} in each other, "
            f"or of {MOST_FILES} in all."
        )
    try:
        contents = files.read_bytes(path, MOST_BYTES - sum(map(len, result.contents)))
        text = contents.decode("utf-8")
    except FileNotFoundError:
        raise BadParameterFile(f"{origin}the parameter file '{path}' does not exist.") from None
    except (OSError, ValueError) as error:
        raise BadParameterFile(
            f"{origin}the parameter file '{path}' cannot be read: {error}."
        ) from None
    result.files.append(path)
    result.contents.append(contents)
    open_files = (*open_files, path.resolve())

    section: list[str] = []
    for number, line in _statements(text):
        here = f"{path}, line {number}: "
        keyword, rest = ([*re.split("[ \t]+", line, maxsplit=1), ""])[:2]
        if keyword == "subsection" and rest:
            section.append(rest)
            if len(section) > MOST_SECTIONS or len(rest) > MOST_LETTERS:
                raise BadParameterFile(
                    f"{here}more than {MOST_SECTIONS} sections in each other, or a name of more "
                    f"than {MOST_LETTERS} letters."
                )
            result.sections.setdefault("/".join(section))
        elif line == "end" and section:
            section.pop()
        elif keyword == "include" and rest and not section:
            _read(path.parent / rest, here, open_files, result)
        elif keyword == "set" and "=" in rest:
            name, _, value = rest.partition("=")
            result.values["/".join([*section, name.strip(BLANKS)])] = value.strip(BLANKS)
        else:
            raise BadParameterFile(f"{here}cannot make sense of '{line[:120]}'.")
    if section:
        raise BadParameterFile(f"{path}: subsection '{'/'.join(section)}' is never closed.")


def phases(text: ParameterText) -> list[str]:
    """The sections of the phases of a run, `Phase NAME`, in their order."""
    return [s for s in text.sections if "/" not in s and s.startswith("Phase ")]


def without_phase(name: str) -> str:
    """The name of a parameter in its phase: "Time/Scheme" of "Phase hit/Time/Scheme"."""
    return name.partition("/")[2] if name.startswith("Phase ") else name


def is_static(text: ParameterText, phase: str = "") -> bool:
    """Whether a run, or a phase of it, is one of equilibria, without motion."""
    scheme = text.values.get("Time/Scheme")
    return text.values.get(f"{phase}/Time/Scheme", scheme) == "static"


def contact_sections(text: ParameterText) -> list[str]:
    """The sections in which a treatment of contact is set for bodies in motion.

    A file with named contacts has `subsection Contact ball on floor` for each of them; all
    others have one `Contact`. Of a file with phases these are the sections of the phases that are
    not static, `Phase hit/Contact ball on floor`, as treatments of motion are none of equilibria.
    """
    named = [s for s in text.sections if "/" not in s and s.startswith("Contact ")]
    if not phases(text):
        return named or ["Contact"]
    result = []
    for phase in phases(text):
        if is_static(text, phase):
            continue
        out = [s.strip() for s in text.values.get(f"{phase}/Without", "").split(";")]
        own = [s.partition("/")[2] for s in text.sections if s.startswith(f"{phase}/Contact ")]
        both = dict.fromkeys([*(s for s in named if s not in out), *own])
        result += [f"{phase}/{s}" for s in both if "/" not in s]
    return result


def scheme_parameters(text: ParameterText) -> list[str]:
    """The parameters with the time scheme, as `contact_sections`: of each phase in motion."""
    moving = [phase for phase in phases(text) if not is_static(text, phase)]
    return [f"{phase}/Time/Scheme" for phase in moving] if phases(text) else ["Time/Scheme"]


def add(text: ParameterText, values: Mapping[str, str]) -> None:
    """Set values, as another file that includes this one does."""
    for name, value in values.items():
        text.values[name] = value
        parts = name.split("/")
        for depth in range(1, len(parts)):
            text.sections.setdefault("/".join(parts[:depth]))


def to_text(value: object) -> str:
    """A value as a parameter file has it: numbers in full, `true` and `false`."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, Iterable) and not isinstance(value, (str, bytes)):
        return ", ".join(to_text(part) for part in value)
    return str(value)


def parse_assignment(text: str) -> tuple[str, str]:
    """The parts of "Section/Name=value".

    Raises:
        BadParameterFile: the text has another form.
    """
    name, equal, value = text.partition("=")
    parts = [part.strip() for part in name.split("/")]
    if not equal or not all(parts):
        raise BadParameterFile(f"'{text}' is not of the form \"Section/Name=value\".")
    return "/".join(parts), value.strip()


def write(values: Mapping[str, str], include: pathlib.Path | None = None) -> str:
    """The text of a parameter file with these values, after those of another file."""
    lines = [f"include {include}"] if include else []
    for name, value in values.items():
        *sections, last = name.split("/")
        for depth, section in enumerate(sections):
            lines.append("  " * depth + f"subsection {section}")
        lines.append("  " * len(sections) + f"set {last} = {value}")
        for depth in reversed(range(len(sections))):
            lines.append("  " * depth + "end")
    return "\n".join(lines) + "\n"


def differences(
    parameters: Iterable[Mapping[str, str]], ignore: tuple[str, ...] = ASIDE
) -> list[str]:
    """The names of the parameters that are not the same in all of these."""
    parameters = list(parameters)
    names = {name: None for each in parameters for name in each}
    return [
        name
        for name in names
        if not name.startswith(ignore) and len({each.get(name) for each in parameters}) > 1
    ]


def labels(parameters: Iterable[Mapping[str, str]], telling_only: bool = False) -> list[str]:
    """For each of several runs a text with its differences from the others.

    "persistent contact, Time step = 0.001": of a treatment, a scheme and a program the value
    says enough, and with telling_only these are all that is named. Texts are empty where nothing differs. Parameters that one run has and
    another has not are named only if nothing else differs, since a run of another program has
    many of them.
    """
    parameters = list(parameters)
    names = differences(parameters)
    common = [name for name in names if all(name in each for each in parameters)]
    if common:
        names = common
    # Parameters of a treatment or a scheme come after it.
    telling = ("Program", "Treatment", "Scheme")
    names.sort(key=lambda name: name.split("/")[-1] not in telling)
    if telling_only:
        names = [name for name in names if name.split("/")[-1] in telling]
    last_parts = [name.split("/")[-1] for name in names]
    texts = []
    for each in parameters:
        parts = []
        for name, last in zip(names, last_parts):
            if name not in each:
                continue
            value = _short(each[name])
            if last_parts.count(last) > 1:
                # Several sections have it, say several contacts.
                others = [n for n in names if n.split("/")[-1] == last]
                if len({each.get(n) for n in others}) == 1:
                    if name != others[0]:
                        continue
                else:
                    parts.append(f"{name} = {value}")
                    continue
            parts.append(value if last in telling else f"{last} = {value}")
        texts.append(", ".join(parts))
    return texts


def _short(value: str) -> str:
    """A number as a person would write it; a file by its last name."""
    try:
        return f"{float(value):g}"
    except ValueError:
        return value.rsplit("/", 1)[-1] if value.startswith("/") else value
