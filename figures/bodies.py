# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact of deformable bodies with each other.

The stent in an artery is paper B, section 7 (figures 13 to 16). Two disks that collide (D)
and a block that slides on a strip (S) are of no paper: what they are compared with are laws
of conservation, each other, and formulas by hand.
"""

import re

import matplotlib.animation as animation
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Rectangle

from obstacles import GROUND, bare, colour_bar, outline, scale_bar, snapshot, zero_line
from paper_ab_common import SCALE, checks_of_runs, order_row, statement, table_image
from report import Figure, check, info
from runs import QUIET, Run

G = 9.81  # m/s^2


def log_of(one):
    return (one.folder / "log.txt").read_text(encoding="utf-8")


def save_frames(path, figure, draw, frames, speed=12):
    """Write an animation: `draw(frame)` draws one of the frames into the figure."""
    # The last frame stays for a second.
    writer = animation.PillowWriter(fps=speed)
    with writer.saving(figure, path, dpi=80):
        for frame in [*frames, *[frames[-1]] * speed]:
            draw(frame)
            writer.grab_frame()
    plt.close(figure)


# Stent and artery -----------------------------------------------------------
#
# Units are mm, N, MPa, s: energies are in mJ, per mm of depth.

LENGTH, THICKNESS = 20.0, 1.0  # mm, of the wall
DEEPEST = 0.025  # mm
STRESS = 1.5  # MPa, the largest shown
# The viscosity that is shown with friction (MPa s); the paper's "1" has no unit.
ETA_WITH_FRICTION = "0.01"


def stent(figure, key, mu="0", eta="0", output=QUIET):
    """A run with friction, or with viscosity, or with both."""
    file = f"mu_{mu}" if mu != "0" else f"eta_{eta}" if eta != "0" else "default"
    overrides = list(output)
    if mu != "0" and eta != "0":
        for part in ("Artery", "Stent"):
            overrides += [f"{part}/Viscosity=Curnier", f"{part}/Viscosity eta={eta}"]
    return Run(
        figure, key, "stent_artery", f"stent_artery/{file}.prm", tuple(overrides), cost=4
    )


# Every other step is written, for the animation.
DEPLOYMENT = stent("B-14", "fields", output=("Output/Fields every=2", "Output/Log every=0"))
STEPS = (0, 20, 30, 50)

ETAS = ("0", "0.001", "0.01", "0.03")  # MPa s
MUS = ("0", "0.1", "0.2", "0.4")
# key: mu, eta
STENTS = {("0", eta): stent("B-15", f"eta_{eta}", eta=eta) for eta in ETAS}
STENTS.update({(mu, "0"): stent("B-16", f"mu_{mu}", mu=mu) for mu in MUS[1:]})
STENTS.update(
    {
        (mu, ETA_WITH_FRICTION): stent(
            "B-16", f"mu_{mu}_eta_{ETA_WITH_FRICTION}", mu, ETA_WITH_FRICTION
        )
        for mu in MUS[1:]
    }
)
TIMED = Run("B-T1", "default", "stent_artery", "stent_artery/default.prm", cost=4)


def family(mus=("0",), etas=("0",)):
    return {(mu, eta): STENTS[mu, eta] for mu in mus for eta in etas}


def dissipation(one):
    """What friction and viscosity took until each step (mJ)."""
    table = one.read()
    return table["friction_work"] + table["viscous_dissipation"]


def change(one):
    """Change of energy less the work of the imposed displacement, in each step (mJ)."""
    table = one.read()
    return np.diff(table["energy"] - table["imposed_work"])


def largest_energy(one):
    return one.read()["energy"].max()


def sides_of(cells):
    """All sides of triangles, each once: pairs of points."""
    sides = np.concatenate((cells[:, :2], cells[:, 1:], cells[:, ::2]))
    return np.unique(np.sort(sides, axis=1), axis=0)


def draw_cells(axes, place, cells, values, limit, lines=True):
    """Deformed bodies with a colour for each triangle; what maps colours."""
    # Few colours keep an animation small.
    drawn = PolyCollection(
        place[cells], cmap=plt.get_cmap("YlOrRd", 15), edgecolor="face", linewidth=0.3
    )
    drawn.set_array(values)
    drawn.set_clim(0, limit)
    axes.add_collection(drawn)
    draw_lines(axes, place, cells, lines)
    return drawn


def draw_lines(axes, place, cells, inner=True):
    """The outlines of bodies, and the sides of their triangles."""
    if inner:
        axes.add_collection(
            LineCollection(place[sides_of(cells)], colors="0.45", linewidths=0.3, snap=False)
        )
    axes.add_collection(
        LineCollection(place[outline(cells)], colors="black", linewidths=0.8, zorder=3)
    )


def draw_mesh(axes, step, coloured, lines=True):
    """Artery and stent at a step; what maps colours, if any."""
    _, place, cells, fields = snapshot(DEPLOYMENT, step)
    if coloured:
        stress = fields["von_mises of cells"]
        return draw_cells(axes, place, cells, stress, STRESS, lines)
    for number, colour in ((0, "#F2C9C0"), (1, "#B8C4D0")):
        chosen = cells[fields["part of cells"] == number]
        axes.add_collection(PolyCollection(place[chosen], facecolor=colour, edgecolor="face"))
    draw_lines(axes, place, cells, lines)
    return None


def held(axes):
    """Hatches where the wall is clamped."""
    for corner, width, height in (
        ((-0.3, THICKNESS), LENGTH + 0.6, 0.12),
        ((-0.3, 0), 0.3, THICKNESS),
        ((LENGTH, 0), 0.3, THICKNESS),
    ):
        axes.add_patch(
            Rectangle(corner, width, height, facecolor="none", edgecolor="0.4", hatch="/////", lw=0)
        )


WHOLE = ((-0.45, LENGTH + 0.45), (-0.66, THICKNESS + 0.16))


def draw_setup(axes):
    """The sketch: what is held, what is moved, what may touch."""
    rest, place, cells, fields = snapshot(DEPLOYMENT, 0)
    draw_mesh(axes, 0, coloured=False, lines=False)
    held(axes)
    lower = {"color": "#D55E00", "arrowstyle": "-|>", "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0}
    points = rest[fields["part"] == 1]
    for x in np.linspace(4, 15, 8):
        near = points[np.abs(points[:, 0] - x) < 0.1]
        foot = near[near[:, 1].argmin()]
        axes.annotate("", xy=foot + (1.0, 0.4), xytext=foot, arrowprops=lower, zorder=5)
    words = {"ha": "center", "va": "center", "fontsize": 9}
    axes.text(10, 1.28, "clamped: outer side and ends", **words)
    axes.text(10, 0.55, "artery 20 mm x 1 mm, 81 x 9 nodes; inner side: slave nodes", **words)
    axes.text(
        10,
        -0.86,
        "stent, 400 times stiffer, 102 x 4 nodes; upper side: master facets.  "
        "All nodes of its lower side move by (1.0, 0.4) mm in 1 s (arrows)",
        **words,
    )
    axes.set_xlim(*WHOLE[0])
    axes.set_ylim(-1.0, 1.42)
    axes.set_aspect(2)
    axes.axis("off")


def draw_b13():
    figure, axes = plt.subplots(
        3, 1, figsize=(12, 8.2), height_ratios=(2.3, 1, 4.2), layout="constrained"
    )
    draw_setup(axes[0])
    axes[0].set_title("set-up (heights are doubled)")
    for panel, x, y, title in (
        (axes[1], *WHOLE, "meshes at the start"),
        (axes[2], (3.6, 8.0), (-0.62, 1.03), "the same, a part of it"),
    ):
        draw_mesh(panel, 0, coloured=False)
        bare(panel, title, x, y)
    scale_bar(axes[2], 7.35, -0.55, 0.5, "mm")
    return figure


def draw_b14():
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


def animate_stent(path):
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


def checks_b13():
    rest, _, cells, fields = snapshot(DEPLOYMENT, 0)
    ends = [rest[fields["part"] == number] for number in (0, 1)]
    gap = ends[0][:, 1].min() - ends[1][:, 1].max()
    return [
        check(
            "nodes",
            f"{len(rest)}: {len(ends[0])} of the artery, {len(ends[1])} of the stent",
            len(rest) == 1137,
            "the same",
            "1137",
        ),
        check(
            "distance of the crests of the stent from the wall (mm)",
            f"{gap:.4f}",
            0.05 - 1e-6 < gap < 0.053,
            "nodes next to the crests, up to 0.003 more",
            exact="0.05",
        ),
    ]


def checks_b14():
    table = DEPLOYMENT.read()
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
    seconds = wall_clock(DEPLOYMENT)
    return [
        check(
            "nodes of the wall that touch the stent, at 0.4, 0.6 and 1 s",
            ", ".join(f"{table['active_points_wall'][k]:.0f}" for k in STEPS[1:])
            + f"; {before.sum()} are before it at the end",
            touching.sum() >= 0.9 * before.sum(),
            "nine of ten of those before it at the end",
            "the stent adheres to the wall",
        ),
        check(
            f"largest penetration of a node of the wall (mm), {len(STENTS) + 1} runs",
            f"{deepest:.4f}",
            deepest < DEEPEST,
            f"< {DEEPEST:g}: a tenth of a facet of the wall, an eighth of the stent's thickness",
        ),
        check(
            "sum of the contact forces on both bodies, over that on the wall",
            f"{error:.1e}",
            error < 1e-5,
            "< 1e-5: fields have single precision",
            exact="0",
        ),
        info("force of the wall on the stent at 1 s (N per mm)", f"{force[wall, 1].sum():.3f}"),
        check(
            "seconds of the run with fields of every other step",
            f"{seconds:.1f}",
            seconds < 55,
            "less than the paper's; B-T1 measures the default run",
            "55",
        ),
    ] + ledger_rows([DEPLOYMENT])


def wall_clock(one):
    """Seconds of a run, from its start to its end."""
    return float(re.search(r"elapsed since start +\| +([0-9.e+-]+)s", log_of(one)).group(1))


def ledger_rows(runs):
    """The balance in each step, over the largest energy: it begins with next to none."""
    worst = max(
        np.abs(change(one) + np.diff(dissipation(one))).max() / largest_energy(one) for one in runs
    )
    halvings = [int(one.read()["step_halvings"].max()) for one in runs]
    return [
        check(
            f"largest residual of the balance in a step, {len(runs)} run{'s' * (len(runs) > 1)}",
            f"{worst:.1e}",
            worst < 1e-9,
            "< 1e-9 of the largest energy",
            exact="0",
        ),
        info("step halvings of these runs", ", ".join(map(str, halvings))),
    ]


def draw_steps(left, right, runs, name):
    for (key, one), colour in zip(runs.items(), ("#000000", *SCALE[1:])):
        table = one.read()
        left.plot(table["time"][1:], 1e3 * change(one), color=colour, label=name(*key))
        right.plot(table["time"], dissipation(one), color=colour, label=name(*key))
    left.set_ylabel(r"$\Delta E - \Delta W$ in a step ($\mu$J)")
    right.set_ylabel("dissipated until then (mJ)")
    right.legend(fontsize=8.5)
    for panel in (left, right):
        panel.set_xlim(0, 1)
        panel.set_xlabel("time (s)")


def draw_b15():
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.4), layout="constrained")
    draw_steps(*axes, family(etas=ETAS), lambda mu, eta: rf"$\eta$ = {eta} MPa s")
    return figure


def draw_b16():
    figure, axes = plt.subplots(2, 2, figsize=(12, 8), layout="constrained")
    for row, eta in zip(axes, ("0", ETA_WITH_FRICTION)):
        draw_steps(*row, family(MUS, (eta,)), lambda mu, _: rf"$\mu$ = {mu}")
        for panel in row:
            panel.set_title(rf"$\eta$ = {eta} MPa s")
    return figure


def stent_rows(runs):
    """Nothing is gained, and what is missing is what friction and viscosity took."""
    rise = max(change(one).max() / largest_energy(one) for one in runs.values())
    return [
        check(
            f"largest change of energy less work in a step, {len(runs)} runs",
            f"{rise:.1e}",
            rise <= 1e-12,
            "at most 1e-12 of the largest energy: round-off",
            "always negative",
            "<= 0",
        )
    ] + ledger_rows(runs.values())


def conserving_row():
    one = STENTS["0", "0"]
    worst = np.abs(change(one)).max() / largest_energy(one)
    return check(
        "mu = 0, eta = 0: max |change of energy less work| in a step",
        f"{worst:.1e}",
        worst <= 1e-9,
        "at most 1e-9 of the largest energy: Newton's tolerance",
        "practically zero",
        "0",
    )


def checks_b15():
    runs = family(etas=ETAS)
    damped = {key: one for key, one in runs.items() if key != ("0", "0")}
    return [
        conserving_row(),
        order_row(
            "dissipated (mJ), eta = 0, 0.001, 0.01, 0.03 MPa s",
            [dissipation(one)[-1] for one in runs.values()],
            "grows with eta",
            "grows with eta",
            "{:.4f}",
        ),
        *stent_rows(damped),
    ]


def fluctuation(one):
    """How much the change in a step goes up and down (uJ): its total variation."""
    return 1e3 * np.abs(np.diff(change(one))).sum()


def checks_b16():
    rows = [conserving_row()]
    for eta in ("0", ETA_WITH_FRICTION):
        runs = family(MUS, (eta,))
        rows.append(
            order_row(
                f"eta = {eta}: dissipated (mJ), mu = 0, 0.1, 0.2, 0.4",
                [dissipation(one)[-1] for one in runs.values()],
                "grows with mu",
                "grows with mu",
                "{:.4f}",
            )
        )
        values = [fluctuation(one) for one in runs.values()]
        rows.append(
            statement(
                f"eta = {eta}: total variation of the change in a step (uJ)",
                ", ".join(f"{value:.1f}" for value in values),
                bool((np.diff(values) > 0).all()),
                "grows with mu",
                "fluctuations grow with mu",
                "does not grow from each mu to the next",
            )
        )
    dissipative = {
        key: one for key, one in family(MUS, ("0", ETA_WITH_FRICTION)).items() if key[0] != "0"
    }
    return rows + stent_rows(dissipative)


def draw_t1():
    rows = [["whole run", f"{wall_clock(TIMED):.2f}", "55"]]
    text = log_of(TIMED)
    for section in ("steps", "fields and checkpoints", "energy ledger"):
        seconds = re.search(rf"^\| {section} +\| +\d+ \| +([0-9.e+-]+)s", text, re.M).group(1)
        rows.append([section, f"{float(seconds):.2f}", "-"])
    return table_image(["", "ours (s)", "paper (s)"], rows, [0.5, 0.25, 0.25])


def checks_t1():
    seconds = wall_clock(TIMED)
    return [
        check("seconds of the default run", f"{seconds:.2f}", seconds < 3, "< 3 on one core", "55")
    ]


# Colliding disks ------------------------------------------------------------

TREATMENTS = {
    "persistent": ("persistent contact", "persistent contact", "#D55E00"),
    "inc": ("improved normal compliance", r"INC, $\alpha = 2$", "#0072B2"),
    "signorini": ("Signorini active set", "Signorini, active set", "#000000"),
}
# Offset (m) and friction coefficient.
CASES = (("0", "0"), ("1", "0"), ("1", "0.2"))


def disks(figure, key, treatment="persistent", case=CASES[0], more=(), output=QUIET, cost=2.0):
    file = dict(zip(CASES, ("default", "oblique", "oblique_friction")))[case]
    overrides = list(output)
    if treatment != "persistent":
        overrides.append(f"Contact/Treatment={TREATMENTS[treatment][0]}")
    return Run(
        figure,
        key,
        "colliding_disks",
        f"colliding_disks/{file}.prm",
        (*overrides, *more),
        cost=cost,
    )


D2 = {
    (key, *case): disks("D-2", f"{key}_b_{case[0]}_mu_{case[1]}", key, case)
    for key in TREATMENTS
    for case in CASES
}
OBLIQUE = disks(
    "D-1",
    "oblique",
    case=CASES[2],
    more=("Time/Final time=0.6",),
    output=("Output/Fields every=2", "Output/Log every=0"),
    cost=5,
)
FRAMES = (0, 30, 60, 100, 150)
DISK_STRESS = 60.0  # kPa
ARROW = 8e-6  # m per N


def printed(one):
    """The numbers that the program prints at the end."""
    return {
        name: float(value)
        for name, value in re.findall(r"^(\w+) +(-?\d\.\d+e[+-]\d+)$", log_of(one), re.M)
    }


def draw_disks(axes, step, force=True, lines=False):
    """Both disks, with two diameters of each and the force between them."""
    rest, place, cells, fields = snapshot(OBLIQUE, step)
    drawn = draw_cells(axes, place, cells, fields["von_mises of cells"] / 1e3, DISK_STRESS, lines)
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


DISK_VIEW = ((-2.3, 2.3), (-1.92, 1.92))


def draw_d1():
    figure = plt.figure(figsize=(13, 7.2), layout="constrained")
    grid = figure.add_gridspec(2, 4, width_ratios=(1, 1, 1, 0.03))
    table = OBLIQUE.read()
    for k, step in enumerate(FRAMES):
        axes = figure.add_subplot(grid[k // 3, k % 3])
        drawn = draw_disks(axes, step)
        bare(axes, f"{table['time'][step]:.2f} s", *DISK_VIEW)
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


def animate_disks(path):
    time = OBLIQUE.read()["time"]
    figure, axes = plt.subplots(figsize=(5.2, 4.4), layout="constrained")

    def draw(step):
        axes.clear()
        draw_disks(axes, step, lines=True)
        bare(axes, f"two disks with friction, {time[step]:.2f} s", *DISK_VIEW)

    save_frames(path, figure, draw, list(range(0, 151, 4)), speed=10)


def checks_d1():
    table = OBLIQUE.read()
    total = (table["energy"] + table["friction_work"]) / table["energy"][0]
    worst = np.abs(total - 1).max()
    rise = np.diff(table["energy"]).max() / table["energy"][0]
    mass = table["momentum_x_left"][0]
    errors = []
    for step in FRAMES:
        force = snapshot(OBLIQUE, step)[3]["contact_force"][:, :2].astype(float)
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
        info("work of friction", f"{100 * table['friction_work'][-1] / table['energy'][0]:.2f} %"),
        momenta_row([OBLIQUE], mass),
        check(
            "sum of the contact forces on both disks in the pictures, relative",
            f"{max(errors):.1e}",
            max(errors) < 1e-5,
            "< 1e-5: fields have single precision",
            exact="0",
        ),
    ] + checks_of_runs([OBLIQUE])


MOMENTA = ("momentum_x", "momentum_y", "angular_momentum")


def momenta_row(runs, mass):
    """Nothing comes from outside: momenta are those of the start in all steps."""
    worst = 0.0
    for one in runs:
        table = one.read()
        for name in MOMENTA:
            worst = max(worst, np.abs(table[name] - table[name][0]).max())
    return check(
        "max change of linear and angular momentum",
        f"{worst / mass:.1e}",
        worst < 1e-9 * mass,
        "< 1e-9 of a disk's momentum (times 1 m)",
        exact="0",
    )


HEADER = (
    "treatment",
    "offset, friction",
    "velocity left (m/s)",
    "velocity right (m/s)",
    "restitution",
    "energy left",
    "drift of momenta",
    "penetration (mm)",
)


def table_of_disks():
    rows = []
    for (key, offset, mu), one in D2.items():
        values = printed(one)
        mass = one.read()["momentum_x_left"][0]
        drift = max(abs(values[f"drift_{name}"]) for name in MOMENTA)
        deep = 1e3 * values["penetration"]
        rows.append(
            [
                TREATMENTS[key][1],
                rf"$b$ = {offset} m, $\mu$ = {mu}",
                "({velocity_x_left:.5f}, {velocity_y_left:.5f})".format(**values),
                "({velocity_x_right:.5f}, {velocity_y_right:.5f})".format(**values),
                f"{values['restitution']:.5f}",
                f"{values['energy_left_over']:.6f}",
                f"{drift / mass:.0e}",
                f"{deep:.3f}" if deep > 1e-6 else "0",
            ]
        )
    return rows


def draw_d2():
    figure = plt.figure(figsize=(14, 9.4), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(1.15, 1))
    for column, (offset, mu) in enumerate(CASES):
        axes = figure.add_subplot(grid[0, column])
        for key, (_, text, colour) in TREATMENTS.items():
            table = D2[key, offset, mu].read()
            axes.plot(
                table["time"],
                (table["energy"] + table["friction_work"]) / table["energy"][0],
                color=colour,
                linestyle=(0, (4, 3)) if key == "persistent" else "-",
                label=text,
                zorder=4 if key == "persistent" else 3,
            )
        axes.set_title(rf"offset {offset} m, $\mu$ = {mu}")
        axes.set_xlabel("time (s)")
        axes.set_xlim(0, table["time"][-1])
    figure.axes[0].set_ylabel("energy and work of friction,\nover the energy at the start")
    figure.axes[0].legend(fontsize=8.5)
    axes = figure.add_subplot(grid[1, :])
    axes.axis("off")
    table = axes.table(
        cellText=table_of_disks(),
        colLabels=HEADER,
        loc="center",
        cellLoc="center",
        colWidths=[0.15, 0.13, 0.16, 0.16, 0.09, 0.09, 0.11, 0.11],
    )
    table.auto_set_font_size(False)
    table.set_fontsize(9)
    table.scale(1, 1.6)
    for (row, _), cell in table.get_celld().items():
        cell.set_edgecolor("0.8")
        if row == 0:
            cell.set_facecolor("0.93")
    return figure


def checks_d2():
    def of(treatment):
        return [one for key, one in D2.items() if key[0] == treatment]

    rows = []
    for key, name in (("persistent", "energy"), ("inc", "energy, contact potential")):
        worst = 0.0
        for one in of(key):
            table = one.read()
            kept = table["modified_energy"] + table["friction_work"]
            worst = max(worst, np.abs(kept / kept[0] - 1).max())
        rows.append(
            check(
                f"{TREATMENTS[key][0]}: max change of {name} and work of friction",
                f"{worst:.1e}",
                worst < 1e-9,
                "< 1e-9 of the energy: Newton's tolerance, summed over the steps",
                exact="0",
            )
        )
    worst = 0.0
    for one in of("inc"):
        table = one.read()
        free = np.flatnonzero(table["active_points_disks"] == 0)
        kept = (table["energy"] + table["friction_work"]) / table["energy"][0]
        worst = max(worst, np.abs(kept[free] - 1).max())
    rows.append(
        check(
            "improved normal compliance: the same of energy and friction when nothing touches",
            f"{worst:.1e}",
            worst < 1e-9,
            "< 1e-9 of the energy: it comes back",
            exact="0",
        )
    )
    rise, lost = -np.inf, []
    for one in of("signorini"):
        table = one.read()
        kept = (table["energy"] + table["friction_work"]) / table["energy"][0]
        rise = max(rise, np.diff(kept).max())
        lost.append(100 * (1 - kept[-1]))
    rows += [
        check(
            "Signorini: largest rise of energy and work of friction in a step",
            f"{rise:.1e}",
            rise <= 1e-12,
            "at most 1e-12 of the energy: it only loses",
            exact="<= 0",
        ),
        info("Signorini: lost, the three cases", ", ".join(f"{x:.2f} %" for x in lost)),
        check(
            "Signorini: largest penetration (m)",
            f"{max(printed(one)['penetration'] for one in of('signorini')):.1e}",
            all(printed(one)["penetration"] < 1e-12 for one in of("signorini")),
            "< 1e-12: round-off",
            exact="0",
        ),
    ]
    for case in CASES:
        values = [printed(D2[key, *case]) for key in TREATMENTS]
        restitution = [v["restitution"] for v in values]
        spread = max(restitution) - min(restitution)
        rows.append(
            check(
                f"b = {case[0]} m, mu = {case[1]}: restitution, the three treatments",
                ", ".join(f"{x:.5f}" for x in restitution),
                spread < 0.01,
                "within 0.01 of each other",
            )
        )
    mass = D2["persistent", "0", "0"].read()["momentum_x_left"][0]
    return rows + [momenta_row(D2.values(), mass)] + checks_of_runs(D2.values())


# Which disk is the slave.
RINGS = ((6, 5), (11, 9), (22, 18))
TIME_STEPS = ("0.004", "0.002")  # s


def swapped(rings, step, slave):
    more = []
    if rings != (11, 9):
        for side, number in zip(("left", "right"), rings):
            more.append(f"Disks/Rings of the {side} disk={number}")
    if slave != "left":
        more.append(f"Disks/Slave={slave}")
    if step != "0.004":
        more.append(f"Time/Time step={step}")
    return disks(
        "D-3",
        f"{rings[0]}_{rings[1]}_{1e3 * float(step):g}ms_{slave}",
        case=CASES[1],
        more=tuple(more),
        cost=0.03 * rings[0] ** 2,
    )


D3 = {
    (rings, step, slave): swapped(rings, step, slave)
    for rings in RINGS
    for step in TIME_STEPS
    for slave in ("left", "right")
}


def velocity(*key):
    """Of the left disk's centre at the end (m/s)."""
    values = printed(D3[key])
    return np.array([values["velocity_x_left"], values["velocity_y_left"]])


