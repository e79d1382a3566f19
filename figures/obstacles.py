# SPDX-License-Identifier: LGPL-2.1-or-later
"""The obstacle course: bodies on an incline, in a bowl, on a plate and in a drum.

No paper has these; what they are compared with are formulas by hand, conservation, and
work that is known in two ways.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Annulus, Polygon

import vtu
from paper_ab_common import checks_of_runs
from report import Figure, check, info
from runs import QUIET, Run

G = 9.81  # m/s^2
DENSITY = 1000.0  # kg/m^3
RADIUS = 0.5  # m, of all disks

# Stress is shown up to here, in disks; just above the contact there may be more.
STRESS = 40.0  # kPa
ARROW = 3e-5  # m per N, of forces

FORCE = "#E31A1C"
GROUND = {"facecolor": "0.86", "edgecolor": "0.25", "linewidth": 1.2}


def run(figure, key, file, overrides=(), cost=2.0):
    return Run(
        figure,
        key,
        "obstacle_course",
        f"obstacle_course/{file}.prm",
        ("Output/Log every=0", *overrides),
        cost=cost,
    )


def disk_mass(n_boundary_nodes):
    """Mass (kg) of the polygon that stands for a disk."""
    n = n_boundary_nodes
    return DENSITY * n / 2 * RADIUS**2 * np.sin(2 * np.pi / n)


# Drawing --------------------------------------------------------------------


def snapshot(one, step):
    """Points at rest and now (m), triangles and fields at a step."""
    points, cells, fields = vtu.read(one.folder / "solution" / f"step-{step:06}.vtu")
    return points, points + fields["displacement"][:, :2], cells, fields


def outline(cells):
    """The sides of triangles that have no neighbour: pairs of points."""
    sides = np.sort(np.concatenate((cells[:, :2], cells[:, 1:], cells[:, ::2])), axis=1)
    sides, count = np.unique(sides, axis=0, return_counts=True)
    return sides[count == 1]


def zero_line(place, cells, values):
    """Where a linear function on triangles is zero: a piece of a line in each.

    (tricontour never comes back from values that are zero in a vertex.)
    """
    positive = values[cells] >= 0
    # The vertex that stands alone on its side, and the two others.
    alone = positive != np.roll(positive, 1, axis=1)
    alone &= positive != np.roll(positive, -1, axis=1)
    crossed = np.flatnonzero(alone.any(axis=1))
    first = alone[crossed].argmax(axis=1)
    ends = []
    for k in (1, 2):
        a, b = cells[crossed, first], cells[crossed, (first + k) % 3]
        part = (values[a] / (values[a] - values[b]))[:, None]
        ends.append((1 - part) * place[a] + part * place[b])
    return np.stack(ends, axis=1)


def draw_body(axes, one, step, ghost=False, cross=True, limit=STRESS):
    """A body with its von Mises stress and the resultant of the contact force.

    The cross is made of points that were on two diameters at the start, and the dot was
    above the middle, so that they show how far the body has turned. A ghost is an outline
    only. Returns what maps colours, and the middle of the body.
    """
    rest, place, cells, fields = snapshot(one, step)
    x, y = place.T
    middle = (place.min(axis=0) + place.max(axis=0)) / 2
    colour = "0.55" if ghost else "black"
    drawn = None
    if not ghost:
        stress = fields["von_mises"].reshape(-1) / 1e3
        # Images, not thousands of triangles; the colours run from point to point.
        drawn = axes.tripcolor(
            x, y, cells, stress, shading="gouraud", cmap="viridis", vmin=0, vmax=limit, zorder=2
        )
    axes.add_collection(
        LineCollection(place[outline(cells)], colors=colour, linewidths=0.9, zorder=3)
    )
    if cross:
        local = rest - (rest.min(axis=0) + rest.max(axis=0)) / 2
        for coordinate in local.T:
            axes.add_collection(
                LineCollection(
                    zero_line(place, cells, coordinate),
                    colors=colour if ghost else "white",
                    linewidths=0.9,
                    zorder=3,
                )
            )
        dot = place[np.linalg.norm(local - (0, RADIUS / 2), axis=1).argmin()]
        axes.plot(*dot, "o", color=colour if ghost else "white", markersize=4, zorder=3)
    forces = fields["contact_force"][:, :2].astype(float)
    size = np.linalg.norm(forces, axis=1)
    if not ghost and size.sum() > 0:
        foot = size @ place / size.sum()
        axes.annotate(
            "",
            xy=foot + ARROW * forces.sum(axis=0),
            xytext=foot,
            arrowprops={
                "arrowstyle": "-|>",
                "color": FORCE,
                "linewidth": 2.0,
                "shrinkA": 0,
                "shrinkB": 0,
            },
            zorder=5,
        )
    return drawn, middle


def bare(axes, title, x, y):
    """A panel for a picture: a scale of lengths is in it, not around it."""
    axes.set_aspect("equal")
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)
    axes.set_title(title)


def scale_bar(axes, x, y, length, unit="m"):
    """A line of some length that says how long it is."""
    axes.plot([x, x + length], [y, y], color="black", linewidth=2, solid_capstyle="butt", zorder=6)
    axes.annotate(
        f"{length:g} {unit}",
        (x + length / 2, y),
        xytext=(0, 3),
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize=8,
        zorder=6,
    )


def label(axes, place, text):
    axes.text(*place, text, ha="center", va="center", fontsize=8, zorder=6)


def colour_bar(drawn, axes, orientation="horizontal", unit="kPa"):
    """The scale of the stress, in axes of its own."""
    limit = drawn.get_clim()[1]
    bar = axes.figure.colorbar(
        drawn,
        cax=axes,
        extend="max",
        orientation=orientation,
        ticks=np.linspace(0, limit, 5),
        format="%g",
    )
    bar.set_label(f"von Mises stress ({unit})", fontsize=9)
    bar.ax.tick_params(labelsize=8)


# The incline ----------------------------------------------------------------

# tan(beta) = 1/2
COS, SIN = 2 / np.sqrt(5), 1 / np.sqrt(5)
INCLINE_NODES = 256  # of the disks
BLOCK_STRESS = 8.0  # kPa, the largest shown in a block

# Pictures at the start and at the end, after so many steps, are enough.
LAST = {"block_slides": 200, "block_sticks": 200, "disk_rolls": 60, "disk_slips": 60}
INCLINE = {
    key: run("O-1", key, key, (f"Output/Fields every={last}",), 70 if "disk" in key else 6)
    for key, last in LAST.items()
}
FRICTION = {"block_slides": 0.49, "block_sticks": 0.51, "disk_rolls": 0.18, "disk_slips": 0.15}
COLOUR = {
    "block_slides": "#D55E00",
    "block_sticks": "#0072B2",
    "disk_rolls": "#009E73",
    "disk_slips": "#CC79A7",
}
NAME = {key: key.replace("_", " ") for key in INCLINE}


def by_hand(key):
    """The acceleration (m/s^2) down the slope, and its formula."""
    if key == "block_sticks":
        return 0.0, "0"
    if key == "disk_rolls":
        return 2 / 3 * G * SIN, r"$\frac{2}{3}\,g \sin\beta$"
    return G * (SIN - FRICTION[key] * COS), r"$g\,(\sin\beta - \mu \cos\beta)$"


def mass(key):
    return 1.0 * 0.5 * DENSITY if key.startswith("block") else disk_mass(INCLINE_NODES)


def motion(key):
    """Times (s), velocity of the centre down the slope and of a disk's rolling (m/s).

    One of each for a step, the mean of those at both ends: a body that has landed still
    shivers from step to step. The velocity of rolling is spin times radius.
    """
    table = INCLINE[key].read()
    px, py = table["momentum_x"], table["momentum_y"]
    x = RADIUS * SIN + table["centre_displacement_x"]
    y = RADIUS * COS + table["centre_displacement_y"]
    spin = (x * py - y * px - table["angular_momentum"]) / (0.5 * mass(key) * RADIUS**2)
    values = (table["time"], (COS * px - SIN * py) / mass(key), RADIUS * spin)
    return tuple((v[1:] + v[:-1]) / 2 for v in values)


def late(key):
    """Which steps count for an acceleration: not those of the landing."""
    time = motion(key)[0]
    return time >= time[-1] / 3


def accelerations(key):
    """Slopes of lines through the two velocities (m/s^2)."""
    time, *velocities = motion(key)
    return [np.polyfit(time[late(key)], v[late(key)], 1)[0] for v in velocities]


def rolling_by_hand(key):
    """The velocity of rolling over that of the centre: friction turns a disk that slips."""
    if key == "disk_rolls":
        return 1.0
    return 2 * FRICTION[key] * G * COS / by_hand(key)[0]


def draw_velocity(axes, keys):
    for key in keys:
        time, values, _ = motion(key)
        exact, formula = by_hand(key)
        axes.plot(
            time,
            values,
            color=COLOUR[key],
            linewidth=2.4,
            label=rf"{NAME[key]}, $\mu$ = {FRICTION[key]}: $a$ = {formula}",
        )
        # Only the slope is known by hand, not how the body lands.
        time, values = time[late(key)], values[late(key)]
        line = values.mean() + exact * (time - time.mean())
        axes.plot(time, line, color="black", linestyle=(0, (4, 3)), linewidth=1, zorder=4)
    axes.plot([], [], color="black", linestyle=(0, (4, 3)), linewidth=1, label="$a$ by hand")
    axes.set_xlabel("time (s)")
    axes.set_ylabel("velocity down the slope (m/s)")
    axes.set_xlim(0, np.ceil(10 * time[-1]) / 10)
    axes.legend(loc="upper left", fontsize=8.5)


def draw_incline(axes, x, y):
    """The ground below x + 2 y = 0."""
    corners = [(x[0], -x[0] / 2), (x[1], -x[1] / 2), (x[1], y[0] - 1), (x[0], y[0] - 1)]
    axes.add_patch(Polygon(corners, zorder=1, **GROUND))


def draw_o1():
    figure = plt.figure(figsize=(13.5, 7), layout="constrained")
    grid = figure.add_gridspec(2, 4, width_ratios=(1.3, 1, 1, 0.04))
    rows = (
        (("block_slides", "block_sticks"), (-0.75, 0.95), (-0.52, 0.88), BLOCK_STRESS, 0.13),
        (("disk_rolls", "disk_slips"), (-0.55, 1.45), (-0.62, 1.04), STRESS, 2.5),
    )
    for row, (keys, x, y, limit, top) in enumerate(rows):
        axes = figure.add_subplot(grid[row, 0])
        draw_velocity(axes, keys)
        axes.set_ylim(-0.05 * top, top)
        for column, key in enumerate(keys):
            one, cross = INCLINE[key], row == 1
            panel = figure.add_subplot(grid[row, column + 1])
            draw_incline(panel, x, y)
            _, start = draw_body(panel, one, 0, ghost=True, cross=cross)
            drawn, end = draw_body(panel, one, LAST[key], cross=cross, limit=limit)
            way = np.linalg.norm(end - start)
            text = f"{100 * way:.1f} cm" if way > 1e-3 else f"{1000 * way:.1f} mm"
            time = one.read()["time"][LAST[key]]
            bare(panel, f"{NAME[key]}: {text} in {time:g} s", x, y)
            scale_bar(panel, x[0] + 0.12, y[0] + 0.1, 0.5)
        colour_bar(drawn, figure.add_subplot(grid[row, 3]), "vertical")
    return figure


def checks_o1():
    rows = []
    for key in INCLINE:
        ours, (exact, _) = accelerations(key)[0], by_hand(key)
        name = f"{NAME[key]}, mu = {FRICTION[key]}: acceleration (m/s^2)"
        if exact:
            error = abs(ours / exact - 1)
            rows.append(
                check(
                    name,
                    f"{ours:.5f}, {100 * error:.2f} % off",
                    error < 0.02,
                    "within 2 %: the body is elastic and shivers",
                    exact=f"{exact:.5f}",
                )
            )
        else:
            rows.append(
                check(
                    name,
                    f"{ours:.1e}",
                    abs(ours) < 5e-3 * G * SIN,
                    "less than 0.5 % of g sin(beta)",
                    exact="0",
                )
            )
    for key in ("disk_rolls", "disk_slips"):
        centre, rolling = accelerations(key)
        exact = rolling_by_hand(key)
        rows.append(
            check(
                f"{NAME[key]}: angular acceleration times radius over acceleration",
                f"{rolling / centre:.4f}",
                abs(rolling / centre - exact) < 0.03,
                "within 0.03: 1 is rolling",
                exact=f"{exact:.4f}",
            )
        )
    return rows + checks_of_runs(list(INCLINE.values()))


# The bowl -------------------------------------------------------------------

BOWL = 2.0  # m, its radius
START = np.array([-1.2, -0.9])
# Conservation, and the order in the time step, need no fine mesh.
SMALL = ("Body/Boundary nodes=32",)


def bowl(key, treatment=None, fields=False):
    overrides = SMALL
    if treatment:
        overrides += (f"Contact/Treatment={treatment}",)
    if not fields:
        overrides += ("Output/Fields every=0",)
    return run("O-2", key, "bowl", overrides, 6)


# key: run, column of the energy that is kept, label, colour, line
BOWLS = {
    "persistent": (
        bowl("persistent", fields=True),
        "energy",
        "persistent contact",
        "#D55E00",
        "-",
    ),
    "inc": (
        bowl("inc", "improved normal compliance"),
        "modified_energy",
        "improved normal compliance",
        "#0072B2",
        (0, (5, 2)),
    ),
    "signorini": (
        bowl("signorini", "Signorini active set"),
        "energy",
        "Signorini active set",
        "#000000",
        (0, (1, 1.5)),
    ),
}
BOWL_STEPS = (0, 160, 300)


def change(key):
    """Energy less the work of the weight, over the largest kinetic energy."""
    one, column, *_ = BOWLS[key]
    table = one.read()
    return (table[column] - table["external_work"]) / table["kinetic_energy"].max()


def pendulum(time):
    """The way along x (m) of a rigid disk that slides without friction: a pendulum."""
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


def draw_bowl(axes, thickness=0.12):
    """The wall of a bowl or of the drum."""
    axes.add_patch(Annulus((0, 0), BOWL + thickness, thickness, zorder=1, **GROUND))


def draw_in_bowl(axes, title):
    one = BOWLS["persistent"][0]
    table = one.read()
    draw_bowl(axes)
    for step in BOWL_STEPS:
        drawn, middle = draw_body(axes, one, step)
        label(axes, middle * (1 - 0.7 / np.hypot(*middle)), f"{table['time'][step]:.2f} s")
    bare(axes, title, (-2.2, 2.2), (-2.25, 0.44))
    return drawn


def path(one):
    table = one.read()
    return START[0] + table["centre_displacement_x"], START[1] + table["centre_displacement_y"]


def draw_o2():
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


def checks_o2():
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
    rows.append(
        info(f"{BOWLS['signorini'][2]}: energy lost", f"{-100 * signorini[-1]:.3f} %")
    )
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


# Obstacles that move --------------------------------------------------------

UNTIL = 0.6  # s, the end of the runs with smaller steps
STEPS = (4e-3, 2e-3, 1e-3)  # s

# key: colour, the steps of the pictures
MOVING = {"plate": ("#0072B2", (20, 130, 240)), "drum": ("#009E73", (20, 90, 180))}
FILE = {"plate": "rising_plate", "drum": "drum"}


def moving(key, step):
    """The run with the step of the file goes on to the file's end, for the pictures."""
    if step == STEPS[0]:
        return run("O-3", f"{key}_{1e3 * step:g}ms", FILE[key], (*SMALL, "Output/Fields every=10"))
    return Run(
        "O-3",
        f"{key}_{1e3 * step:g}ms",
        "obstacle_course",
        f"obstacle_course/{FILE[key]}.prm",
        (*QUIET, *SMALL, f"Time/Time step={step:g}", f"Time/Final time={UNTIL:g}"),
        cost=4,
    )


