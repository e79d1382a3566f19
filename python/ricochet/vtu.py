# SPDX-License-Identifier: LGPL-2.1-or-later
"""VTU files as the programs write them, read without VTK's reader.

That one crashes on damaged files, or takes all memory; here every number is compared with what the
file really holds before VTK sees any of it. The format: XML with arrays as text or as zlib blocks
in base64; a program on several ranks writes a piece for each.
"""

from __future__ import annotations

import base64
import pathlib
import zlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any
from xml.parsers import expat

import numpy as np
from numpy.typing import NDArray

from . import files

#: Numbers of points of VTK's cells, by type.
POINTS_OF_CELLS = {
    1: 1,  # vertex
    3: 2,  # line
    5: 3,  # triangle
    9: 4,  # quadrilateral
    10: 4,  # tetrahedron
    12: 8,  # hexahedron
    13: 6,  # wedge
    14: 5,  # pyramid
    21: 3,  # quadratic line
    22: 6,  # quadratic triangle
    23: 8,  # quadratic quadrilateral
    24: 10,  # quadratic tetrahedron
    25: 20,  # quadratic hexahedron
}
TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}


@dataclass
class _Array:
    attributes: dict[str, str]
    text: list[str] = field(default_factory=list)


@dataclass
class _Piece:
    n_points: int
    n_cells: int
    #: Arrays by "PointData/velocity".
    arrays: dict[str, _Array] = field(default_factory=dict)


@dataclass
class Grid:
    """Contents of a file."""

    points: NDArray[Any]
    #: The points of all cells, and for each cell where they end.
    corners: NDArray[Any]
    ends: NDArray[Any]
    types: NDArray[Any]
    #: Values at the points, (n, components).
    fields: dict[str, NDArray[Any]]


class _Reader:
    """Collects the arrays of all pieces while XML is parsed."""

    def __init__(self) -> None:
        self.pieces: list[_Piece] = []
        self.is_grid = False
        self._part = ""
        self._open: _Array | None = None

    def start(self, name: str, attributes: dict[str, str]) -> None:
        if name == "VTKFile":
            self.is_grid = (
                attributes.get("type") == "UnstructuredGrid"
                and attributes.get("byte_order") == "LittleEndian"
                and attributes.get("header_type", "UInt32") == "UInt32"
            )
        elif name == "Piece":
            n_points, n_cells = (int(attributes[f"NumberOf{of}"]) for of in ("Points", "Cells"))
            self.pieces.append(_Piece(n_points, n_cells))
        elif name in ("Points", "Cells", "PointData"):
            self._part = name
        elif name == "DataArray" and self._part:
            self._open = _Array(attributes)
            own = attributes["Name"] if self._part != "Points" else "places"
            self.pieces[-1].arrays[f"{self._part}/{own}"] = self._open

    def end(self, name: str) -> None:
        if name == "DataArray":
            self._open = None
        elif name == self._part:
            self._part = ""

    def text(self, text: str) -> None:
        if self._open is not None:
            self._open.text.append(text)


def _numbers(array: _Array, n: int) -> NDArray[Any]:
    """The values of an array, (n, components); `n` is what the piece says."""
    kind = np.dtype(TYPES[array.attributes["type"]])
    components = int(array.attributes.get("NumberOfComponents", "1"))
    text = "".join(array.text)
    if n < 0 or components < 1:
        raise ValueError("a number of values is negative")
    if array.attributes["format"] == "ascii":
        return np.array(text.split(), dtype=kind).reshape(n, components)
    if array.attributes["format"] != "binary":
        raise ValueError("an array is neither text nor binary")
    data = _unpacked(text, kind.itemsize * n * components)
    return np.frombuffer(data, kind).reshape(n, components)


def _whole_numbers(array: _Array, n: int) -> NDArray[np.int64]:
    """The values of an array that numbers something."""
    if array.attributes["type"] not in ("Int32", "Int64", "UInt8"):
        raise ValueError("its cells are numbered by fractions")
    return _numbers(array, n)[:, 0].astype(np.int64)


