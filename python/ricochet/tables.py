# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the programs: CSV files whose header is `name [unit],name [unit],...`, and HDF5."""

from __future__ import annotations

import csv
import os
import pathlib
import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import files, hdf5
from .errors import NotARun
from .names import Named, no_such

Array = NDArray[np.float64]

@dataclass(frozen=True)
class Table:
    """The columns of a table by their names, and their units.

    As of a DataFrame of pandas, `in` and iteration are those of the names, and `len` is the number
    of rows.
    """

    columns: dict[str, Array]
    units: dict[str, str]

    def __getitem__(self, name: str) -> Array:
        """A column. A value that does not exist, an empty cell, is not a number.

        Raises:
            NoSuchName: there is no such column; the message has the nearest one.
        """
        if name not in self.columns:
            raise no_such("column", name, self.columns)
        return self.columns[name]

    def __contains__(self, name: str) -> bool:
        return name in self.columns

    def __iter__(self) -> Iterator[str]:
        """The names of the columns."""
        return iter(self.columns)

    def __len__(self) -> int:
        """The number of rows."""
        return len(next(iter(self.columns.values()), ()))


def read_table(path: str | os.PathLike[str]) -> Table:
    """Read a table.

    A last line without an end is one that a run has not finished writing; it is left out.

    Raises:
        NotARun: the file is missing, or is no such table.
    """
    path = pathlib.Path(path)
    try:
        text = files.read_text(path, largest=None)
        # Text after the last end of a line is not complete, nor is an empty line a row.
        lines = [line for line in text.split("\n")[:-1] if line.strip()]
        header = next(csv.reader(lines[:1]), None)
    except FileNotFoundError:
        raise NotARun(f"There is no table '{path}'.") from None
    except (OSError, ValueError, csv.Error) as error:
        raise NotARun(f"The table '{path}' cannot be read: {error}.") from None
    if header is None:
        raise NotARun(f"The table '{path}' is empty.")
    names, units = [], {}
    for cell in header:
        match = re.fullmatch(r"(.*?)(?: \[([^\]]*)\])?", cell.strip())
        assert match is not None  # it matches any text
        names.append(match.group(1))
        units[match.group(1)] = match.group(2) or ""

    values = np.empty((len(lines) - 1, len(names)))
    for number, line in enumerate(lines[1:]):
        cells = line.split(",")
        if len(cells) != len(names):
            raise NotARun(
                f"The table '{path}' has {len(cells)} cells in row {number + 1}, "
                f"and {len(names)} columns."
            )
        try:
            values[number] = [float(cell) if cell.strip() else np.nan for cell in cells]
        except ValueError:
            raise NotARun(
                f"The table '{path}' has something that is not a number in row {number + 1}."
            ) from None
    return Table(dict(zip(names, values.T)), Named("column", units))


def read_hdf5(path: str | os.PathLike[str]) -> Table:
    """Read a table of HDF5: one data set of numbers for each column, its unit an attribute.

    Columns are in the order of the alphabet, as the file has them.

    Raises:
        NotARun: the file is missing, damaged, or no such table.
        RicochetError: h5py is missing.
    """
    path = pathlib.Path(path)
    found = hdf5.read([path])[0]
    lengths = {array.shape for array in found.arrays.values()}
    if len(lengths) != 1 or len(lengths.pop()) != 1 or not all(found.units.values()):
        raise NotARun(f"The file '{path}' is no energy table of HDF5.")
    return Table(found.arrays, Named("column", found.units))
