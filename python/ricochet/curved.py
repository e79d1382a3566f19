# SPDX-License-Identifier: LGPL-2.1-or-later
"""Quadratic tetrahedra as VTK can cut and shade them: many small linear ones, and curved edges."""

from __future__ import annotations

from typing import Any

import numpy as np

from .tables import Array

QUADRATIC_TETRAHEDRON = 24  # VTK's number
# The vertices that a node in the middle of an edge lies between, in VTK's order.
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
# Nodes of the four faces: vertices, and the middle nodes of the sides between them.
FACES = ((0, 1, 2, 4, 5, 6), (0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (0, 2, 3, 6, 9, 7))


def joined(*arrays: Array) -> Array:
    """For each point a number, the same for points whose rows agree in all arrays."""
    columns = [np.round(a / (1e-6 * max(np.abs(a).max(), 1e-300))) for a in arrays]
    rows = np.concatenate(columns, axis=1).astype(np.int64)
    return np.asarray(np.unique(rows, axis=0, return_inverse=True)[1]).reshape(-1)


def averaged(values: Array, groups: Array) -> Array:
    """Values at points, the same for all points of a group: their mean."""
    return np.asarray((np.bincount(groups, values) / np.bincount(groups))[groups])


def is_quadratic(grid: Any) -> bool:
    """Whether a grid consists of quadratic tetrahedra."""
    types = {grid.GetCellType(cell) for cell in (0, grid.GetNumberOfCells() - 1)}
    return types == {QUADRATIC_TETRAHEDRON}


def nodes(grid: Any) -> Array:
    """The points of each cell, (n, 10)."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return np.asarray(vtk_to_numpy(grid.GetCells().GetConnectivityArray())).reshape(-1, 10)


def shape_functions(barycentric: Array) -> Array:
    """The ten shape functions at points of the tetrahedron, (m, 10)."""
    vertices = barycentric * (2 * barycentric - 1)
    middles = [4 * barycentric[:, i] * barycentric[:, j] for i, j in EDGES]
    return np.concatenate((vertices, np.stack(middles, axis=1)), axis=1)


def _small_ones(halvings: int) -> tuple[Array, Any]:
    """Points (barycentric) and tetrahedra into which halving all edges divides one."""
    tetrahedra = [np.eye(4)]
    for _ in range(halvings):
        finer = []
        for corners in tetrahedra:
            a, b, c, d = corners
            e, f, g, h, i, j = (0.5 * (corners[p] + corners[q]) for p, q in EDGES)
            finer += [
                np.array(four)
                for four in (
                    *((a, e, g, h), (e, b, f, i), (g, f, c, j), (h, i, j, d)),
                    # The octahedron that is left, around the line from g to i.
                    *((g, i, e, f), (g, i, f, j), (g, i, j, h), (g, i, h, e)),
                )
            ]
        tetrahedra = finer
    points, cells = np.unique(np.concatenate(tetrahedra), axis=0, return_inverse=True)
    return points, np.asarray(cells, dtype=np.intp).reshape(-1, 4)


def pieces(grid: Any, fields: dict[str, Array], halvings: int = 2) -> Any:
    """The same body of linear tetrahedra, with fields at its points.

    Positions of the points and vectors are those of the quadratic cells. Numbers are taken
    linear between the nodes, so that none exceeds those at the nodes.
    """
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

    of_cells = nodes(grid)
    local, small = _small_ones(halvings)
    quadratic, linear = shape_functions(local), _linear_weights(local)
    count, many = len(of_cells), len(local)

    def spread(values: Array) -> Array:
        weights = quadratic if values.ndim > 1 else linear
        at_nodes = values.reshape(len(values), -1)[of_cells]
        result = np.einsum("pk,ckd->cpd", weights, at_nodes).reshape(count * many, -1)
        return np.ascontiguousarray(result if values.ndim > 1 else result[:, 0])

    points = vtk.vtkPoints()
    places = np.asarray(vtk_to_numpy(grid.GetPoints().GetData()), dtype=float)
    points.SetData(numpy_to_vtk(spread(places), deep=True))
    cells = (many * np.arange(count)[:, None, None] + small[None]).reshape(-1, 4)
    array = vtk.vtkCellArray()
    array.SetData(4, numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells.ravel()), deep=True))
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(points)
    result.SetCells(vtk.VTK_TETRA, array)
    for name, values in fields.items():
        data = numpy_to_vtk(spread(values), deep=True)
        data.SetName(name)
        result.GetPointData().AddArray(data)
    return result


def with_joined_points(grid: Any) -> Any:
    """The grid with one point for all that agree in position and in the field `moved`."""
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

    places = np.asarray(vtk_to_numpy(grid.GetPoints().GetData()), dtype=float)
    data = grid.GetPointData()
    arrays = {name: vtk_to_numpy(data.GetArray(name)) for name in ("shown", "moved")}
    groups = joined(places, arrays["moved"])
    first = np.unique(groups, return_index=True)[1]
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(places[first], deep=True))
    cells.DeepCopy(grid.GetCells())
    # VTK may keep numbers of small grids with 32 bits, but takes no mixture.
    offsets, connectivity = (
        numpy_to_vtkIdTypeArray(numbers.astype(np.int64), deep=True)
        for numbers in (
            vtk_to_numpy(cells.GetOffsetsArray()),
            groups[vtk_to_numpy(cells.GetConnectivityArray())],
        )
    )
    cells.SetData(offsets, connectivity)
    result = vtk.vtkUnstructuredGrid()
    result.SetPoints(points)
    result.SetCells(grid.GetCellTypesArray(), cells)
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values[first]), deep=True)
        array.SetName(name)
        result.GetPointData().AddArray(array)
    return result


def _linear_weights(local: Array) -> Array:
    """Linear interpolation on the eight tetrahedra of the first halving, (m, 10)."""
    at_nodes: Array = np.array(
        [*np.eye(4), *(0.5 * (np.eye(4)[i] + np.eye(4)[j]) for i, j in EDGES)]
    )
    points, small = _small_ones(1)
    order = np.array([np.abs(at_nodes - point).sum(axis=1).argmin() for point in points])
    weights = np.zeros((len(local), 10))
    for number, point in enumerate(local):
        for corners in order[small]:
            part = np.linalg.solve(at_nodes[corners].T, point)
            if part.min() > -1e-9:
                weights[number, corners] = part
                break
    return weights


def outer_edges(grid: Any, moved: Array, groups: Array, parts: int = 4) -> Any:
    """The edges of the cells on the surface, as curves with the field `moved`.

    `groups` says which points are the same, from `joined`.
    """
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    faces = nodes(grid)[:, FACES].reshape(-1, 6)
    _, first, copies = np.unique(
        np.sort(groups[faces[:, :3]], axis=1), axis=0, return_index=True, return_counts=True
    )
    outer = faces[first[copies == 1]]
    sides = np.concatenate([outer[:, pick] for pick in ((0, 1, 3), (1, 2, 4), (0, 2, 5))])
    _, first = np.unique(np.sort(groups[sides[:, :2]], axis=1), axis=0, return_index=True)
    sides = sides[first]
    t = np.linspace(0, 1, parts + 1)
    weights = np.stack(((1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)), axis=1)
    places = np.asarray(vtk_to_numpy(grid.GetPoints().GetData()), dtype=float)

    def spread(values: Array) -> Any:
        return numpy_to_vtk(
            np.ascontiguousarray(np.einsum("pk,skd->spd", weights, values[sides]).reshape(-1, 3)),
            deep=True,
        )

    points, lines = vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(spread(places))
    for number in range(len(sides)):
        lines.InsertNextCell(parts + 1)
        for k in range(parts + 1):
            lines.InsertCellPoint(number * (parts + 1) + k)
    result = vtk.vtkPolyData()
    result.SetPoints(points)
    result.SetLines(lines)
    data = spread(moved)
    data.SetName("moved")
    result.GetPointData().AddArray(data)
    return result
