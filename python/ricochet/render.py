# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws deformed bodies by VTK, without a window: `python3 -m ricochet.render JOB.json`.

This is a process of its own, since Debian's VTK draws on an X server (a virtual one will do),
and ends the process if there is none. `pictures` writes the job and uses the images.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from . import curved, fields
from .results import read_fields


@dataclass(frozen=True)
class View:
    """A parallel projection: centre, direction and pixels.

    The picture is a rectangle in the plane of `right` and `up`, about `centre`; one pixel is
    `height / pixels[1]` long.
    """

    centre: tuple[float, float, float]
    right: tuple[float, float, float]
    up: tuple[float, float, float]
    width: float
    height: float
    #: Size of the body, to stand far enough away from it.
    size: float
    pixels: tuple[int, int]


@dataclass(frozen=True)
class Job:
    """Pictures that share view and colours."""

    #: VTU files of bodies and, if there are any, obstacles, and the PNG files to make of them.
    frames: list[tuple[str, str | None, str]]
    colour: str
    limits: tuple[float, float]
    #: Red, green and blue (0 to 1) from the lowest to the highest value.
    palette: list[tuple[float, float, float]]
    view: View
    edges: bool
    #: Parts in front of the plane y = cut (at the start) are left away.
    cut: float | None
    #: In 3D, lower and upper bound of each coordinate within which obstacles are shown.
    box: tuple[tuple[float, float], ...] | None

    def to_json(self) -> str:
        """As `read_job` reads it."""
        return json.dumps(asdict(self))


def read_job(path: str) -> Job:
    """A job from its file."""
    with open(path, encoding="utf-8") as file:
        job: dict[str, Any] = json.load(file)
    job["view"] = View(**job["view"])
    return Job(**job)


def _strips(curves: Any, depth: float) -> Any:
    """Quadrilaterals behind curves in 2D, `depth` wide, on the side away from the normal."""
    import vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy

    count = curves.GetNumberOfCells()
    lines = vtk_to_numpy(curves.GetCells().GetConnectivityArray()).reshape(count, 2)
    places = vtk_to_numpy(curves.GetPoints().GetData())
    behind = places - depth * vtk_to_numpy(curves.GetPointData().GetArray("normal"))
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    for first, second in lines:
        cells.InsertNextCell(4)
        for x, y, _ in (places[first], places[second], behind[second], behind[first]):
            # Behind the bodies.
            cells.InsertCellPoint(points.InsertNextPoint(x, y, -0.01 * depth))
    strips = vtk.vtkPolyData()
    strips.SetPoints(points)
    strips.SetPolys(cells)
    return strips


def _show_obstacles(actor: Any, grid: Any, dim: int, job: Job) -> None:
    """Have `actor` show obstacles: in 2D as strips, in 3D as surfaces within a box."""
    import vtk

    if not grid.GetNumberOfCells() or (dim == 3 and job.box is None):
        return
    mapper = vtk.vtkPolyDataMapper()
    mapper.ScalarVisibilityOff()
    look = actor.GetProperty()
    if dim == 2:
        mapper.SetInputData(_strips(grid, 0.03 * job.view.size))
        look.SetColor(0.6, 0.6, 0.6)
        look.LightingOff()
    else:
        surface = vtk.vtkDataSetSurfaceFilter()
        surface.SetInputData(grid)
        surface.Update()
        last: Any = surface.GetOutput()
        for axis, bounds in enumerate(job.box or ()):
            for bound, sign in zip(bounds, (1.0, -1.0)):
                plane, normal = vtk.vtkPlane(), [0.0, 0.0, 0.0]
                normal[axis] = sign
                plane.SetNormal(*normal)
                plane.SetOrigin(*(bound if c == axis else 0.0 for c in range(3)))
                clip = vtk.vtkClipPolyData()
                clip.SetInputData(last)
                clip.SetClipFunction(plane)
                clip.Update()
                last = clip.GetOutput()
        mapper.SetInputData(last)
        look.SetColor(0.8, 0.8, 0.8)
        look.SetOpacity(0.45)
        look.SetAmbient(0.7)
        look.SetDiffuse(0.3)
    actor.SetMapper(mapper)
    actor.SetVisibility(True)