def _unpacked(text: str, size: int) -> bytes:
    """The bytes of zlib blocks in base64: the numbers of blocks, of bytes in each and in the last
    one, and of compressed bytes in each block, as UInt32, and then the blocks."""
    text = "".join(text.split())
    if size == 0:
        return b""
    n_blocks = int.from_bytes(base64.b64decode(text[:8], validate=True)[:4], "little")
    length = 4 * ((4 * (3 + n_blocks) + 2) // 3)
    if length > len(text):
        raise ValueError("a header is longer than its array")
    header = np.frombuffer(
        base64.b64decode(text[:length], validate=True)[: 4 * (3 + n_blocks)], "<u4"
    )
    data, parts, at = base64.b64decode(text[length:], validate=True), [], 0
    left = size
    for compressed in header[3:]:
        # No more than the array should have, whatever the block holds.
        block = zlib.decompressobj()
        parts.append(block.decompress(data[at : at + int(compressed)], left + 1))
        left -= len(parts[-1])
        at += int(compressed)
        if left < 0 or not block.eof:
            raise ValueError("an array has more values than the piece says")
    if left:
        raise ValueError("an array has fewer values than the piece says")
    return b"".join(parts)


def parse(
    data: bytes,
    start: Callable[[str, dict[str, str]], None],
    end: Callable[[str], None] | None = None,
    text: Callable[[str], None] | None = None,
) -> None:
    """Call functions with what an XML file has, in its order.

    Raises:
        ValueError: it is no XML, or declares a document type: entities can be of any size.
    """

    def refuse(*_: object) -> None:
        raise ValueError("it declares a document type")

    # Whatever encoding the file names.
    parser = expat.ParserCreate("utf-8")
    parser.buffer_text = True
    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise ValueError(str(error)) from None


def entries(path: pathlib.Path) -> list[tuple[float, str]]:
    """The times and names of the files in a list of them, solution.pvd.

    Raises:
        OSError: the list cannot be read.
        ValueError, KeyError: it is damaged.
    """
    found: list[tuple[float, str]] = []

    def add(element: str, attributes: dict[str, str]) -> None:
        if element == "DataSet":
            found.append((float(attributes["timestep"]), attributes["file"]))

    parse(files.read_bytes(path), add)
    return found


def read(path: pathlib.Path) -> Grid:
    """Read a file; all of its pieces become one grid.

    Raises:
        OSError: the file cannot be read.
        ValueError: it is damaged, or none that the programs write.
    """
    reader = _Reader()
    try:
        parse(files.read_bytes(path, largest=None), reader.start, reader.end, reader.text)
        if not reader.is_grid or not reader.pieces:
            raise ValueError("it is no unstructured grid of Ricochet")
        grids = [_grid(piece) for piece in reader.pieces]
    except KeyError as error:
        raise ValueError(f"{error} is missing or unknown") from None
    except (zlib.error, LookupError, OverflowError, MemoryError) as error:
        raise ValueError(str(error) or "it does not fit into the memory") from None
    fields = grids[0].fields.keys()
    if any(grid.fields.keys() != fields for grid in grids):
        raise ValueError("its pieces have different fields")
    first_points = np.cumsum([0, *(len(grid.points) for grid in grids)])
    first_corners = np.cumsum([0, *(len(grid.corners) for grid in grids)])
    return Grid(
        np.concatenate([grid.points for grid in grids]),
        np.concatenate([grid.corners + first for grid, first in zip(grids, first_points)]),
        np.concatenate([grid.ends + first for grid, first in zip(grids, first_corners)]),
        np.concatenate([grid.types for grid in grids]),
        {name: np.concatenate([grid.fields[name] for grid in grids]) for name in fields},
    )


def _grid(piece: _Piece) -> Grid:
    """The parts of a piece, each checked against the others."""
    points = _numbers(piece.arrays["Points/places"], piece.n_points)
    types = _whole_numbers(piece.arrays["Cells/types"], piece.n_cells)
    ends = _whole_numbers(piece.arrays["Cells/offsets"], piece.n_cells)
    kinds, number = np.unique(types, return_inverse=True)
    sizes = np.array([POINTS_OF_CELLS[kind] for kind in kinds.tolist()], dtype=np.int64)[number]
    if not np.array_equal(ends, np.cumsum(sizes)):
        raise ValueError("its cells have other numbers of points than their types")
    if points.shape[1] != 3 or not np.isfinite(points).all():
        raise ValueError("its points are not three finite numbers each")
    corners = _whole_numbers(piece.arrays["Cells/connectivity"], int(sizes.sum()))
    if corners.size and not 0 <= corners.min() <= corners.max() < piece.n_points:
        raise ValueError("a cell has a point that does not exist")
    fields = {
        name.partition("/")[2]: _numbers(array, piece.n_points)
        for name, array in piece.arrays.items()
        if name.startswith("PointData/")
    }
    return Grid(points, corners, ends, types, fields)
