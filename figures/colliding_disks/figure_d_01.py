# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colliding disks: an oblique collision with friction.

Persistent contact, offset 1 m, mu = 0.2; von Mises stress and the resultants of the contact
forces. Crosses are fixed to the disks, which spin after the collision. Bottom right: energies.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.pictures import (
    bare,
    colour_bar,
    draw_cells,
    save_frames,
    scale_bar,
    snapshot,
    zero_line,
)
from shared.rows import checks_of_runs

from .common import CASES, disks, momenta_row

RUN = disks(
    "D-1",
    "oblique",
    case=CASES[2],
    more=("Time/Final time=0.6",),
    output=("Output/Fields every=2", "Output/Log every=0"),
    cost=5,
)
FRAMES = (0, 30, 60, 100, 150)
STRESS = 60.0  # kPa
ARROW = 8e-6  # m per N


def draw_disks(axes, step, force=True, lines=False):
    """Both disks, with two diameters of each and the force between them."""
    rest, place, cells, fields = snapshot(RUN, step)
    drawn = draw_cells(axes, place, cells, fields["von_mises of cells"] / 1e3, STRESS, lines)
    for number in (0, 1):
        mine = cells[fields["part of cells"] == number]
        points = fields["part"] == number
        local = rest - (rest[points].min(axis=0) + rest[points].max(axis=0)) / 2
        for coordinate in local.T:
            axes.add_collection(
                LineCollection(
                    zero_line(place, mine, coordinate), colors="0.3", linewidths=0.9, zorder=3
                )
            )
        forces = fields["contact_force"][points, :2].astype(float)
        size = np.linalg.norm(forces, axis=1)
        if force and size.sum() > 0:
            foot = size @ place[points] / size.sum()
            axes.annotate(
                "",
                xy=foot + ARROW * forces.sum(axis=0),
                xytext=foot,
                arrowprops={
                    "arrowstyle": "-|>",
                    "color": "#0072B2",
                    "linewidth": 2.0,
                    "shrinkA": 0,
                    "shrinkB": 0,
                },
                zorder=5,
            )
    return drawn


VIEW = ((-2.3, 2.3), (-1.92, 1.92))


def draw():
    figure = plt.figure(figsize=(13, 7.2), layout="constrained")
    grid = figure.add_gridspec(2, 4, width_ratios=(1, 1, 1, 0.03))
    table = RUN.read()
    for k, step in enumerate(FRAMES):
        axes = figure.add_subplot(grid[k // 3, k % 3])
        drawn = draw_disks(axes, step)
        bare(axes, f"{table['time'][step]:.2f} s", *VIEW)
        if k == 0:
            scale_bar(axes, -2.15, -1.8, 0.5)
    colour_bar(drawn, figure.add_subplot(grid[0, 3]), "vertical")
    axes = figure.add_subplot(grid[1, 2])
    first = table["energy"][0]
    total = table["energy"] + table["friction_work"]
    for values, colour, text in (
        (total, "black", "energy and work of friction"),
        (table["energy"], "#D55E00", "energy"),
        (table["kinetic_energy"], "#0072B2", "kinetic"),
        (table["elastic_energy"], "#009E73", "elastic"),
        (table["friction_work"], "#CC79A7", "work of friction"),
    ):
        axes.plot(table["time"], values / first, color=colour, label=text)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("over the energy at the start")
    axes.set_xlim(0, table["time"][-1])
    axes.set_ylim(-0.03, 1.08)
    axes.legend(fontsize=8, loc="center right")
    return figure


def animate(path):
    time = RUN.read()["time"]
    figure, axes = plt.subplots(figsize=(5.2, 4.4), layout="constrained")

    def draw(step):
        axes.clear()
        draw_disks(axes, step, lines=True)
        bare(axes, f"two disks with friction, {time[step]:.2f} s", *VIEW)

    save_frames(path, figure, draw, list(range(0, 151, 4)), speed=10)


def checks():
    table = RUN.read()
    total = (table["energy"] + table["friction_work"]) / table["energy"][0]
    worst = np.abs(total - 1).max()
    rise = np.diff(table["energy"]).max() / table["energy"][0]
    mass = table["momentum_x_left"][0]
    errors = []
    for step in FRAMES:
        force = snapshot(RUN, step)[3]["contact_force"][:, :2].astype(float)
        errors.append(np.abs(force.sum(axis=0)).max() / max(np.abs(force).sum() / 2, 1))
    return [
        check(
            "max change of energy and work of friction",
            f"{worst:.1e}",
            worst < 1e-9,
            "< 1e-9 of the energy: nothing else dissipates",
            exact="0",
        ),
        check(
            "largest rise of the energy in a step",
            f"{rise:.1e}",
            rise <= 1e-12,
            "at most 1e-12 of the energy",
            exact="<= 0",
        ),
        compare("own.oblique.friction", table["friction_work"][-1] / table["energy"][0]),
        momenta_row([RUN], mass),
        check(
            "sum of the contact forces on both disks in the pictures, relative",
            f"{max(errors):.1e}",
            max(errors) < 1e-5,
            "< 1e-5: fields have single precision",
            exact="0",
        ),
    ] + checks_of_runs([RUN])


FIGURE = Figure("D-1", __doc__, [RUN], draw, checks, animate=animate)