MOVES = {(key, step): moving(key, step) for key in MOVING for step in STEPS}


# The motions are those of the parameter files; a check compares the plate with the gaps.


def plate_height(time):
    return 0.2 * (1 - np.cos(4 * time))


def plate_angle(time):
    return 0.2 * np.sin(3 * time)


def drum_angle(time):
    return 1.5 * time


def works(one):
    """The work of an obstacle on the body (J): by the balance, and by the resultants."""
    table = one.read()
    early = table["time"] < UNTIL + 1e-9
    potential = table["modified_energy"] - table["energy"]
    balance = potential - potential[0] - table["contact_work"]
    return balance[early], table["obstacle_work"][early]


def difference(key, step):
    balance, resultants = works(MOVES[key, step])
    return np.abs(balance - resultants).max()


def draw_plate(axes, time):
    half, thickness = 1.05, 0.12
    c, s = np.cos(plate_angle(time)), np.sin(plate_angle(time))
    corners = np.array([(-half, 0), (half, 0), (half, -thickness), (-half, -thickness)])
    turned = corners @ np.array([[c, s], [-s, c]]) + (0, plate_height(time))
    axes.add_patch(Polygon(turned, zorder=1, **GROUND))


def draw_drum(axes, time):
    draw_bowl(axes, 0.16)
    # Bolts show how far the drum has turned.
    for part in range(12):
        angle = drum_angle(time) + (part / 6 - 0.7) * np.pi
        axes.plot(
            *((BOWL + 0.08) * np.array([np.cos(angle), np.sin(angle)])),
            "o",
            color="black" if part == 0 else "white",
            markeredgecolor="0.25",
            markeredgewidth=0.7,
            markersize=5,
            zorder=2,
        )


