# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results of a run: columns of the console and of energy.csv, fields of the VTU files.

The texts are in doc/results/*.toml, one table for each name. A part of a name in capitals, as in
`mean_gap_NAME`, stands for a name of the user's; `AXIS` for x, y or z.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass

from . import site, text

FOLDER = "results"


@dataclass(frozen=True)
class Item:
    """A column or a field."""

    name: str
    unit: str
    meaning: str
    when: str  # it is there; empty if always
    group: str

    @property
    def pattern(self) -> re.Pattern[str]:
        """Pattern of the names that it stands for."""
        expression = re.escape(self.name)
        expression = expression.replace("AXES", "[xyz][xyz]").replace("AXIS", "[xyz]")
        return re.compile(expression.replace("NAME", r"\w+"))

    @property
    def length(self) -> int:
        """Length of the fixed part of the name: the longer, the better it fits."""
        return len(re.sub("NAME|AXES|AXIS", "", self.name))


def read(kind: str) -> list[Item]:
    """The items of doc/results/`kind`.toml."""
    path = site.DOC / "results" / f"{kind}.toml"
    with path.open("rb") as file:
        groups = tomllib.load(file)
    return [
        Item(
            name,
            entry.get("unit", ""),
            " ".join(entry["meaning"].split()),
            entry.get("when", ""),
            group,
        )
        for group, entries in groups.items()
        for name, entry in entries.items()
    ]


def find(items: list[Item], name: str) -> Item | None:
    """The item that describes a name."""
    fitting = [item for item in items if item.pattern.fullmatch(name)]
    return max(fitting, key=lambda item: item.length) if fitting else None


def _section(title: str, kind: str, introduction: str) -> str:
    pieces = [f"## {title}", introduction]
    group = None
    for item in read(kind):
        if item.group != group:
            group = item.group
            pieces.append(f"### {text.plain(group)}")
        unit = f" ({text.plain(item.unit)})" if item.unit else ""
        when = f" *{text.plain(item.when)}*" if item.when else ""
        pieces.append(f"`{item.name}`{unit}\n: {item.meaning}{when}")
    return "\n\n".join(pieces)


def make(made: site.Site) -> None:
    """Write the page, around the text in doc/results/index.md."""
    hand = (site.DOC / "results" / "index.md").read_text(encoding="utf-8")
    hand = re.sub(r"\A<!--.*?-->\s*", "", hand, flags=re.DOTALL)
    made.page(
        f"{FOLDER}/index",
        "\n\n".join(
            [
                text.with_includes(hand, f"{FOLDER}/index"),
                _section(
                    "The console",
                    "console",
                    "A line for each step (`Output/Log every`), under these heads. The same "
                    "lines are in `log.txt`.",
                ),
                _section(
                    "The table energy.csv",
                    "columns",
                    "A row for each step, and one for the start; the unit stands in brackets "
                    "behind the name. Works and dissipations are sums since the start. `NAME` "
                    "stands for the name of a contact, a body or a probe, `AXIS` for x, y or z. "
                    "A value that does not exist is empty. `energy.h5` holds the same columns, "
                    "each a data set with the attribute `unit`.",
                ),
                _section(
                    "The fields",
                    "fields",
                    "`solution.pvd` lists the files `solution/step-NNNNNN.vtu` with their times "
                    "(`Output/Fields every`). They hold these fields on the undeformed body, in "
                    "the points of the finite elements.",
                ),
            ]
        ),
    )
