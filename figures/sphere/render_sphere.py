#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw a deformed body of a VTU file by VTK: render_sphere.py FILE.vtu FIELD IMAGE.png

Von Mises stress is shown with a quarter cut out, the contact pressure from below.
"""

import sys

import vtk


def main(file, field, image):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    warp = vtk.vtkWarpVector()
    warp.SetInputConnection(reader.GetOutputPort())
    warp.SetInputArrayToProcess(0, 0, 0, 0, "displacement")
    last = warp
    from_below = field == "contact_pressure"
    if not from_below:
        last = vtk.vtkClipDataSet()
        last.SetInputConnection(warp.GetOutputPort())
        box = vtk.vtkBox()
        box.SetBounds(0, 1000, -1000, 0, -1000, 1000)
        last.SetClipFunction(box)
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputConnection(last.GetOutputPort())
    surface.Update()
    surface.GetOutput().GetPointData().SetActiveScalars(field)
    low, high = surface.GetOutput().GetPointData().GetArray(field).GetRange()

    colours = vtk.vtkLookupTable()
    colours.SetHueRange(0.667, 0.0)
    colours.SetTableRange(max(low, 0.0), high)
    colours.Build()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.25)

    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.SetWidth(0.09)
    bar.SetHeight(0.6)
    bar.SetPosition(0.88, 0.2)
    bar.UnconstrainedFontSizeOn()
    bar.GetLabelTextProperty().SetColor(0, 0, 0)
    bar.GetLabelTextProperty().SetFontSize(18)
    bar.GetLabelTextProperty().ShadowOff()
    bar.GetLabelTextProperty().ItalicOff()

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    renderer.AddActor(bar)
    if not from_below:
        # The foundation.
        plane = vtk.vtkPlaneSource()
        plane.SetOrigin(-32, -32, 0)
        plane.SetPoint1(32, -32, 0)
        plane.SetPoint2(-32, 32, 0)
        floor_mapper = vtk.vtkPolyDataMapper()
        floor_mapper.SetInputConnection(plane.GetOutputPort())
        floor = vtk.vtkActor()
        floor.SetMapper(floor_mapper)
        floor.GetProperty().SetColor(0.85, 0.85, 0.85)
        floor.GetProperty().LightingOff()
        renderer.AddActor(floor)

    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 16)
    camera.SetViewUp(0, 0, 1)
    camera.SetPosition(*((60, -75, -75) if from_below else (75, -95, 50)))
    renderer.ResetCameraClippingRange()

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(960, 760)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.Update()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(image)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    main(*sys.argv[1:])