def draw_moving(axes, key, step):
    """The body on its obstacle; what maps colours, and the time."""
    one = MOVES[key, STEPS[0]]
    time = one.read()["time"][step]
    drawn, _ = draw_body(axes, one, step)
    if key == "plate":
        # Where the plate was at the start.
        axes.axhline(0, color="0.6", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0)
        draw_plate(axes, time)
        bare(axes, "", (-1.45, 1.15), (-0.36, 1.5))
        scale_bar(axes, -1.37, 1.29, 0.5)
    else:
        draw_drum(axes, time)
        bare(axes, "", (-1.3, 1.3), (-2.24, -0.38))
        scale_bar(axes, -1.22, -0.59, 0.5)
    return drawn, time


def draw_o3():
    figure = plt.figure(figsize=(14, 6.2), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=(2.6, 1))
    grid = left.add_gridspec(3, 3, height_ratios=(1, 1, 0.04))
    for row, (key, (_, steps)) in enumerate(MOVING.items()):
        for column, step in enumerate(steps):
            axes = left.add_subplot(grid[row, column])
            drawn, time = draw_moving(axes, key, step)
            axes.set_title(f"{key}, {time:.2f} s")
    colour_bar(drawn, left.add_subplot(grid[2, 1]))

    axes = right.add_subplot()
    steps = np.array(STEPS)
    for key, (colour, _) in MOVING.items():
        values = [difference(key, step) for step in STEPS]
        axes.loglog(1e3 * steps, values, "o", color=colour, label=key, markersize=7)
        line = values[-1] * (steps / steps[-1]) ** 2
        axes.loglog(1e3 * steps, line, color=colour, linestyle=(0, (4, 3)), linewidth=1)
    axes.plot([], [], color="0.4", linestyle=(0, (4, 3)), linewidth=1, label="slope 2")
    axes.set_xticks(1e3 * steps, [f"{1e3 * step:g}" for step in STEPS])
    axes.minorticks_off()
    axes.set_xlabel("time step (ms)")
    axes.set_ylabel("|work by the balance $-$ work by the resultants| (J)")
    axes.set_title(f"work of about 3 kJ until {UNTIL:g} s")
    axes.legend()
    return figure


