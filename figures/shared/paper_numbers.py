# SPDX-License-Identifier: LGPL-2.1-or-later
"""The papers' numbers and ours, from figures/numbers/*.toml.

Each number has a name such as "A.table_1.persistent". The file has the printed number, ours, and
the tolerance of ours: a check fails on either side of it, whether the paper's number is met or not.
Where it is not met the file says why, or what was tried; and where that is no longer so, the check
fails as well.
"""

import functools
import tomllib
from dataclasses import dataclass

import numpy as np
from ricochet import RicochetError

from . import CHECKOUT
from .figure import DIFFERS, NO, YES, Check

FOLDER = CHECKOUT / "figures" / "numbers"

# Keys that a number inherits from its place.
INHERITED = ("band", "within", "why")
# Possible keys of a place and of its numbers.
SERIES = "series"  # of a place: lists of numbers of the paper that are drawn beside ours
PLACE_KEYS = {"figure", "source", "about", *INHERITED}
NUMBER_KEYS = {"of", "paper", "holds", "exact", "ours", "band", "tolerance", "within", "why"} | {
    "tried"
}


def _text(value):
    return f"{value:.4g}" if isinstance(value, (int, float)) else str(value)


def _range_text(ends):
    """A number, or two with "to" between them."""
    least, most = (_text(float(end)) for end in ends)
    return least if least == most else f"{least} to {most}"


def _ends(value):
    """Least and most of a number or of a list of two."""
    return tuple(value) if isinstance(value, list) else (value, value)


@dataclass(frozen=True)
class PaperNumber:
    """A number that a paper prints, or a statement of it, beside ours.

    `paper` is a number, a list of two (from, to), or the text of a statement, which says that
    ours lies in `holds`; none: no paper prints it. `ours` may be a list of two: the least and the
    most over the positions of the impact within a step.
    """

    name: str
    figure: str  # the one that checks it
    source: str
    quantity: str
    paper: object = None
    holds: list | None = None
    exact: object = None
    ours: object = None
    band: float = 0.01  # relative; how far ours may be off what is written down
    tolerance: float = 0.0  # the same, absolute: for what is zero
    within: float = 0.05  # how far the paper's number may be off ours, relative
    why: str = ""  # why it is off
    tried: str = ""  # what was tried to reproduce it

    @property
    def paper_text(self):
        if self.paper is None:
            return "-"
        return self.paper if isinstance(self.paper, str) else _range_text(_ends(self.paper))

    @property
    def ours_text(self):
        return "-" if self.ours is None else _range_text(_ends(self.ours))

    @property
    def band_text(self):
        return f"± {self.tolerance:g}" if self.tolerance else f"± {100 * self.band:g} %"

    def is_met(self, ours):
        """Whether ours agrees with what the paper prints.

        A statement has to hold for all of ours; a number of the paper has to be among ours, or
        at most the part `within` of itself off.
        """
        if self.paper is None:
            return True
        if isinstance(self.paper, str):
            least, most = self.holds
            return least <= ours[0] and ours[1] <= most
        least, most = _ends(self.paper)
        slack = max(self.within * max(abs(least), abs(most)), self.tolerance)
        return ours[0] <= most + slack and ours[1] >= least - slack

    @property
    def verdict(self):
        """Comparison of ours with the paper's, in words."""
        if self.paper is None or self.ours is None:
            return ""
        verdict = f"differs: {self.why}" if self.why else "not reproduced"
        if self.tried:
            verdict += f"; tried: {self.tried}"
        if self.why or self.tried:
            return verdict
        if isinstance(self.paper, str):
            return "holds"
        (least, most), (first, last) = _ends(self.paper), _ends(self.ours)
        off = max(least - last, first - most, 0.0)
        if off == 0.0:
            return "equal" if first == last else "within the positions"
        off /= max(abs(least), abs(most))
        return f"equal within {100 * off:.1g} %"

    def is_pinned(self, ours):
        """Whether ours is the recorded number, within the band and round-off."""
        written = _ends(self.ours)
        slack = max(self.tolerance, 1e-9 * max(map(abs, written)))
        return all(
            abs(value - end) <= max(self.band * abs(end), slack)
            for value, end in zip(ours, written)
        )