def reference():
    """The mean of both choices on the finest mesh with the smallest step."""
    return sum(velocity(RINGS[-1], TIME_STEPS[-1], slave) for slave in ("left", "right")) / 2


def difference(rings, step):
    """What the choice of the slave changes (m/s)."""
    return np.linalg.norm(velocity(rings, step, "left") - velocity(rings, step, "right"))


def error(*key):
    return np.linalg.norm(velocity(*key) - reference())


def draw_d3():
    figure, axes = plt.subplots(figsize=(8, 4.8), layout="constrained")
    nodes = [6 * rings[0] for rings in RINGS]
    for step, colour in zip(TIME_STEPS, ("#0072B2", "#D55E00")):
        text = f"step {1e3 * float(step):g} ms: "
        axes.loglog(
            nodes,
            [difference(rings, step) for rings in RINGS],
            "o-",
            color=colour,
            label=text + "slave left less slave right",
        )
        # The reference is made of those with the finest mesh and the smallest step.
        coarse = range(len(RINGS) - (step == TIME_STEPS[-1]))
        for slave, marker in (("left", "<"), ("right", ">")):
            axes.loglog(
                [nodes[k] for k in coarse],
                [error(RINGS[k], step, slave) for k in coarse],
                marker,
                color=colour,
                markerfacecolor="none",
                markersize=9,
                label=text + f"error, slave {slave}",
            )
    axes.set_xticks(nodes, [str(n) for n in nodes])
    axes.minorticks_off()
    axes.set_xlabel("nodes on the circle of the left disk")
    axes.set_ylabel("difference in the left disk's velocity (m/s)")
    axes.legend(fontsize=8)
    return figure