def checks_o3():
    rows = []
    for key in MOVING:
        values = [difference(key, step) for step in STEPS]
        ratios = [a / b for a, b in zip(values[:-1], values[1:])]
        total = works(MOVES[key, STEPS[-1]])[1][-1]
        rows.append(info(f"{key}: work of the obstacle until {UNTIL:g} s (J)", f"{total:.1f}"))
        rows.append(
            check(
                f"{key}: balance against resultants (J), steps of 4, 2, 1 ms",
                ", ".join(f"{value:.2e}" for value in values),
                all(3 < ratio < 5 for ratio in ratios),
                "each 3 to 5 times the next: second order; ratios "
                + ", ".join(f"{ratio:.2f}" for ratio in ratios),
                exact="ratio 4",
            )
        )
        fall, taken = 0.0, []
        for step in STEPS:
            table = MOVES[key, step].read()
            fall = max(fall, -np.diff(table["friction_work"]).min() / table["energy"].max())
            early = table["time"] < UNTIL + 1e-9
            taken.append(table["friction_work"][early][-1])
        rows.append(
            check(
                f"{key}: largest fall of the work against friction in a step",
                f"{max(fall, 0):.1e}",
                fall <= 1e-12,
                "at most 1e-12 of the energy: friction only takes",
                exact="<= 0",
            )
        )
        rows.append(
            info(
                f"{key}: work against friction (J), the same steps",
                ", ".join(f"{value:.1f}" for value in taken),
            )
        )
    rows.append(plate_row())
    return rows + checks_of_runs(list(MOVES.values()))


