# SPDX-License-Identifier: LGPL-2.1-or-later
"""The papers' numbers, from figures/paper_numbers.toml."""

import functools
import tomllib

from ricochet import RicochetError

from . import CHECKOUT

FILE = CHECKOUT / "figures" / "paper_numbers.toml"


class Numbers(dict):
    """Numbers by their names; one that is not there is an error that names those that are."""

    def __init__(self, place, values):
        super().__init__(
            (name, Numbers(f"{place}.{name}" if place else name, value))
            if isinstance(value, dict)
            else (name, value)
            for name, value in values.items()
        )
        self.place = place

    def __missing__(self, name):
        where = f"[{self.place}] of " if self.place else ""
        raise RicochetError(
            f"There is no '{name}' in {where}figures/{FILE.name}; there are {', '.join(self)}."
        )


@functools.cache
def everything():
    """All papers, of each its places."""
    with open(FILE, "rb") as file:
        try:
            return Numbers("", tomllib.load(file))
        except tomllib.TOMLDecodeError as error:
            raise RicochetError(f"figures/{FILE.name} cannot be read: {error}.") from None


def numbers(place):
    """The numbers of a place of a paper, such as "A.table_1".

    Raises:
        RicochetError: it is not in the file, or the file does not tell its source.
    """
    found = everything()
    for part in place.split("."):
        found = found[part]
    found["source"]  # each place has to tell it
    return found