def checks_d3():
    rows = []
    small = TIME_STEPS[-1]
    differences = [difference(rings, small) for rings in RINGS]
    rows.append(
        order_row(
            "slave and master swapped: change of velocity (m/s), 36, 66, 132 nodes, step 2 ms",
            differences,
            "falls with the mesh",
            "-",
            "{:.1e}",
            rising=False,
        )
    )
    for rings in RINGS[:-1]:
        for step in TIME_STEPS:
            ours = difference(rings, step)
            largest = max(error(rings, step, slave) for slave in ("left", "right"))
            rows.append(
                check(
                    f"{6 * rings[0]} nodes, step {1e3 * float(step):g} ms: "
                    "the same, and the larger error of both (m/s)",
                    f"{ours:.1e}, {largest:.1e}",
                ours < 1.5 * largest,
                    "less than 1.5 times the error",
                )
            )
    least = min(error(RINGS[1], small, slave) for slave in ("left", "right"))
    rows.append(
        check(
            "132 nodes, step 2 ms: the same, and the smaller error with 66 nodes (m/s)",
            f"{differences[-1]:.1e}, {least:.1e}",
            differences[-1] < least,
            "less than that",
        )
    )
    rows.append(
        info(
            "132 nodes, step 4 ms: the same, and both errors (m/s)",
            f"{difference(RINGS[-1], TIME_STEPS[0]):.1e}; "
            + ", ".join(f"{error(RINGS[-1], TIME_STEPS[0], s):.1e}" for s in ("left", "right")),
            remark="on this mesh the step counts: nodes touch at other instants",
        )
    )
    mass = D3[RINGS[1], TIME_STEPS[0], "left"].read()["momentum_x_left"][0]
    tables = [one.read()["energy"] for one in D3.values()]
    worst = max(np.abs(energy / energy[0] - 1).max() for energy in tables)
    rows.append(
        check(
            f"max change of energy, {len(D3)} runs",
            f"{worst:.1e}",
            worst < 1e-9,
            "< 1e-9: whichever is the slave",
            exact="0",
        )
    )
    return rows + [momenta_row(D3.values(), mass)] + checks_of_runs(D3.values())