def plate_row():
    """The plate of the pictures is where the program has it."""
    one = MOVES["plate", STEPS[0]]
    worst = 0.0
    for step in MOVING["plate"][1]:
        time = one.read()["time"][step]
        _, place, _, fields = snapshot(one, step)
        normal = np.array([-np.sin(plate_angle(time)), np.cos(plate_angle(time))])
        gap = (place - (0, plate_height(time))) @ normal
        worst = max(worst, np.abs(gap - fields["gap"].reshape(-1)).max())
    return check(
        "plate of the pictures: distances of the points against the field of gaps (m)",
        f"{worst:.1e}",
        worst < 1e-5,
        "< 1e-5: fields have single precision",
        exact="0",
    )


# All at a glance ------------------------------------------------------------


def draw_o4():
    figure = plt.figure(figsize=(11, 6), layout="constrained")
    grid = figure.add_gridspec(2, 4, height_ratios=(1.65, 1))
    incline, in_bowl = figure.add_subplot(grid[0, :2]), figure.add_subplot(grid[0, 2:])

    one, last = INCLINE["disk_rolls"], LAST["disk_rolls"]
    time = one.read()["time"]
    x, y = (-0.85, 1.75), (-0.52, 1.08)
    draw_incline(incline, x, y)
    for step in (0, last):
        drawn, middle = draw_body(incline, one, step, ghost=step < last)
        label(incline, middle + (RADIUS + 0.07) * np.array([SIN, COS]), f"{time[step]:.2f} s")
    bare(incline, "a disk rolls down an incline", x, y)
    scale_bar(incline, x[0] + 0.1, y[0] + 0.08, 0.5)

    draw_in_bowl(in_bowl, "without friction, it runs to and fro in a bowl")
    scale_bar(in_bowl, -2.1, -2.15, 0.5)
    colour_bar(drawn, in_bowl.inset_axes((-0.8, 0.05, 1.6, 0.09), transform=in_bowl.transData))

    for column, (key, (_, steps)) in enumerate(MOVING.items()):
        for k, step in enumerate(steps[::2]):
            axes = figure.add_subplot(grid[1, 2 * column + k])
            _, time = draw_moving(axes, key, step)
            axes.set_title(
                f"{'on a rising plate' if key == 'plate' else 'in a turning drum'}, {time:.2f} s",
                fontsize=10,
            )
    return figure


