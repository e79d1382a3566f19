# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the figures of papers A and B share: methods, positions of the impact, checks.

A: Barboteu, Bonaldi, Danan and El-Hadri, improved normal compliance.
B: the hyper-viscoelastic model with persistent contact.

Where within a step the body touches changes what a method does at the impact. A
figure that compares methods therefore shows a band over ten positions around the
curve of the parameter file, whose impact falls in the middle of a step.
"""

import re
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import vtu
from report import check, info, note
from runs import Run

SPEED = 10.0  # m/s, of both bodies towards the foundation

# Ten positions of the impact, as parts of a step.
POSITIONS = tuple(round(0.05 + 0.1 * i, 2) for i in range(10))


@dataclass(frozen=True)
class Method:
    """A contact method: the end of its parameter file's name, label, name in tables."""

    key: str
    label: str
    colour: str
    name: str


SIGNORINI = Method("signorini", "Signorini, quasi-Lagrangian", "#000000", "Signorini")
SNC = Method("snc", "standard normal compliance", "#E69F00", "SNC")
EMM = Method("emm", "Signorini, equivalent mass matrix", "#CC79A7", "EMM")
TWO_STEP = Method("two_step", "two steps (Ayyad-Barboteu)", "#56B4E9", "two-step")
HAURET = Method("hauret", "Hauret-Le Tallec", "#009E73", "Hauret")
PERSISTENT = Method("persistent", "persistent contact, leapfrog", "#D55E00", "persistent")
INC = {
    2: Method("inc2", r"improved normal compliance, $\alpha = 2$", "#0072B2", "INC alpha = 2"),
    3: Method("inc3", r"improved normal compliance, $\alpha = 3$", "#009E73", "INC alpha = 3"),
    4: Method("inc4", r"improved normal compliance, $\alpha = 4$", "#CC79A7", "INC alpha = 4"),
    5: Method("inc5", r"improved normal compliance, $\alpha = 5$", "#D55E00", "INC alpha = 5"),
}

# Colours of a parameter, from small to large.
SCALE = ("#56B4E9", "#0072B2", "#009E73", "#E69F00", "#D55E00", "#882255")


# Runs -----------------------------------------------------------------------


def gap(steps, position, time_step):
    """The initial gap (m) for an impact `position` of a step after so many steps."""
    return round((steps + position) * SPEED * time_step, 12)


def band(run, steps, time_step, cost):
    """The runs that differ from this one by the position of the impact."""
    return [
        Run(
            run.figure,
            f"{run.curve}_at_{position}",
            run.program,
            run.parameter_file,
            (*run.overrides, f"Start/Initial gap={gap(steps, position, time_step):g}"),
            cost=cost,
        )
        for position in POSITIONS
    ]


def touch(run, default):
    """The time (s) of the first touch of a run, were it to fly on."""
    for override in run.overrides:
        name, value = override.split("=")
        if name == "Start/Initial gap":
            return float(value) / SPEED
    return default / SPEED


# Numbers --------------------------------------------------------------------


def energy(run, column="energy"):
    """Energy of each step, relative to the start."""
    table = run.read()
    return table[column] / table["energy"][0]


def lost(run):
    """Part of the energy that is gone at the end."""
    return 1 - energy(run)[-1]


def dip(run):
    """Part of the energy that is gone when it is least."""
    return 1 - energy(run).min()


def penetration(run):
    return run.read()["penetration_foundation"].max()


def span(values, form="{:.2e}"):
    """The range of some numbers, as text."""
    return f"{form.format(min(values))} to {form.format(max(values))}"


def percent(values):
    return span([100 * value for value in values], "{:.2f}") + " %"


# Timing ---------------------------------------------------------------------


def timing_of_steps(run):
    """Seconds in the steps of a run, without its start, and their number."""
    text = (run.folder / "log.txt").read_text(encoding="utf-8")
    calls, seconds = re.search(r"^\| steps +\| +(\d+) \| +([0-9.e+-]+)s", text, re.M).groups()
    return float(seconds), int(calls)


def timing_exponent(dofs, seconds, last=3):
    """Slope of log(seconds) against log(degrees of freedom), on the finest meshes."""
    return np.polyfit(np.log(dofs[-last:]), np.log(seconds[-last:]), 1)[0]


# Drawing --------------------------------------------------------------------


def energy_axes(columns=1, **keywords):
    """Axes for the energy relative to the start."""
    figure, axes = plt.subplots(
        1, columns, figsize=(7.5 if columns == 1 else 6 * columns, 4.6), squeeze=False, **keywords
    )
    for panel in axes[0]:
        panel.axhline(1, color="0.6", linewidth=0.7, zorder=1)
    axes[0, 0].set_ylabel(r"energy / initial energy")
    return figure, axes[0] if columns > 1 else axes[0, 0]


