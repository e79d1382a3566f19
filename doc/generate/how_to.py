# SPDX-License-Identifier: LGPL-2.1-or-later
"""Handwritten pages, with their includes; and the Python package."""

from __future__ import annotations

import inspect
import pathlib
import re
import shutil
import textwrap

import ricochet

from . import references, site, text

# Order of the pages.
ORDER = (
    "install",
    "run",
    "scenes",
    "choose",
    "static",
    "other_codes",
    "law",
    "material",
    "scheme",
    "step",
    "tests",
    "cluster",
    "python",
    "figures",
    "speed",
)

# The parts of a docstring, as the site calls them.
SECTIONS = {"Args:": "Arguments", "Returns:": "Returns", "Raises:": "Raises"}


def _docstring(thing: object) -> str:
    """A docstring as Markdown: indented examples as code, "Args:" and the like as lists."""
    words = inspect.getdoc(thing) or ""
    result: list[str] = []
    in_list = False
    for line in words.split("\n"):
        if line in SECTIONS:
            result += ["", f"**{SECTIONS[line]}**", ""]
            in_list = True
        elif in_list and (match := re.match(r" {4}(\w+): (.*)", line)):
            result.append(f"- `{match[1]}`: {text.plain(match[2])}")
        elif in_list and line.startswith("        "):
            result.append(f"  {text.plain(line.strip())}")
        elif line.startswith("    "):
            result.append(line)
        else:
            in_list = in_list and not line.strip()
            result.append(text.prose([line]) if line.strip() else "")
    return re.sub(r"\n{3,}", "\n\n", "\n".join(result))


def _signature(thing: object) -> str:
    try:
        return re.sub(r"'", "", str(inspect.signature(thing)))  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return ""


def python_reference() -> str:
    """Contents of the package, from its docstrings."""
    pieces = ["## All that it offers"]
    for name in ricochet.__all__:
        thing = getattr(ricochet, name)
        pieces.append(f"### `ricochet.{name}`")
        is_error = inspect.isclass(thing) and issubclass(thing, Exception)
        if not is_error:
            call = textwrap.fill(f"{name}{_signature(thing)}", 76, subsequent_indent="    ")
            pieces.append(text.code(call, "python"))
        pieces.append(_docstring(thing))
        if not inspect.isclass(thing) or is_error:
            continue
        members = []
        for member, value in vars(thing).items():
            words = inspect.getdoc(value) if not member.startswith("_") else None
            if words and (callable(value) or isinstance(value, property) or hasattr(value, "func")):
                call = f"{member}()" if inspect.isfunction(value) else member
                members.append(f"`{call}`\n: {text.plain(' '.join(words.split()))}")
        pieces += members
    return "\n\n".join(pieces)


def hand_written(name: str) -> str:
    """A page of doc/ without its licence, its links being those of the site."""
    content = (site.DOC / f"{name}.md").read_text(encoding="utf-8")
    content = re.sub(r"\A<!-- SPDX.*?-->\s*", "", content, flags=re.DOTALL)
    content = references.with_references(content, name)
    folder = pathlib.PurePosixPath("doc", name).parent.as_posix()
    return text.with_links(content, name, folder)


def without_answers(course: str) -> str:
    """The course for students, who are to find the answers themselves."""
    before, mark, units = course.partition("\n## Unit 1")
    table = before[before.index("Each run leaves its table") :]
    units = re.sub(
        r"^<details><summary>Answers</summary>.*?^</details>\n", "", mark + units, flags=re.DOTALL | re.M
    )
    return "\n\n".join(
        [
            "---\norphan: true\n---\n# Four units on contact",
            "Commands are run from the top folder of the source. Each unit ends with a sheet to hand in: "
            "copy it into a file.",
            table.strip(),
            units.strip(),
        ]
    )


def notebooks() -> list[pathlib.Path]:
    """The notebooks of doc/notebooks."""
    return sorted((site.DOC / "notebooks").glob("*.ipynb"))


def make(made: site.Site) -> None:
    """Write the pages of doc/how_to and doc/teaching, of the library, and the first one."""
    names = [path.stem for path in (site.DOC / "how_to").glob("*.md") if path.stem != "index"]
    names.sort(key=lambda name: (ORDER.index(name) if name in ORDER else len(ORDER), name))
    teaching = [f"teaching/{path.stem}" for path in sorted((site.DOC / "teaching").glob("*.md"))]
    for page in [*(f"how_to/{name}" for name in names), *teaching]:
        content = text.with_headers(text.with_includes(hand_written(page), page), page)
        if page == "how_to/python":
            content += "\n\n" + python_reference()
        made.page(page, content)
        if page == "teaching/course":
            made.page("teaching/course_for_students", without_answers(content))
    own_step = site.ROOT / "examples" / "own_step" / "own_step.cc"
    shutil.copyfile(own_step, made.target / own_step.name)
    index = hand_written("how_to/index")
    made.page("how_to/index", "\n\n".join([index, text.toctree(names, hidden=False)]))

    for page in ("benchmarks", "certificate", "combinations", "literature", "verification"):
        made.page(page, text.with_headers(hand_written(page), page))
    made.copy(site.DOC / "verification.csv", "verification.csv")
    library = text.with_includes(hand_written("library"), "library")
    made.page("library", text.with_headers(library, "library"))
    listed = [f"notebooks/{path.stem}" for path in notebooks()]
    made.page(
        "index",
        "\n\n".join(
            [
                text.with_includes(hand_written("index"), "index"),
                text.toctree(("steps/index", *listed, *teaching), "Learn"),
                text.toctree(
                    ("gallery/index", "examples/index", "benchmarks", "verification", "certificate"), "Look"
                ),
                text.toctree(
                    (
                        "methods/index",
                        "combinations",
                        "parameters/index",
                        "files/index",
                        "results/index",
                        "literature",
                    ),
                    "Look up",
                ),
                text.toctree(("how_to/index", "library"), "Do"),
            ]
        ),
    )
