# SPDX-License-Identifier: LGPL-2.1-or-later
"""A program that prints the numbers of HDF5 files, for `hdf5.read`.

A process of its own, since the HDF5 library crashes on some damaged files, or does not end: of
files in which a few bytes were changed at random, one in thirty.
"""

import json
import os
import resource
import sys
from typing import Any

import h5py
import numpy as np

#: Groups within groups, and data sets, at most.
DEPTH, MOST = 3, 10000


def add_arrays(group: Any, prefix: str, size: int, found: dict[str, tuple[str, Any]]) -> None:
    """Add the data sets of a group and of the groups in it, by their paths.

    size: bytes of the file. Numbers that are not stored would take any memory.
    """
    for name in group:
        # Links and raw data outside of the file lead to files of the reader.
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise ValueError(name)
        member, path = group[name], prefix + name
        if isinstance(member, h5py.Group):
            if path.count("/") == DEPTH:
                raise ValueError(path)
            add_arrays(member, path + "/", size, found)
            continue
        if member.external or member.is_virtual or member.dtype.kind not in "fiu":
            raise ValueError(path)
        if member.size * member.dtype.itemsize > size or len(found) == MOST:
            raise ValueError(path)
        found[path] = (str(member.attrs.get("unit", "")), member[...].astype("<f8"))


def write(path: str) -> None:
    """Print a line of JSON with attributes, and paths, units and shapes of all data sets; and then
    the numbers of each."""
    found: dict[str, tuple[str, Any]] = {}
    with h5py.File(path, "r") as file:
        add_arrays(file, "", os.path.getsize(path), found)
        attributes = {name: float(np.asarray(file.attrs[name]).item()) for name in file.attrs}
    header = {
        "attributes": attributes,
        "arrays": [[name, unit, list(array.shape)] for name, (unit, array) in found.items()],
    }
    sys.stdout.buffer.write(json.dumps(header).encode() + b"\n")
    for _, array in found.values():
        sys.stdout.buffer.write(array.tobytes())
    sys.stdout.buffer.flush()


def main(paths: list[str]) -> None:
    """Print one file after the other, up to one that is damaged."""
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 5 * 4
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    for path in paths:
        write(path)


if __name__ == "__main__":
    main(sys.argv[1:])