def _read(path):
    with open(path, "rb") as file:
        try:
            return tomllib.load(file)
        except tomllib.TOMLDecodeError as error:
            raise RicochetError(f"figures/numbers/{path.name} cannot be read: {error}.") from None


def _refuse_unknown(keys, known, where):
    unknown = sorted(set(keys) - known)
    if unknown:
        raise RicochetError(
            f"{where}: no {', '.join(unknown)} is known; there are {', '.join(sorted(known))}."
        )


def _number(place, name, values, general):
    where = f"figures/numbers: {place}.{name}"
    _refuse_unknown(values, NUMBER_KEYS, where)
    if isinstance(values.get("paper"), str) != ("holds" in values):
        raise RicochetError(f"{where}: a text of the paper, and only that, needs 'holds'.")
    about = [general.get("about", ""), values.get("of", name.replace("_", " "))]
    return PaperNumber(
        f"{place}.{name}",
        general["figure"],
        general["source"],
        ": ".join(part for part in about if part),
        **{key: general[key] for key in INHERITED if key in general and key not in values},
        **{key: value for key, value in values.items() if key != "of"},
    )


@functools.cache
def everything():
    """All numbers by their names.

    Raises:
        RicochetError: a file cannot be read, or a place has no figure or no source.
    """
    found = {}
    for path in sorted(FOLDER.glob("*.toml")):
        for place, values in _read(path).items():
            general = {key: value for key, value in values.items() if not isinstance(value, dict)}
            numbers = {
                key: value
                for key, value in values.items()
                if isinstance(value, dict) and key != SERIES
            }
            _refuse_unknown(general, PLACE_KEYS, f"figures/numbers/{path.name}: [{place}]")
            for needed in ("figure", "source"):
                if needed not in general:
                    raise RicochetError(
                        f"figures/numbers/{path.name}: [{place}] has no '{needed}'."
                    )
            where = f"{path.stem}.{place}"
            found |= {
                f"{where}.{name}": _number(where, name, value, general)
                for name, value in numbers.items()
            }
    return found


def of_figure(figure):
    """The names of the numbers that a figure has to check."""
    return {name for name, number in everything().items() if number.figure == figure}


def paper_number(name):
    """A number by its name.

    Raises:
        RicochetError: there is none of this name.
    """
    try:
        return everything()[name]
    except KeyError:
        raise RicochetError(f"figures/numbers has no number '{name}'.") from None


def numbers(place):
    """The paper's numbers at a place, such as "A.table_1", by the names of its numbers."""
    found = {
        name.removeprefix(f"{place}."): number.paper
        for name, number in everything().items()
        if name.startswith(f"{place}.")
    }
    if not found:
        raise RicochetError(f"figures/numbers has no place '{place}'.")
    return found


def series(place):
    """The lists of a place, such as the seconds of a table, by their names."""
    paper, _, part = place.partition(".")
    return _read(FOLDER / f"{paper}.toml")[part][SERIES]


def compare(name, values):
    """The row of a number: ours against what is written down, and beside the paper's.

    `values`: one number, or those of all positions of the impact.
    """
    number = paper_number(name)
    values = np.atleast_1d(np.asarray(values, float))
    ours = float(values.min()), float(values.max())
    # A single number stands for itself, positions for the least and the most of them.
    if number.ours is not None and isinstance(number.ours, list) != (len(values) > 1):
        number_of = "a list of two" if len(values) > 1 else "one number"
        raise RicochetError(f"figures/numbers: {name}: ours has to be {number_of}.")
    differs = bool(number.why or number.tried)
    if number.ours is None:
        status, criterion = NO, "ours is not written down"
    elif not number.is_pinned(ours):
        status, criterion = NO, f"not {number.ours_text} {number.band_text}"
    elif number.is_met(ours) == differs:
        status = NO
        criterion = (
            "the paper's number is met: its 'why' is not needed any more"
            if differs
            else "the paper's number is not met, and no 'why' says so"
        )
    else:
        status = DIFFERS if differs else YES
        criterion = "; ".join(
            part for part in (f"{number.ours_text} {number.band_text}", number.verdict) if part
        )
    return Check(
        number.quantity,
        _range_text(ours),
        status,
        number.paper_text,
        "-" if number.exact is None else _text(number.exact),
        criterion,
        number=name,
    )