# Sliding block --------------------------------------------------------------

BLOCK_MASS = 500.0  # kg
SPEED = 2.0  # m/s, at the start on the level
UNDAMPED = ("Material/Viscosity=none", "Material/Viscosity eta=0")
SLOPE = 0.5
COS, SIN = 1 / np.hypot(1, SLOPE), SLOPE / np.hypot(1, SLOPE)


def block(key, file, until, more=(), output=QUIET):
    overrides = (*output, f"Time/Final time={until}", *more)
    return Run("S-1", key, "sliding_block", f"sliding_block/{file}.prm", overrides, cost=3)


PICTURE_STEP = 150
SMALL_MU = "Contact/Friction coefficient=0.1"
# key: friction coefficient, and whether there is viscosity
LEVEL = {
    ("0.1", True): block("level_0.1", "default", 2.4, (SMALL_MU,)),
    ("0.1", False): block("level_0.1_undamped", "default", 2.4, (SMALL_MU, *UNDAMPED)),
    ("0.3", True): block(
        "level_0.3", "default", 1.2, output=("Output/Fields every=50", "Output/Log every=0")
    ),
    ("0.3", False): block("level_0.3_undamped", "default", 1.2, UNDAMPED),
}
ON_SLOPE = {
    ("0.49", True): block("slope_0.49", "slope_slides", 1),
    ("0.51", True): block("slope_0.51", "slope_sticks", 1),
    ("0.51", False): block("slope_0.51_undamped", "slope_sticks", 1, UNDAMPED),
}
MU_COLOUR = {"0.1": "#0072B2", "0.3": "#D55E00", "0.49": "#D55E00", "0.51": "#0072B2"}


