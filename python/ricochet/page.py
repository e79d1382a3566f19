# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run as one HTML file: the deformed bodies, the energies, and a slider for the time.

It needs no network and nothing installed but a browser with WebGL 2. The mesh is that of the VTU
files; positions are stored with 16 bits of the box that holds them in all frames, so that they are
right to 1e-5 of its size.
"""

from __future__ import annotations

import base64
import html
import json
import math
import pathlib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import fields
from .errors import RicochetError
from .results import FieldFile, Run, read_fields
from .tables import Array

#: The whole file stays below this (bytes).
LARGEST = 10_000_000
#: So many colours stand for the values.
N_COLOURS = 256
TEMPLATE = pathlib.Path(__file__).with_name("page.html")
STEPS = 65535


@dataclass(frozen=True)
class Surface:
    """The outer faces of a grid, on points that cells share."""

    #: For each of its points, one point of the grid.
    first: Any
    #: For each point of the grid, that of the surface, or -1 inside of the body.
    number: Any
    triangles: Any
    edges: Any


def _packed(array: Any) -> str:
    """An array as text for JavaScript."""
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")


def surface_of(grid: Any) -> Surface:
    """The outer faces of a grid of cells in 2D or 3D, as triangles, and their edges.

    Cells of second order are shown by their corners.
    """
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

    first, number = fields.joined_points(grid)
    joined = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(fields.array_of_points(grid)[first], deep=True))
    joined.SetPoints(points)
    cells = vtk.vtkCellArray()
    connectivity = number[vtk_to_numpy(grid.GetCells().GetConnectivityArray())]
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    cells.SetData(
        *(numpy_to_vtkIdTypeArray(a.astype(np.int64), deep=True) for a in (offsets, connectivity))
    )
    joined.SetCells(grid.GetCellTypesArray(), cells)
    own_number = numpy_to_vtk(np.arange(len(first)), deep=True)
    own_number.SetName("number")
    joined.GetPointData().AddArray(own_number)
    outer = vtk.vtkDataSetSurfaceFilter()
    outer.SetInputData(joined)
    outer.SetNonlinearSubdivisionLevel(0)
    outer.Update()
    faces = outer.GetOutput()
    own = vtk_to_numpy(faces.GetPointData().GetArray("number"))
    offsets = vtk_to_numpy(faces.GetPolys().GetOffsetsArray())
    corners = vtk_to_numpy(faces.GetPolys().GetConnectivityArray())
    triangles, edges = [], set()
    for begin, end in zip(offsets[:-1], offsets[1:]):
        face = [int(v) for v in corners[begin:end]]
        triangles += [(face[0], face[k], face[k + 1]) for k in range(1, len(face) - 1)]
        edges |= {(min(a, b), max(a, b)) for a, b in zip(face, face[1:] + face[:1])}
    number_on_surface = np.full(len(first), -1)
    number_on_surface[own] = np.arange(len(own))
    return Surface(
        first[own],
        number_on_surface[number],
        np.array(triangles, dtype=np.uint32).reshape(-1, 3),
        np.array(sorted(edges), dtype=np.uint32).reshape(-1, 2),
    )


def _means(values: Array, surface: Surface) -> Array:
    """The mean over the cells around each point of the surface."""
    seen = surface.number >= 0
    number = surface.number[seen]
    count = np.bincount(number, minlength=len(surface.first))
    return np.bincount(number, values[seen], minlength=len(surface.first)) / count


def _in_steps(values: Array, low: Any, size: Any) -> Any:
    """Values as whole numbers from 0 to STEPS of a range."""
    return np.round((values - low) / size * STEPS).astype(np.uint16)


def _obstacles(files: Sequence[FieldFile]) -> dict[str, Any] | None:
    """Rigid obstacles: their faces, or lines in 2D, and the points of each frame."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    grids = [read_fields(file.obstacles) for file in files if file.obstacles]
    if not grids or not grids[0].GetNumberOfCells():
        return None
    places = [fields.array_of_points(grid) for grid in grids]
    if len(grids) < len(files) or any(len(p) != len(places[0]) for p in places):
        return None
    connectivity = vtk_to_numpy(grids[0].GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grids[0].GetCells().GetOffsetsArray())
    size = int(offsets[1] - offsets[0])
    cells = connectivity.reshape(-1, size)
    if size == 4:  # vertices of a quadrilateral are in the order of its circumference
        cells = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
    at_rest = all(np.array_equal(p, places[0]) for p in places)
    return {
        "corners": 2 if size == 2 else 3,
        "cells": _packed(cells.astype(np.uint32)),
        "points": _packed(np.array(places[:1] if at_rest else places, dtype=np.float32)),
        "n_points": len(places[0]),
    }


