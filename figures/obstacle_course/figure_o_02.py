# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacle course: a disk in a bowl.

A soft disk without friction in a bowl of 2 m. Left: three instants, with von Mises stress and the
resultant of the contact force. Right: its middle, beside a pendulum, and how far energy less the
work of the weight moves from zero. For improved normal compliance the energy counts the contact
potential.
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.pictures import colour_bar, scale_bar
from shared.rows import checks_of_runs

from .bowl import BOWL, BOWLS, START, draw_in_bowl
from .common import G, RADIUS


def change(key):
    """Energy less the work of the weight, over the largest kinetic energy."""
    one, column, *_ = BOWLS[key]
    table = one.read()
    return (table[column] - table["external_work"]) / table["kinetic_energy"].max()


def pendulum(time):
    """The displacement along x (m) of a rigid disk that slides without friction: a pendulum."""
    length = BOWL - RADIUS
    angle, rate = np.arctan2(START[0], -START[1]), 0.0
    values = []
    h = time[1] - time[0]
    for _ in time:
        values.append(length * np.sin(angle))
        # Velocity Verlet, with a tenth of the step.
        for _ in range(10):
            rate -= h / 20 * G / length * np.sin(angle)
            angle += h / 10 * rate
            rate -= h / 20 * G / length * np.sin(angle)
    return np.array(values)


def turn(time, values):
    """When a motion to the right turns back, between two steps (s)."""
    rate = np.diff(values)
    first = np.flatnonzero((rate[:-1] > 0) & (rate[1:] <= 0) & (values[1:-1] > 0))[0]
    part = rate[first] / (rate[first] - rate[first + 1])
    return time[first] + (part + 0.5) * (time[1] - time[0])


def path(one):
    table = one.read()
    return START[0] + table["centre_displacement_x"], START[1] + table["centre_displacement_y"]


def draw():
    figure = plt.figure(figsize=(13, 5.0), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1.5, 1))
    picture = figure.add_subplot(grid[:, 0])
    drawn = draw_in_bowl(picture, "persistent contact, three instants")
    scale_bar(picture, -2.1, -2.15, 0.5)
    # There is room for the colours in the bowl.
    colour_bar(drawn, picture.inset_axes((-0.8, 0.05, 1.6, 0.09), transform=picture.transData))

    upper, lower = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
    for key, (one, _, text, colour, style) in BOWLS.items():
        time = one.read()["time"]
        upper.plot(time, path(one)[0], color=colour, linestyle=style, label=text)
        # A double has no smaller changes; zeros have no logarithm.
        values = np.maximum(np.abs(change(key)), 1e-17)
        lower.semilogy(time[1:], values[1:], color=colour, linewidth=1, label=text)
    upper.plot(time, pendulum(time), color="0.6", linewidth=3, zorder=1, label="pendulum of 1.5 m")
    upper.set_ylabel("middle, $x_1$ (m)")
    upper.legend(fontsize=8, loc="lower center")
    lower.set_ylabel("|change of energy|\nover kinetic energy")
    lower.set_xlabel("time (s)")
    lower.legend(fontsize=8, loc="center right")
    for panel in (upper, lower):
        panel.set_xlim(0, time[-1])
    upper.tick_params(labelbottom=False)
    return figure


def checks():
    rows = []
    for key in ("persistent", "inc"):
        worst = np.abs(change(key)).max()
        what = "energy" if key == "persistent" else "energy and contact potential"
        rows.append(
            check(
                f"{BOWLS[key][2]}: max change of {what} less the work of the weight",
                f"{worst:.1e}",
                worst < 1e-9,
                "< 1e-9 of the kinetic energy: Newton's tolerance, summed over the steps",
                exact="0",
            )
        )
    signorini = change("signorini")
    rise = np.diff(signorini).max()
    rows.append(
        check(
            f"{BOWLS['signorini'][2]}: largest rise of it in a step",
            f"{rise:.1e}",
            rise <= 1e-12,
            "at most 1e-12 of the kinetic energy: round-off",
            exact="<= 0",
        )
    )
    rows.append(compare("own.bowl.signorini", -signorini[-1]))
    for one, _, text, *_ in BOWLS.values():
        time = one.read()["time"]
        ours, exact = turn(time, path(one)[0]), turn(time, pendulum(time))
        rows.append(
            check(
                f"{text}: when the disk turns back (s), and the pendulum",
                f"{ours:.3f}",
                abs(ours / exact - 1) < 0.05,
                "within 5 %: the disk is soft and bounces",
                exact=f"{exact:.3f}",
            )
        )
    return rows + checks_of_runs([one for one, *_ in BOWLS.values()])


FIGURE = Figure("O-2", __doc__, [one for one, *_ in BOWLS.values()], draw, checks)
