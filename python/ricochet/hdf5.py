# SPDX-License-Identifier: LGPL-2.1-or-later
"""HDF5 files of the programs, as arrays."""

from __future__ import annotations

import importlib.util
import json
import math
import pathlib
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .errors import NotARun, RicochetError

#: The program that reads HDF5, and how long it may take (s).
READER = pathlib.Path(__file__).with_name("hdf5_reader.py")
LONGEST = 60.0

#: Files that are read by one process.
AT_ONCE = 500


@dataclass(frozen=True)
class Hdf5:
    """The contents of a file."""

    #: Data sets by their paths, in the order of the alphabet, and their units.
    arrays: dict[str, NDArray[np.float64]]
    units: dict[str, str]
    #: Numbers of the whole file.
    attributes: dict[str, float]


def read(paths: Sequence[pathlib.Path]) -> list[Hdf5]:
    """All numbers of some files.

    Raises:
        NotARun: a file is missing or damaged.
        RicochetError: h5py is missing.
    """
    for path in paths:
        if not path.is_file():
            raise NotARun(f"There is no file '{path}'.")
    if importlib.util.find_spec("h5py") is None:
        raise RicochetError(f"'{paths[0]}' needs h5py: install the package python3-h5py.")
    result: list[Hdf5] = []
    for begin in range(0, len(paths), AT_ONCE):
        result += _read(paths[begin : begin + AT_ONCE])
    return result


def _read(paths: Sequence[pathlib.Path]) -> list[Hdf5]:
    try:
        # -P: modules beside the program are none of h5py's.
        data = subprocess.run(
            [sys.executable, "-P", str(READER), *map(str, paths)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=LONGEST,
        ).stdout
    except subprocess.TimeoutExpired as error:
        data = error.stdout or b""
    result: list[Hdf5] = []
    end = 0
    while end < len(data):
        line, _, _ = data[end:].partition(b"\n")
        header, end = json.loads(line), end + len(line) + 1
        arrays, units = {}, {}
        for name, unit, shape in header["arrays"]:
            n = math.prod(shape)
            arrays[name] = np.frombuffer(data, count=n, offset=end).reshape(shape).copy()
            units[name] = unit
            end += 8 * n
        result.append(Hdf5(arrays, units, header["attributes"]))
    if len(result) < len(paths):
        raise NotARun(f"The file '{paths[len(result)]}' is damaged or is none of ours.")
    return result