def _curves(run: Run) -> dict[str, Any]:
    """The columns that are drawn over time: energies, and the forces of contacts."""
    table, units = run.table, run.units
    plots = []
    energies = [
        ("kinetic_energy", "kinetic"),
        ("elastic_energy", "elastic"),
        ("total_energy", "total"),
        ("friction_work", "friction"),
        ("viscous_dissipation", "viscosity"),
    ]
    forces = [(f"contact_force_{name}", name.replace("_", " ")) for name in run.contacts]
    for title, columns in (("energy", energies), ("contact force", forces)):
        lines = [
            {
                "name": label,
                "values": [float(v) if math.isfinite(v) else None for v in table[column]],
            }
            for column, label in columns
            if column in table and (column in ("kinetic_energy", "elastic_energy")
                                    or np.nanmax(np.abs(table[column])) > 0.0)
        ]
        if lines:
            unit = units.get(next(column for column, _ in columns if column in table), "")
            plots.append({"title": f"{title} [{unit}]" if unit else title, "lines": lines})
    return {"time": [float(t) for t in table["time"]], "unit": units.get("time", ""),
            "plots": plots}


def _chosen(files: Sequence[FieldFile], bytes_of_frame: float, fixed: float) -> list[FieldFile]:
    """As many files, at even distances, as the page has room for.

    Raises:
        RicochetError: not even two.
    """
    room = int((LARGEST - fixed) / max(bytes_of_frame, 1.0))
    if room < 1:
        raise RicochetError(
            f"The mesh is too large for a page of {LARGEST // 1_000_000} MB. "
            "ricochet-plot --animation has no such bound."
        )
    if room >= len(files):
        return list(files)
    return [files[k] for k in np.unique(np.linspace(0, len(files) - 1, room).round().astype(int))]


def write(run: Run, path: pathlib.Path, colour: str, palette: Sequence[Any],
          most_frames: int) -> pathlib.Path:
    """Write the page of a run; return its path.

    Raises:
        RicochetError: the run has no fields, they are of a bar, or they are too large.
    """
    files = run.field_files
    grid = read_fields(files[0].path)
    dimension = fields.dimension(grid)
    if dimension == 1:
        raise RicochetError("A page shows bodies in 2D and 3D; this run has a bar.")
    surface = surface_of(grid)
    n = len(surface.first)
    curves = _curves(run)
    fixed = 40_000 + 16 * (len(surface.triangles) + len(surface.edges)) \
        + len(json.dumps(curves))
    # Three coordinates and a value of two bytes, and the text is a third longer.
    files = _chosen(files, 8 * n * 4 / 3 + 100, fixed)
    if len(files) > most_frames:
        files = [files[k] for k in np.unique(
            np.linspace(0, len(files) - 1, most_frames).round().astype(int))]
    places, shown = [], []
    for file in files:
        grid = read_fields(file.path)
        if grid.GetNumberOfPoints() != len(surface.number):
            raise RicochetError(f"'{file.path}' has another mesh than the first file.")
        moved = fields.array_of_points(grid) + fields.displacements(grid)
        places.append(moved[surface.first])
        shown.append(_means(fields.values(grid, colour), surface))
    all_places, all_shown = np.array(places), np.array(shown)
    low = all_places.min(axis=(0, 1))
    size = np.ptp(all_places, axis=(0, 1))
    size[size == 0.0] = 1.0
    limits = [float(np.nanmin(all_shown)), float(np.nanmax(all_shown))]
    unit = fields.unit(run.units, fields.COLOURS[colour].kind)
    data = {
        "dimension": dimension,
        "n_points": n,
        "times": [file.time for file in files],
        "low": low.tolist(),
        "size": size.tolist(),
        "positions": _packed(_in_steps(all_places, low, size)),
        "values": _packed(_in_steps(all_shown, limits[0], (limits[1] - limits[0]) or 1.0)),
        "limits": limits,
        "label": fields.COLOURS[colour].label + (f" [{unit}]" if unit else ""),
        "triangles": _packed(surface.triangles),
        "edges": _packed(surface.edges),
        "palette": [[round(255 * float(c)) for c in one[:3]] for one in palette],
        "obstacles": _obstacles(files),
        "curves": curves,
    }
    title = html.escape(f"{run.program}: {run.folder.name}")
    # A name in the data cannot end the script that it is in.
    text = json.dumps(data, allow_nan=False).replace("<", "\\u003c")
    # In one pass: a title may be the mark of the data.
    parts = {"@TITLE@": title, "@DATA@": text}
    template = TEMPLATE.read_text(encoding="utf-8")
    page = re.sub("@TITLE@|@DATA@", lambda mark: parts[mark[0]], template)
    if len(page) > LARGEST:
        raise RicochetError(f"The page would have {len(page) / 1e6:.1f} MB.")
    path.write_text(page, encoding="utf-8")
    return path