def motion(one):
    """Times (s) and the velocity of the block along the strip (m/s): means of steps."""
    table = one.read()
    values = table["momentum_x_block"] / BLOCK_MASS
    return (table["time"][1:] + table["time"][:-1]) / 2, (values[1:] + values[:-1]) / 2


def slope_of(one, first, last):
    time, values = motion(one)
    chosen = (time > first) & (time < last)
    return np.polyfit(time[chosen], values[chosen], 1)[0]


def stop(mu):
    """When a rigid block stops (s)."""
    return SPEED / (float(mu) * G)


def stopped(one):
    """From when on the block is slower than a hundredth of its first velocity (s)."""
    time, values = motion(one)
    return time[np.flatnonzero(np.abs(values) > SPEED / 100)[-1]]


def draw_block(axes, step, ghost=False):
    _, place, cells, fields = snapshot(LEVEL["0.3", True], step)
    if ghost:
        mine = cells[fields["part of cells"] == 0]
        axes.add_collection(LineCollection(place[outline(mine)], colors="0.5", linewidths=0.9))
        return None
    return draw_cells(axes, place, cells, fields["von_mises of cells"] / 1e3, 12, False)


def draw_s1():
    figure = plt.figure(figsize=(14, 8.2), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(1, 0.75))
    level, force, slope = (figure.add_subplot(grid[0, k]) for k in range(3))
    for (mu, damped), one in LEVEL.items():
        time, values = motion(one)
        style = {"color": MU_COLOUR[mu], "linewidth": 1.6 if damped else 0.8}
        text = rf"$\mu$ = {mu}" + ("" if damped else ", no viscosity")
        level.plot(time, values, linestyle="-" if damped else (0, (4, 1)), label=text, **style)
    for mu in ("0.1", "0.3"):
        level.plot([0, stop(mu)], [SPEED, 0], color="black", linestyle=(0, (1, 2)), linewidth=1)
    level.plot([], [], color="black", linestyle=(0, (1, 2)), linewidth=1, label=r"slope $-\mu g$")
    level.set_title("on the level")
    level.set_ylabel("velocity (m/s)")
    level.set_xlim(0, 2.4)
    for damped, colour in ((False, "0.6"), (True, "#D55E00")):
        table = LEVEL["0.3", damped].read()
        force.plot(
            table["time"],
            table["contact_force_block"] / (BLOCK_MASS * G),
            color=colour,
            linewidth=1,
            label="with viscosity" if damped else "no viscosity",
        )
    force.set_title(r"on the level, $\mu$ = 0.3")
    force.set_ylabel("contact force / weight")
    force.set_xlim(0, 1.2)
    for (mu, damped), one in ON_SLOPE.items():
        time, values = motion(one)
        style = {"color": MU_COLOUR[mu], "linewidth": 1.6 if damped else 0.8}
        text = rf"$\mu$ = {mu}" + ("" if damped else ", no viscosity")
        slope.plot(time, values, linestyle="-" if damped else (0, (4, 1)), label=text, **style)
    mean = slice(*np.searchsorted(motion(ON_SLOPE["0.49", True])[0], (0.2, 1)))
    time, values = (x[mean] for x in motion(ON_SLOPE["0.49", True]))
    line = values.mean() + by_hand("0.49") * (time - time.mean())
    slope.plot(
        time,
        line,
        color="black",
        linestyle=(0, (1, 2)),
        linewidth=1.2,
        label=r"$g\,(\sin\beta - \mu\cos\beta)$",
    )
    slope.set_title(r"on a slope, $\tan\beta$ = 1/2")
    slope.set_ylabel("velocity down the slope (m/s)")
    slope.set_xlim(0, 1)
    slope.set_ylim(-0.02, 0.4)
    for panel in (level, force, slope):
        panel.set_xlabel("time (s)")
        panel.legend(fontsize=8.5)
    picture = figure.add_subplot(grid[1, :])
    step = PICTURE_STEP
    drawn = draw_block(picture, step)
    draw_block(picture, 0, ghost=True)
    picture.add_patch(Rectangle((-0.05, -0.56), 4.1, 0.06, **GROUND))
    time = LEVEL["0.3", True].read()["time"][step]
    bare(picture, rf"$\mu$ = 0.3, {time:g} s (grey: at the start)", (-0.1, 4.1), (-0.6, 0.6))
    scale_bar(picture, 3.4, 0.2, 0.5)
    colour_bar(drawn, picture.inset_axes((2.6, 0.42, 0.7, 0.05), transform=picture.transData))
    return figure


