# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of a run in 2D: triangles with fields at their vertices.

A quadrilateral is split into two triangles. Each cell has vertices of its own in a VTU file;
`read` joins coincident ones, so that a sum over nodes counts each of them once.
"""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from ricochet.fields import array, array_of_points
from ricochet.results import read_fields


def read(path):
    """Vertices (n, 2), triangles (m, 3) and a dictionary of fields: (n,) or (n, components)."""
    grid = read_fields(path)
    points = vtk_to_numpy(grid.GetPoints().GetData())[:, :2].astype(float)
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    cells = cells.reshape(grid.GetNumberOfCells(), -1)
    if cells.shape[1] == 4:
        cells = np.concatenate((cells[:, (0, 1, 2)], cells[:, (0, 2, 3)]))
    data = grid.GetPointData()
    arrays = {
        data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
        for i in range(data.GetNumberOfArrays())
    }

    # Coincident points have bitwise the same coordinates, except for the last digit of some: a
    # millionth of the largest coordinate joins them.
    key = np.round(points / (1e-6 * np.abs(points).max())).astype(np.int64)
    _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    fields = {name: values[first] for name, values in arrays.items()}
    # An element-wise constant field has a value per cell here; keep those too.
    fields.update({f"{name} of cells": values[cells[:, 0]] for name, values in arrays.items()})
    return points[first], inverse.reshape(-1)[cells], fields


def read_bar(path):
    """A bar: its nodes, their displacements and velocities, and the stress of each cell."""
    grid = read_fields(path)
    x = array_of_points(grid)[:, 0]
    order = np.argsort(x[::2], kind="stable")

    def at_nodes(values):
        # Each cell has its two ends.
        return np.append(values[::2][order], values[1::2][order][-1])

    displacement, velocity = (array(grid, name)[:, 0] for name in ("displacement", "velocity"))
    stress = array(grid, "stress")[::2, 0][order]
    return at_nodes(x), at_nodes(displacement), at_nodes(velocity), stress
