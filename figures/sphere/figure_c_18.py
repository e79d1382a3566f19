# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphere: stress and contact pressure.

Deformed, with Nitsche's method and HHT (alpha = 0.05): the soft sphere at t = 16 s, the hard one
at 6.8 s. A quarter is cut out above; below, the sphere is seen from below.
"""

import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

from ricochet.screen import run_with_screen
from shared.figure import Figure, check, info
from shared.runs import OUTPUT

from .common import SPHERES


def picture(sphere, field):
    """An image of the deformed sphere, coloured by a field, drawn by VTK."""
    step = round(sphere.picture / sphere.time_step)
    file = sphere.runs["nitsche_hht"].field_file(step)
    target = OUTPUT / "figures" / f"C-18_{sphere.name}_{field}.png"
    script = pathlib.Path(__file__).with_name("render_sphere.py")
    run_with_screen([sys.executable, str(script), str(file), field, str(target)])
    return plt.imread(target)


def draw():
    figure, axes = plt.subplots(2, 2, figsize=(12, 9.6))
    for column, sphere in enumerate(SPHERES):
        for row, (field, label) in enumerate(
            (
                ("von_mises", "von Mises stress"),
                ("contact_pressure", "contact pressure, from below"),
            )
        ):
            axes[row, column].imshow(picture(sphere, field))
            axes[row, column].axis("off")
            axes[row, column].set_title(f"{sphere.name}, t = {sphere.picture:g} s: {label} (Pa)")
    figure.tight_layout()
    return figure


def checks():
    rows, active = [], []
    for sphere in SPHERES:
        table = sphere.runs["nitsche_hht"].read()
        k = np.abs(table["time"] - sphere.picture).argmin()
        active.append(table["active_points_foundation"][k])
        rows.append(
            info(
                f"{sphere.name}, t = {sphere.picture:g} s: contact force (N), active points",
                f"{table['contact_force_foundation'][k]:.4g}, " f"{active[-1]:.0f}",
            )
        )
    rows.append(
        check(
            "active contact points, soft over hard",
            f"{active[0] / active[1]:.3g}",
            active[0] > 10 * active[1],
            "more than 10",
            paper="contact surface more limited for the hard sphere",
        )
    )
    return rows


FIGURE = Figure("C-18", __doc__, [sphere.runs["nitsche_hht"] for sphere in SPHERES], draw, checks)
