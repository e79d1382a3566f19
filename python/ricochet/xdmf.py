# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields in HDF5 files (Output/Fields format = hdf5), and the XDMF file that lists them."""

from __future__ import annotations

import pathlib

import numpy as np

from . import files, hdf5, vtu

#: VTK's types of cells, by the dimension of space and the number of corners.
CELLS = {(1, 2): 3, (2, 3): 5, (2, 4): 9, (3, 4): 10, (3, 8): 12}


def entries(path: pathlib.Path) -> list[tuple[float, str]]:
    """The times and names of the files in a list.

    Raises:
        OSError: the list cannot be read.
        ValueError: it is damaged.
    """
    times: list[float] = []
    names: list[str] = []
    is_points = False

    def start(element: str, attributes: dict[str, str]) -> None:
        nonlocal is_points
        if element == "Time":
            times.append(float(attributes["Value"]))
        is_points = is_points or element == "Geometry"

    def end(element: str) -> None:
        nonlocal is_points
        is_points = is_points and element != "Geometry"

    def text(words: str) -> None:
        if is_points and ":" in words:
            names.append(words.strip().rpartition(":")[0])

    vtu.parse(files.read_bytes(path), start, end, text)
    if len(times) != len(names):
        raise ValueError("it has other numbers of times and files")
    return list(zip(times, names))


def read(path: pathlib.Path) -> vtu.Grid:
    """The grid of a file and its fields; the components of the stress are one field.

    Raises:
        NotARun: the file is missing or damaged.
        ValueError: it holds no fields.
    """
    found = dict(hdf5.read([path])[0].arrays)
    try:
        nodes, cells = found.pop("nodes"), found.pop("cells").astype(np.int64)
        n_corners, kind = cells.shape[1], CELLS[nodes.shape[1], cells.shape[1]]
    except (KeyError, IndexError):
        raise ValueError("it has no nodes or no cells that are known") from None
    if not np.isfinite(nodes).all() or not 0 <= cells.min(initial=0) <= cells.max(initial=0) < len(
        nodes
    ):
        raise ValueError("a cell has a point that does not exist")
    if any(len(values) != len(nodes) for values in found.values()):
        raise ValueError("a field has other points than the grid")
    n, dim = nodes.shape
    stress = np.zeros((n, 3, 3))
    components = {
        f"stress_{a}{b}": (i, j)
        for i, a in enumerate("xyz"[:dim])
        for j, b in enumerate("xyz"[:dim])
    }
    for name, (i, j) in components.items():
        if name in found:
            stress[:, i, j] = stress[:, j, i] = found.pop(name).reshape(n)
    fields = {name: values.reshape(n, -1) for name, values in found.items()}
    fields["stress"] = stress[:, 0, 0, None] if dim == 1 else stress.reshape(n, 9)
    return vtu.Grid(
        np.pad(nodes, ((0, 0), (0, 3 - dim))),
        cells.reshape(-1),
        n_corners * np.arange(1, len(cells) + 1),
        np.full(len(cells), kind),
        fields,
    )
