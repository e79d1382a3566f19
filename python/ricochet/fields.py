# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields by which bodies can be coloured: numbers at the points of a VTK grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .errors import NotARun
from .names import Named, no_such
from .tables import Array


@dataclass(frozen=True)
class Colour:
    """Something that is shown by colours."""

    #: For the colour bar.
    label: str
    #: The field of the VTU file.
    field: str
    #: Kind of its unit: pressure, length or velocity.
    kind: str


COLOURS = Named(
    "colour",
    {
        "von_mises": Colour("von Mises stress", "von_mises", "pressure"),
        "contact_pressure": Colour("contact pressure", "contact_pressure", "pressure"),
        "displacement": Colour("displacement", "displacement", "length"),
        "velocity": Colour("velocity", "velocity", "velocity"),
        "stress": Colour("largest compressive stress", "stress", "pressure"),
    },
)


#: Numbers of components, of which computations make use.
COMPONENTS = {"displacement": (1, 3), "stress": (1, 9)}


def unit(units: dict[str, str], kind: str) -> str:
    """The unit of a kind of fields, from those of the columns of energy.csv.

    VTU files have no units. Empty if the columns have none.
    """

    def first(*begins: str) -> str:
        for begin in begins:
            for name, text in units.items():
                if name.startswith(begin):
                    return text
        return ""

    length, time = first("smallest_gap_", "penetration_", "displacement_"), first("time")
    if kind == "length":
        return length
    if kind == "velocity":
        return f"{length}/{time}" if length and time else ""
    return first("contact_pressure_", "stress_pressure_")


def array(grid: Any, name: str) -> Array:
    """A field at the points, (n, components).

    Raises:
        NoSuchName: there is no such field.
        NotARun: a displacement or a stress has another number of components than such have.
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy

    data = grid.GetPointData()
    values = data.GetArray(name)
    if values is None:
        names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
        raise no_such("field", name, names)
    result = np.asarray(vtk_to_numpy(values), dtype=float)
    result = result.reshape(len(result), -1)
    if result.shape[1] not in COMPONENTS.get(name, (result.shape[1],)):
        raise NotARun(f"The field '{name}' has {result.shape[1]} components.")
    return result


def dimension(grid: Any) -> int:
    """1 for lines, 2 for a body in 2D, 3 for one in 3D."""
    return int(grid.GetCell(0).GetCellDimension())


def displacements(grid: Any) -> Array:
    """Displacements of the points, (n, 3)."""
    values = array(grid, "displacement")
    return np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def values(grid: Any, colour: str) -> Array:
    """One number for each point.

    The length of displacement and velocity (on a bar the value itself); for the stress, the largest
    compression in any direction, positive.
    """
    data = array(grid, COLOURS[colour].field)
    dim = dimension(grid)
    if colour == "stress":
        if data.shape[1] == 1:
            return -data[:, 0]
        size = int(np.sqrt(data.shape[1]))
        tensors = data.reshape(-1, size, size)[:, :dim, :dim]
        return -np.linalg.eigvalsh(0.5 * (tensors + tensors.transpose(0, 2, 1)))[:, 0]
    if data.shape[1] > 1 and dim > 1:
        return np.asarray(np.linalg.norm(data, axis=1))
    return data[:, 0]


def array_of_points(grid: Any) -> Array:
    """Initial positions of the points, (n, 3)."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    return np.asarray(vtk_to_numpy(grid.GetPoints().GetData()), dtype=float)


def area(grid: Any) -> float:
    """Initial area of all cells of a grid in 2D."""
    import vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy

    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.ComputeLengthOff()
    sizes.ComputeVolumeOff()
    sizes.ComputeVertexCountOff()
    sizes.Update()
    return float(vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Area")).sum())


def joined_points(grid: Any) -> tuple[Any, Any]:
    """The nodes of a grid, whose cells have points of their own: points that are the same in
    different cells of one body are one node.

    Returns:
        for each node one of its points, and for each point the number of its node.
    """
    places = array_of_points(grid)
    size = np.ptp(places, axis=0).max() or 1.0
    keys = np.round(places / (1e-9 * size))
    if grid.GetPointData().GetArray("part") is not None:
        keys = np.column_stack([keys, array(grid, "part")[:, 0]])
    _, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return first, number.reshape(-1)