def curve(axes, run, values, start, colour, label, scale=1e3, **keywords):
    """A quantity against the time since the first touch."""
    time = scale * (run.read()["time"] - touch(run, start))
    axes.plot(time, values(run), color=colour, label=label, zorder=3, **keywords)


def fill(axes, runs, values, start, colour, scale=1e3):
    """The band that a quantity covers over the positions of the impact."""
    tables = [(scale * (run.read()["time"] - touch(run, start)), values(run)) for run in runs]
    first = max(time[0] for time, _ in tables)
    last = min(time[-1] for time, _ in tables)
    common = np.linspace(first, last, 500)
    lines = [np.interp(common, *table) for table in tables]
    axes.fill_between(
        common, np.min(lines, axis=0), np.max(lines, axis=0), color=colour, alpha=0.18, linewidth=0
    )


def table_image(header, rows, widths=None):
    """A table as a matplotlib figure."""
    figure, axes = plt.subplots(figsize=(2.0 * len(header), 0.42 * (len(rows) + 1)))
    axes.axis("off")
    table = axes.table(
        cellText=rows, colLabels=header, loc="center", cellLoc="center", colWidths=widths
    )
    table.auto_set_font_size(False)
    table.set_fontsize(9)
    table.scale(1, 1.5)
    for (row, _), cell in table.get_celld().items():
        cell.set_edgecolor("0.8")
        if row == 0:
            cell.set_facecolor("0.93")
            cell.set_text_props(weight="bold")
    return figure


def body(axes, path, stretch=1.0, arrow=1.0, stress=False, limit=None):
    """A deformed body with its contact forces, from a VTU file.

    `stretch` multiplies the displacement apart from its mean, `arrow` is the length of
    an arrow in m per N. Returns the total force and what maps colours, if any.
    """
    points, cells, fields = vtu.read(path)
    displacement = fields["displacement"][:, :2]
    mean = displacement.mean(axis=0)
    place = points + mean + stretch * (displacement - mean)
    drawn = PolyCollection(place[cells], linewidth=0.15, edgecolor="0.45", facecolor="#dbe7f3")
    if stress:
        s = fields["stress of cells"].reshape(-1, 3, 3)
        trace = np.einsum("nii->n", s)
        deviator = np.einsum("nij,nij->n", s, s) - trace**2 / 3
        drawn.set_array(np.sqrt(1.5 * np.maximum(deviator, 0)))
        drawn.set_cmap("viridis")
        drawn.set_clim(0, limit)
    axes.add_collection(drawn)
    force = fields["contact_force"][:, :2].astype(float)
    pushed = np.abs(force).sum(axis=1) > 0
    if pushed.any():
        tips = place[pushed] + arrow * force[pushed]
        for foot, tip in zip(place[pushed], tips):
            axes.annotate(
                "",
                xy=tip,
                xytext=foot,
                arrowprops={"arrowstyle": "-|>", "color": "#D55E00", "linewidth": 1.3},
                zorder=4,
            )
    axes.axhline(0, color="black", linewidth=1.5)
    axes.set_aspect("equal")
    return force.sum(axis=0), drawn


# Checks that several figures share ------------------------------------------


def statement(quantity, ours, holds, criterion, paper, reason):
    """A statement of a paper: a check, or a note with the reason if it does not hold."""
    if holds:
        return check(quantity, ours, True, criterion, paper)
    return note(quantity, ours, reason, paper)


def checks_of_runs(runs, tolerance=1e-9, criterion="< 1e-9 of the energy"):
    """What must hold in each run, whatever the method."""
    runs = list({run.folder: run for run in runs}.values())
    # Newton's tolerance is 1e-12 of the forces; stiff contact multiplies it.
    residual = max(np.abs(run.read()["balance_residual"]).max() for run in runs)
    # The column of halvings counts from the start.
    halvings = sum(int(run.read()["step_halvings"].max()) for run in runs)
    return [
        check(
            f"max |balance residual|, {len(runs)} runs",
            f"{residual:.1e}",
            residual < tolerance,
            criterion,
            exact="0",
        ),
        check(
            f"step halvings, {len(runs)} runs", f"{halvings}", halvings == 0, "none", exact="0"
        ),
    ]


def constant_row(name, runs, column="energy", paper="conserved"):
    """The energy of a conserving method stays where it was."""
    runs = [runs] if isinstance(runs, Run) else list(runs)
    worst = max(np.abs(energy(run, column) - 1).max() for run in runs)
    what = "energy" if column == "energy" else "energy and contact potential"
    return check(
        f"{name}: max change of {what}",
        f"{worst:.1e}",
        worst < 1e-9,
        "< 1e-9: Newton's tolerance, summed over the steps",
        paper,
        "0",
    )


