# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens a run in ParaView: deformed bodies, coloured by von Mises stress, and rigid
obstacles.

    RICOCHET_RUN=output/elastic_ball/default paraview --script=python/paraview_open.py
    pvpython python/paraview_open.py output/elastic_ball/default picture.png

In the first form the run is named by an environment variable, since ParaView hands no arguments
to a script; without it the working folder is taken. Instead, in ParaView: Tools, Python Shell,
Run Script, and open solution.pvd beforehand. The second form writes a picture of the last step.
"""

import os
import sys

from paraview import simple

folder = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("RICOCHET_RUN", ".")

bodies = simple.GetActiveSource()
if bodies is None:
    file = os.path.join(os.path.abspath(folder), "solution.pvd")
    if not os.path.isfile(file):
        sys.exit(f"There is no '{file}': name the folder of a run by RICOCHET_RUN.")
    bodies = simple.PVDReader(FileName=file)
bodies.UpdatePipeline()

# The scene has the times of the files; at the first one nothing is deformed yet.
scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()

moved = simple.WarpByVector(Input=bodies)
moved.Vectors = ["POINTS", "displacement"]

view = simple.GetActiveViewOrCreate("RenderView")
simple.Hide(bodies, view)
shown = simple.Show(moved, view)
shown.SetRepresentationType("Surface With Edges")
shown.EdgeColor = [0.3, 0.3, 0.3]
simple.ColorBy(shown, ("POINTS", "von_mises"))
simple.GetColorTransferFunction("von_mises").ApplyPreset("Viridis (matplotlib)", True)
# The same colours at all times.
shown.RescaleTransferFunctionToDataRangeOverTime()
shown.SetScalarBarVisibility(view, True)

obstacles = os.path.join(os.path.dirname(str(bodies.FileName)), "obstacles.pvd")
low, high = bodies.GetDataInformation().GetBounds()[4:6]
if high > low:
    # In 3D: from the side and above, with z up.
    view.CameraPosition, view.CameraViewUp = [1.0, -2.5, 1.0], [0.0, 0.0, 1.0]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
simple.ResetCamera(view)
if os.path.isfile(obstacles):
    surfaces = simple.PVDReader(FileName=obstacles)
    look = simple.Show(surfaces, view)
    look.ColorArrayName = ["POINTS", ""]
    look.DiffuseColor = look.AmbientColor = [0.7, 0.7, 0.7]
    look.Opacity = 0.5
    look.LineWidth = 3.0
simple.Render(view)
if len(sys.argv) > 2:
    simple.SaveScreenshot(sys.argv[2], view, ImageResolution=[1200, 900])
