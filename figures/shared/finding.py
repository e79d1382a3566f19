# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the figures: each is a file figure_*.py or table_*.py in a folder beside this one."""

import importlib
import re

from ricochet import RicochetError

from . import CHECKOUT


def _name_of(path):
    """The name that a file is for: A-3 for figure_a_03.py, A-T1 for table_a_1.py."""
    match = re.fullmatch(r"(figure|table)_([a-z])_(\d+)", path.stem)
    if not match:
        raise RicochetError(
            f"figures/{path.parent.name}/{path.name} should be called like figure_a_03.py "
            "or table_a_1.py."
        )
    kind, letter, number = match.groups()
    return f"{letter.upper()}-{'T' if kind == 'table' else ''}{int(number)}"


def _place(name):
    """Figures of a paper before its tables, by their numbers."""
    letter, number = name.split("-")
    return letter, number.startswith("T"), int(number.removeprefix("T"))


def find():
    """All figures by their names, in order.

    Raises:
        RicochetError: a file is not that of its figure, or two are of the same.
    """
    figures = {}
    folder = CHECKOUT / "figures"
    for path in sorted([*folder.glob("*/figure_*.py"), *folder.glob("*/table_*.py")]):
        name = _name_of(path)
        figure = importlib.import_module(f"{path.parent.name}.{path.stem}").FIGURE
        if figure.name != name or name in figures:
            raise RicochetError(
                f"figures/{path.parent.name}/{path.name} holds the figure {figure.name}"
                + (", and so does another file." if name in figures else f", not {name}.")
            )
        figures[name] = figure
    return dict(sorted(figures.items(), key=lambda entry: _place(entry[0])))