def recovered_row(name, runs):
    """The energy of a compliance law is back whenever no point penetrates."""
    runs = [runs] if isinstance(runs, Run) else list(runs)
    worst, after = 0.0, []
    for run in runs:
        values = energy(run)
        free = np.flatnonzero(run.read()["active_points_foundation"] == 0)
        worst = max(worst, np.abs(values[free] - 1).max())
        after.append(free[-1] > values.argmin())
    return check(
        f"{name}: energy lost when there is no contact",
        f"{worst:.1e}",
        worst < 1e-9 and all(after),
        "< 1e-9, also after the deepest dip of each run",
        "0",
        "0",
    )


def dissipative_row(name, runs, column="energy", tolerance=1e-12):
    """The energy of a method with friction or viscosity never rises."""
    runs = [runs] if isinstance(runs, Run) else list(runs)
    rise = max(np.diff(energy(run, column)).max() for run in runs)
    what = "energy" if column == "energy" else "energy and contact potential"
    return check(
        f"{name}: largest rise of {what} in a step",
        f"{rise:.1e}",
        rise <= tolerance,
        f"at most {tolerance:g} of the initial energy",
        "only falls",
        "<= 0",
    )


def loses_row(name, runs, paper, bounds=None, criterion=""):
    """Energy lost over the positions, with bounds for the whole range or without."""
    losses = [lost(run) for run in runs]
    ours = percent(losses)
    if bounds is None:
        return info(f"{name}: energy lost", ours, paper)
    passed = min(losses) >= bounds[0] and max(losses) <= bounds[1]
    return check(f"{name}: energy lost", ours, passed, criterion, paper)


def order_row(quantity, values, criterion, paper, form="{:.2f} %", rising=True):
    """Numbers that must rise (or fall) strictly from each to the next."""
    steps = np.diff(values) if rising else -np.diff(values)
    ours = ", ".join(form.format(value) for value in values)
    return check(quantity, ours, bool((steps > 0).all()), criterion, paper)


def momentum_row(runs):
    """Without friction no force acts along the foundation."""
    worst = 0.0
    for run in runs:
        table = run.read()
        size = np.hypot(table["momentum_x"][0], table["momentum_y"][0])
        worst = max(worst, np.abs(table["momentum_x"] - table["momentum_x"][0]).max() / size)
    return check(
        "max change of momentum along the foundation",
        f"{worst:.1e}",
        worst < 1e-9,
        "< 1e-9 of the initial momentum",
        exact="0",
    )


def factor_row(name, values, paper, reason):
    """Whether some of the values is within a factor of two of the paper's."""
    return statement(
        f"largest penetration, {name} (m)",
        span(values),
        min(values) <= 2 * paper and max(values) >= paper / 2,
        "some position within a factor of two",
        f"{paper:.2e}",
        reason,
    )


def cost_checks(methods, runs, family, paper):
    """Cost of a step against degrees of freedom, on meshes of one family."""
    rows = []
    dofs = [2 * nodes for nodes in family.values()]
    for method in methods:
        timings = [timing_of_steps(runs[method.key, n]) for n in family]
        for n, (seconds, steps), cpu in zip(family, timings, paper[method.key]):
            rows.append(
                info(
                    f"{method.name}, {n} nodes on the circle: steps (s), a step (ms)",
                    f"{seconds:.3g}, {1e3 * seconds / steps:.3g}",
                    f"{cpu:g} s",
                )
            )
        seconds = [t[0] for t in timings]
        slope = timing_exponent(dofs, seconds, last=len(dofs))
        theirs = timing_exponent(dofs, paper[method.key], last=len(dofs))
        rows.append(
            check(
                f"{method.name}: exponent of the cost in degrees of freedom, all meshes",
                f"{slope:.2f}",
                slope < 1.3,
                "< 1.3",
                f"{theirs:.2f}",
            )
        )
        rows.append(
            info(
                f"{method.name}: the same, three finest meshes",
                f"{timing_exponent(dofs, seconds):.2f}",
                f"{timing_exponent(dofs, paper[method.key]):.2f}",
            )
        )
    finest = {m.key: timing_of_steps(runs[m.key, list(family)[-1]])[0] for m in methods}
    ratio = finest["inc3"] / finest["snc"]
    theirs = paper["inc3"][-1] / paper["snc"][-1]
    rows.append(
        check(
            "finest mesh, INC over SNC, both with alpha = 3",
            f"{ratio:.2f}",
            ratio < 1.3,
            "< 1.3",
            f"{theirs:.2f}",
        )
    )
    ratio = finest["signorini"] / finest["persistent"]
    theirs = paper["signorini"][-1] / paper["persistent"][-1]
    rows.append(
        statement(
            "finest mesh, Signorini multipliers over persistent contact",
            f"{ratio:.2f}",
            ratio > 1,
            "more than 1",
            f"{theirs:.1f}",
            "a sparse direct solver takes the few multipliers of the active nodes in its stride",
        )
    )
    return rows
