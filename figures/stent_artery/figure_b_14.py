# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stent and artery: deformed meshes.

Persistent contact without friction and viscosity, 50 steps; von Mises stress. At the end the
stent lies against the wall nearly along its whole length.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.pictures import bare, colour_bar, save_frames, scale_bar, snapshot

from .common import DEPLOYMENT, STENTS, STEPS, ledger_rows
from .drawing import STRESS, WHOLE, draw_mesh


def draw():
    figure = plt.figure(figsize=(12, 9.6), layout="constrained")
    grid = figure.add_gridspec(len(STEPS) + 2, 1, height_ratios=(*[1] * len(STEPS), 3.07, 0.08))
    time = DEPLOYMENT.read()["time"]
    for row, step in enumerate(STEPS):
        axes = figure.add_subplot(grid[row])
        drawn = draw_mesh(axes, step, coloured=True)
        bare(axes, f"{time[step]:.1f} s", *WHOLE)
    axes = figure.add_subplot(grid[len(STEPS)])
    draw_mesh(axes, STEPS[-1], coloured=True)
    bare(axes, f"{time[STEPS[-1]]:.1f} s, a part of it", (8.6, 13.2), (-0.2, 1.03))
    scale_bar(axes, 8.7, -0.15, 0.5, "mm")
    colour_bar(drawn, figure.add_subplot(grid[-1]), unit="MPa")
    return figure


def animate(path):
    table = DEPLOYMENT.read()
    figure = plt.figure(figsize=(10, 4.1), layout="constrained")
    grid = figure.add_gridspec(2, 2, height_ratios=(1, 2.4), width_ratios=(2.6, 1))
    whole, part = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, 0])
    curves = figure.add_subplot(grid[1, 1])
    energy = table["energy"]
    figure.get_layout_engine().set(w_pad=0.05, h_pad=0.02)

    def draw(step):
        for axes in (whole, part, curves):
            axes.clear()
        draw_mesh(whole, step, coloured=True, lines=False)
        bare(whole, f"stent and artery, {table['time'][step]:.2f} s", *WHOLE)
        draw_mesh(part, step, coloured=True)
        title = f"a part of it; von Mises stress, 0 to {STRESS:g} MPa"
        bare(part, title, (8.0, 12.4), (-0.62, 1.03))
        curves.plot(table["time"], table["imposed_work"], color="0.8", linewidth=4)
        curves.plot(table["time"][: step + 1], energy[: step + 1], color="#0072B2", linewidth=1.5)
        curves.set_title("energy (mJ) = work of the stent (grey)", fontsize=9)
        curves.set_xlabel("time (s)", fontsize=8)
        curves.tick_params(labelsize=8)
        curves.set_xlim(0, 1)
        curves.set_ylim(0, 1.1 * energy.max())

    save_frames(path, figure, draw, list(range(0, 51, 2)), speed=8)


def checks():
    step = STEPS[-1]
    rest, place, _, fields = snapshot(DEPLOYMENT, step)
    wall = fields["part"] == 0
    force = fields["contact_force"][:, :2].astype(float)
    error = np.abs(force.sum(axis=0)).max() / np.abs(force[wall]).sum()
    # Nodes of the inner side that have the stent below them, also after it has moved.
    inner = wall & (np.abs(rest[:, 1]) < 1e-6)
    before = inner & (place[:, 0] > place[~wall, 0].min()) & (place[:, 0] < place[~wall, 0].max())
    touching = before & (np.linalg.norm(force, axis=1) > 0)
    deepest = max(one.read()["penetration_wall"].max() for one in (DEPLOYMENT, *STENTS.values()))
    return [
        compare("B.figure_14.adheres", touching.sum() / before.sum()),
        compare("B.figure_14.deepest", deepest),
        compare("B.figure_14.force", force[wall, 1].sum()),
        check(
            "sum of the contact forces on both bodies, over that on the wall",
            f"{error:.1e}",
            error < 1e-5,
            "< 1e-5: fields have single precision",
            exact="0",
        ),
    ] + ledger_rows([DEPLOYMENT])


FIGURE = Figure("B-14", __doc__, [DEPLOYMENT, *STENTS.values()], draw, checks, animate=animate)