def by_hand(mu):
    """The acceleration down the slope (m/s^2)."""
    return G * (SIN - float(mu) * COS)


def checks_s1():
    rows = []
    for mu in ("0.1", "0.3"):
        exact = float(mu) * G
        ours = -slope_of(LEVEL[mu, True], 0.1, 0.9 * stop(mu))
        rows.append(
            check(
                f"level, mu = {mu}: deceleration (m/s^2)",
                f"{ours:.5f}",
                abs(ours / exact - 1) < 5e-3,
                "within 0.5 %",
                exact=f"{exact:.5f}",
            )
        )
        way = LEVEL[mu, True].read()["slide_block"][-1]
        exact = SPEED**2 / (2 * float(mu) * G)
        rows.append(
            check(
                f"level, mu = {mu}: way until it stops (m)",
                f"{way:.5f}",
                abs(way / exact - 1) < 5e-3,
                "within 0.5 %",
                exact=f"{exact:.5f}",
            )
        )
        late = [stopped(LEVEL[mu, damped]) for damped in (True, False)]
        rows.append(
            check(
                f"level, mu = {mu}: stops (s) with and without viscosity",
                f"{late[0]:.3f}, {late[1]:.3f}",
                abs(late[0] / stop(mu) - 1) < 0.05 and late[1] > late[0],
                "within 5 %; later without, since it goes on vibrating",
                exact=f"{stop(mu):.3f}",
            )
        )
    ours, exact = slope_of(ON_SLOPE["0.49", True], 0.2, 1), by_hand("0.49")
    rows.append(
        check(
            "slope of 1/2, mu = 0.49: acceleration (m/s^2)",
            f"{ours:.5f}",
            abs(ours / exact - 1) < 0.02,
            "within 2 %",
            exact=f"{exact:.5f}",
        )
    )
    ours = slope_of(ON_SLOPE["0.51", True], 0.6, 1)
    rows.append(
        check(
            "slope of 1/2, mu = 0.51: acceleration from 0.6 s on (m/s^2)",
            f"{ours:.1e}",
            abs(ours) < 5e-3 * G * SIN,
            "less than 0.5 % of g sin(beta): it sticks",
            exact="0",
        )
    )
    table = ON_SLOPE["0.51", False].read()
    rows.append(
        info(
            "the same without viscosity: velocity at 1 s (m/s), part of the steps off the strip",
            f"{table['momentum_x_block'][-1] / BLOCK_MASS:.2f}, "
            f"{100 * np.mean(table['active_points_block'][1:] == 0):.0f} %",
            exact="0",
            remark="it hops, and each hop takes from the slope: it never sticks",
        )
    )
    return rows + checks_of_runs([*LEVEL.values(), *ON_SLOPE.values()])


