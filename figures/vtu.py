# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the VTU files of the programs: triangles with fields at their vertices.

Of a quadrilateral two triangles are made. Each cell has vertices of its own in such a
file; `read` joins those that are in the same place, so that a sum over nodes counts each
of them once.
"""

import base64
import re
import zlib

import numpy as np

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}
ARRAY = re.compile(r"<DataArray([^>]*)>([^<]*)</DataArray>")


def _decode(text, dtype):
    """An array in base64, compressed in blocks.

    In front of it stand the number of blocks, their size, the size of the last
    one, and the compressed size of each, in 32 bits and in a base64 of their own.
    """
    text = "".join(text.split())
    n_blocks = int(np.frombuffer(base64.b64decode(text[:8])[:4], "<u4")[0])
    length = 4 * -(-4 * (3 + n_blocks) // 3)
    header = np.frombuffer(base64.b64decode(text[:length])[: 4 * (3 + n_blocks)], "<u4")
    data = base64.b64decode(text[length:])
    ends = np.concatenate(([0], np.cumsum(header[3:], dtype=np.int64))).astype(np.int64)
    blocks = [zlib.decompress(data[a:b]) for a, b in zip(ends[:-1], ends[1:])]
    return np.frombuffer(b"".join(blocks), dtype)


def read(path):
    """Vertices (n, 2), triangles (m, 3) and a dictionary of fields (n, components)."""
    arrays = {}
    for attributes, text in ARRAY.findall(path.read_text(encoding="utf-8")):
        attribute = dict(re.findall(r'(\w+)="([^"]*)"', attributes))
        # The time is written in plain text, and is no field.
        if attribute.get("format") == "ascii":
            continue
        values = _decode(text, TYPES[attribute["type"]])
        if "NumberOfComponents" in attribute:
            values = values.reshape(-1, int(attribute["NumberOfComponents"]))
        arrays[attribute.get("Name", "vertices")] = values
    points = arrays.pop("vertices")[:, :2].astype(float)
    connectivity, offsets = arrays.pop("connectivity"), arrays.pop("offsets")
    cells = connectivity.reshape(len(offsets), -1)
    if cells.shape[1] == 4:
        cells = np.concatenate((cells[:, (0, 1, 2)], cells[:, (0, 2, 3)]))
    del arrays["types"]

    # Points in the same place have bitwise the same coordinates, but for the
    # last digit of some: a millionth of the largest coordinate joins them.
    key = np.round(points / (1e-6 * np.abs(points).max())).astype(np.int64)
    _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    fields = {name: values[first] for name, values in arrays.items()}
    # An element-wise constant field has a value per cell here; keep those too.
    fields.update({f"{name} of cells": values[cells[:, 0]] for name, values in arrays.items()})
    return points[first], inverse.reshape(-1)[cells], fields
