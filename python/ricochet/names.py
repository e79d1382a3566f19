# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names that do not exist, answered with the nearest one that does."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Mapping
from typing import TypeVar

from .errors import RicochetError

Value = TypeVar("Value")

#: More names than these are not listed.
MOST_LISTED = 20


class NoSuchName(RicochetError, KeyError):
    """There is no column, contact, parameter or field of this name."""

    # A KeyError shows its message in quotation marks.
    __str__ = Exception.__str__


def nearest(name: str, names: Collection[str]) -> str | None:
    """The name that is most like another one; None if there is none at all."""
    known = {each.casefold(): each for each in names}
    found = difflib.get_close_matches(str(name).casefold(), known, 1, cutoff=0.0)
    return known[found[0]] if found else None


def no_such(what: str, name: str, names: Collection[str]) -> NoSuchName:
    """The error for a name that is not among `names`; `what` is said before it."""
    meant = nearest(name, names)
    text = f"There is no {what} '{name}'." + (f" Is '{meant}' meant?" if meant else "")
    if 0 < len(names) <= MOST_LISTED:
        text += f" There is: {', '.join(names)}."
    return NoSuchName(text)


class Named(dict[str, Value]):
    """A dictionary that answers a name which it has not with the nearest one."""

    def __init__(self, what: str, values: Mapping[str, Value]) -> None:
        super().__init__(values)
        self.what = what

    def __missing__(self, name: str) -> Value:
        raise no_such(self.what, name, self)