# The figures ----------------------------------------------------------------

FIGURES = [
    Figure(
        "B-13",
        "Stent and artery: set-up and meshes at the start",
        "A longitudinal section in plane stress. The paper gives no drawing to scale. The outer "
        "side and the ends of the artery are clamped; all nodes of the lower side of the stent "
        "move towards the wall and along it, beginning and ending at rest. Contact is between "
        "the nodes of the inner wall and the facets of the upper side of the stent.",
        [DEPLOYMENT],
        draw_b13,
        checks_b13,
    ),
    Figure(
        "B-14",
        "Stent and artery: deformed meshes",
        "Persistent contact without friction and viscosity, 50 steps; von Mises stress. At the "
        "end the stent lies against the wall nearly along its whole length.",
        [DEPLOYMENT, *STENTS.values()],
        draw_b14,
        checks_b14,
        animate=animate_stent,
    ),
    Figure(
        "B-15",
        "Stent and artery: viscosity",
        "Without friction. Left: change of energy less the work of the imposed displacement, in "
        "each step; right: what viscosity has taken. The paper's viscosities have no unit.",
        list(family(etas=ETAS).values()),
        draw_b15,
        checks_b15,
    ),
    Figure(
        "B-16",
        "Stent and artery: friction",
        "Left: change of energy less the work of the imposed displacement, in each step; right: "
        "what friction and viscosity have taken. Above: without viscosity; below: with, as in the "
        "paper, whose eta = 1 has no unit.",
        list(family(MUS, ("0", ETA_WITH_FRICTION)).values()),
        draw_b16,
        checks_b16,
    ),
    Figure(
        "B-T1",
        "Stent and artery: seconds (timed)",
        "The default run on one core, beside the time that the paper states.",
        [TIMED],
        draw_t1,
        checks_t1,
        timed=True,
    ),
    Figure(
        "D-1",
        "Colliding disks: an oblique collision with friction",
        "Persistent contact, offset 1 m, mu = 0.2; von Mises stress and the resultants of the "
        "contact forces. Crosses are fixed to the disks, which spin after the collision. Bottom "
        "right: energies.",
        [OBLIQUE],
        draw_d1,
        checks_d1,
        animate=animate_disks,
    ),
    Figure(
        "D-2",
        "Colliding disks: three treatments",
        "Above: energy, and what friction has taken, for three collisions. Below: what the "
        "program prints. Energy left counts vibrations; the drift is the largest of the three "
        "momenta, over the momentum of a disk (times 1 m).",
        list(D2.values()),
        draw_d2,
        checks_d2,
    ),
    Figure(
        "D-3",
        "Colliding disks: slave and master swapped",
        "Offset 1 m, no friction, rings (6, 5), (11, 9) and (22, 18). Dots: how much the velocity "
        "after the collision changes when the other disk is the slave. Triangles: the error of "
        "each choice, measured from the mean of both on the finest mesh with the smaller step. "
        "With 4 ms the finest mesh brings nothing: there the step counts, since persistent contact "
        "is as deep as a node comes in the step in which it touches.",
        list(D3.values()),
        draw_d3,
        checks_d3,
    ),
    Figure(
        "S-1",
        "Sliding block on a strip",
        "Two elastic bodies with exact Coulomb friction. Left: on the level the block is slowed "
        "down by mu g. Middle: the weight is there at once; without viscosity what it excites "
        "stays. Right: a slope of 1/2, with friction just below and just above it; without "
        "viscosity the block hops and never sticks. Below: the block and the strip, with von Mises "
        "stress.",
        [*LEVEL.values(), *ON_SLOPE.values()],
        draw_s1,
        checks_s1,
    ),
]
