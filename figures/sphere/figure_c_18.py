# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: stress and contact pressure.

The deformed spheres, with Nitsche's method and HHT (alpha = 0.05): the soft one at t = 16 s, the
hard one at 6.8 s. Left: von Mises stress on a cut through the middle. Right: contact pressure, seen
from below. Both pictures of a sphere have the same scale of colours. The soft sphere lies on a
third of its width, the hard one touches with a few elements, which are shown enlarged.
"""

import matplotlib.pyplot as plt
import numpy as np

from ricochet import pictures
from shared.figure import Figure
from shared.paper_numbers import compare

from .common import HARD, SPHERES

COLUMNS = (("von_mises", "von Mises stress"), ("contact_pressure", "contact pressure"))
LIMITS = {"soft": (0, 25), "hard": (0, 6000)}  # Pa
# In the pictures of the hard sphere, whose middle is that of its panel.
TOUCHED = {"von_mises": (0.0, -16.0), "contact_pressure": (0.0, -16.4)}  # m


def enlarge(panel, place, centre, half):
    """A part of the picture in `panel`, about `centre`, in axes at `place` of it."""
    picture = panel.images[0]
    part = panel.inset_axes(place)
    part.imshow(picture.get_array(), extent=picture.get_extent(), interpolation="antialiased")
    part.set(
        xlim=(centre[0] - half, centre[0] + half),
        ylim=(centre[1] - half, centre[1] + half),
        xticks=[],
        yticks=[],
    )
    part.grid(False)
    panel.indicate_inset_zoom(part, edgecolor="0.3", alpha=1)


def draw():
    figure, axes = plt.subplots(2, 2, figsize=(7, 7), layout="constrained")
    for row, sphere in zip(axes, SPHERES):
        run = sphere.runs["nitsche_hht"].results
        for panel, (field, label) in zip(row, COLUMNS):
            shown = pictures.show(
                panel, run, sphere.picture, field, LIMITS[sphere.name], pixels=1800, obstacles=False
            )
            if sphere is HARD:
                enlarge(panel, (0.27, 0.42, 0.46, 0.46), TOUCHED[field], 4.5)
            panel.set_title(f"{sphere.name}, t = {sphere.picture:g} s\n{label}")
        shown.colour_bar(row, shrink=0.8).set_label("Pa")
    return figure


def checks():
    rows, active = [], []
    for sphere in SPHERES:
        table = sphere.runs["nitsche_hht"].read()
        k = np.abs(table["time"] - sphere.picture).argmin()
        active.append(table["active_points_foundation"][k])
        force = table["contact_force_foundation"][k]
        rows.append(compare(f"own.sphere_pictures.force_{sphere.name}", force))
    return [*rows, compare("C.figure_18.surface", active[0] / active[1])]


FIGURE = Figure("C-18", __doc__, [sphere.runs["nitsche_hht"] for sphere in SPHERES], draw, checks)