# The figures ----------------------------------------------------------------

FIGURES = [
    Figure(
        "O-1",
        "Obstacle course: block and disk on an incline",
        "An incline of tan(beta) = 1/2. Left: velocity of the centre; right: the body at the "
        "start (grey) and at the end, with von Mises stress and the resultant of the contact "
        "force. A block slides or sticks as the friction coefficient is below or above 1/2, a "
        "disk slips or rolls as it is below or above 1/6. Bodies land within a tenth of a second, "
        "in which also the block slides that then sticks. Cross and dot are fixed to the disk.",
        list(INCLINE.values()),
        draw_o1,
        checks_o1,
    ),
    Figure(
        "O-2",
        "Obstacle course: a disk in a bowl",
        "A soft disk without friction in a bowl of 2 m. Left: three instants, with von Mises "
        "stress and the resultant of the contact force. Right: its middle, beside a pendulum, "
        "and how far energy less the work of the weight moves from zero. For improved normal "
        "compliance the energy counts the contact potential.",
        [one for one, *_ in BOWLS.values()],
        draw_o2,
        checks_o2,
    ),
    Figure(
        "O-3",
        "Obstacle course: a plate that is lifted, a drum that turns",
        "Left: a disk on a plate that is lifted and tilted (persistent contact), and in a drum "
        "that turns against the clock (improved normal compliance), with friction. Right: what "
        "the obstacle does to the body, once from the energy balance and once from the "
        "resultant of the contact force, its moment and the motion; the largest difference "
        "until 0.6 s falls with the square of the step.",
        list(MOVES.values()),
        draw_o3,
        checks_o3,
    ),
    Figure(
        "O-4",
        "Obstacle course at a glance",
        "Runs of figures O-1 to O-3: a disk rolls down an incline (grey: at the start), runs to "
        "and fro in a bowl, is lifted by a plate and dragged along by a drum, with von Mises "
        "stress and the resultant of the contact force. Cross and dot are fixed to the disk.",
        [INCLINE["disk_rolls"], BOWLS["persistent"][0], *(MOVES[key, STEPS[0]] for key in MOVING)],
        draw_o4,
    ),
]