def _clipped(data: Any, clip: Any, cut: float | None) -> Any:
    """Parts behind the plane y = cut, by a filter that clips."""
    import vtk

    if cut is None:
        return data
    plane = vtk.vtkPlane()
    plane.SetOrigin(0, cut, 0)
    plane.SetNormal(0, 1, 0)
    clip.SetInputData(data)
    clip.SetClipFunction(plane)
    clip.Update()
    return clip.GetOutput()


def _warped(data: Any) -> Any:
    """A grid whose points are moved by the field `moved`."""
    import vtk

    warp = vtk.vtkWarpVector()
    warp.SetInputData(data)
    warp.SetInputArrayToProcess(0, 0, 0, 0, "moved")
    warp.Update()
    return warp.GetOutput()


def _surface(grid: Any, job: Job, lines: Any) -> Any:
    """The surface to be seen, with the field `shown`; `lines` becomes the edges of curved cells.

    In 3D the field is the mean of the cells around a point, and the light that of a smooth
    surface.
    """
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk

    shown, moved = fields.values(grid, job.colour), fields.displacements(grid)
    in_space = fields.dimension(grid) == 3
    if in_space:
        groups = curved.joined(fields.array_of_points(grid), moved)
        shown = curved.averaged(shown, groups)
    lines.SetVisibility(False)
    if in_space and curved.is_quadratic(grid):
        body = curved.pieces(grid, {"shown": shown, "moved": moved})
        if job.edges:
            edges = curved.outer_edges(grid, moved, groups)
            mapper = vtk.vtkPolyDataMapper()
            mapper.SetInputData(_warped(_clipped(edges, vtk.vtkClipPolyData(), job.cut)))
            mapper.ScalarVisibilityOff()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0, -4)
            lines.SetMapper(mapper)
            lines.SetVisibility(True)
    else:
        body = grid
        for name, values in (("shown", shown), ("moved", moved)):
            data = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
            data.SetName(name)
            body.GetPointData().AddArray(data)
    surface = vtk.vtkDataSetSurfaceFilter()
    if not in_space:
        surface.SetInputData(_warped(body))
        surface.SetNonlinearSubdivisionLevel(2)
        surface.Update()
        return surface.GetOutput()
    # Faces between cells cancel where their points are the same.
    body = curved.with_joined_points(body)
    surface.SetInputData(_warped(_clipped(body, vtk.vtkClipDataSet(), job.cut)))
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(surface.GetOutputPort())
    normals.SetFeatureAngle(40)
    normals.Update()
    return normals.GetOutput()


def render(job: Job) -> None:
    """Draw all frames of a job."""
    import vtk

    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(job.palette))
    for number, colour in enumerate(job.palette):
        table.SetTableValue(number, *colour, 1.0)
    table.SetTableRange(*job.limits)

    mapper = vtk.vtkPolyDataMapper()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("shown")
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    # Between nodes values are interpolated, not colours.
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    lines = vtk.vtkActor()
    renderer.AddActor(lines)
    for edges, thick in ((look, 0.6), (lines.GetProperty(), 1.0)):
        edges.SetEdgeColor(0.35, 0.35, 0.35)
        edges.SetColor(0.35, 0.35, 0.35)
        edges.SetLineWidth(thick)
    lines.GetProperty().LightingOff()

    view = job.view
    towards = np.cross(view.right, view.up)  # from the body to the eye
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*view.centre)
    camera.SetPosition(*(np.array(view.centre) + 4 * view.size * towards))
    camera.SetViewUp(*view.up)
    camera.SetParallelScale(0.5 * view.height)

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*view.pixels)
    window.AddRenderer(renderer)
    obstacle = vtk.vtkActor()
    renderer.AddActor(obstacle)
    for source, obstacles, image in job.frames:
        grid = read_fields(source)
        look.SetEdgeVisibility(job.edges and not curved.is_quadratic(grid))
        if fields.dimension(grid) == 2:
            look.LightingOff()
        else:
            look.SetAmbient(0.5)
            look.SetDiffuse(0.55)
        mapper.SetInputData(_surface(grid, job, lines))

        obstacle.SetVisibility(False)
        if obstacles:
            _show_obstacles(obstacle, read_fields(obstacles), fields.dimension(grid), job)

        renderer.ResetCameraClippingRange()
        window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.Update()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(image)
        writer.SetInputConnection(grab.GetOutputPort())
        writer.Write()


if __name__ == "__main__":
    render(read_job(sys.argv[1]))
