# SPDX-License-Identifier: LGPL-2.1-or-later
"""The second gallery: the examples of the program `ricochet`, from examples/README.md."""

from __future__ import annotations

import pathlib
import re

from . import figures, site, text

PAGE = "examples/index"


def head_of(path: pathlib.Path) -> str:
    """The comment at the head of a parameter file, as Markdown."""
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            break
        lines.append(re.sub(r"^# ?", "", line))
    return text.prose(lines)


def title_of(path: pathlib.Path) -> str:
    """The name of an example, with the apostrophes that its head has."""
    first = re.split("[,:.]", head_of(path), maxsplit=1)[0]
    plain = re.sub(r"[^a-z]", "", first.lower())
    return (
        first if plain == path.stem.replace("_", "") else path.stem.replace("_", " ").capitalize()
    )


def _rows(readme: str) -> dict[str, list[str]]:
    """The cells of the table of README.md, by the name of the example."""
    found = {}
    for line in readme.splitlines():
        match = re.match(r"\| !\[\]\(images/(\w+)\.png\) \|(.*)\|$", line)
        if match:
            found[match[1]] = [cell.strip() for cell in match[2].split("|")]
    return found


def make(made: site.Site) -> None:
    """Write the page of the examples.

    Raises:
        SiteError: an example is not in the table of examples/README.md.
    """
    folder = site.ROOT / "examples"
    readme = (folder / "README.md").read_text(encoding="utf-8")
    rows = _rows(readme)
    names = [path.stem for path in sorted(folder.glob("*.prm"))]
    missing = sorted(set(names) - set(rows))
    if missing:
        raise site.SiteError(f"examples/README.md has no row for {', '.join(missing)}.")

    # The table becomes sections; the text before and after it stays.
    before, _, rest = readme.partition("| picture |")
    after = rest.partition("\n\n")[2]
    before = text.with_links(re.sub(r"\A<!--.*?-->\s*# .*\n", "", before), PAGE, "examples")
    items = []
    sections = []
    for name in rows:
        picture = folder / "images" / f"{name}.png"
        title = title_of(folder / f"{name}.prm")
        made.copy(picture, f"examples/pictures/{name}.png")
        figures.thumbnail(picture, made.extra(f"examples/thumbnails/{name}.png"))
        items.append((f"#example-{text.slug(name)}", f"thumbnails/{name}.png", title))
        what, must_be, is_, seconds = rows[name]
        what = re.sub(r"^\[`.*?`\]\(.*?\): ", "", what)
        file = f"examples/{name}.prm"
        sections += [
            f"(example-{text.slug(name)})=\n### {title}",
            text.picture(picture, f"pictures/{name}.png", what),
            f"{what[:1].upper()}{what[1:]}.",
            f"- **Must be:** {must_be}\n- **Is:** {is_}\n- **File:** "
            + text.anchor(text.parameter_file_link(PAGE, file), f"<code>{file}</code>")
            + f", {seconds} s on one core",
            text.details(
                "The story, and where the numbers come from", head_of(folder / f"{name}.prm")
            ),
        ]
    made.page(
        PAGE,
        "\n\n".join(
            [
                "# Examples",
                before.strip(),
                figures.cards(items),
                "## One by one",
                *sections,
                text.headings_from(text.with_links(after, PAGE, "examples"), 2),
            ]
        ),
    )
