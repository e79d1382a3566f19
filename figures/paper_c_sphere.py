# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures 16 to 19 and table 1 of paper C: the sphere in three dimensions.

The reference times and forces are those of a run of the paper's reference tool
(GetFEM) with the same steps on the mesh with curved cells; the force of the hard sphere
on straight ones, which figure 17 shows besides, is one of its runs on those.
"""

import pathlib
import sys
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

from paper_ab_common import checks_of_runs, statement, table_image
from report import Figure, check, info
from runs import OUTPUT, Run

from ricochet.screen import run_with_screen

RADIUS, SPEED = 20.0, np.sqrt(2 * 0.1 * 2)  # of the sphere, and at the impact


@dataclass(frozen=True)
class Scheme:
    """A row of table 1: the end of its parameter files' names, label, colour."""

    key: str
    label: str
    colour: str
    iterations: int  # the paper's total


NITSCHE = (
    Scheme("nitsche_cn", "Nitsche, Crank-Nicolson", "#000000", 1129),
    Scheme("nitsche_hht", r"Nitsche, HHT $\alpha = 0.05$", "#0072B2", 1121),
    Scheme("nitsche_trbdf2", "Nitsche, TR-BDF2", "#D55E00", 2079),
    Scheme("hybrid", "Nitsche-hybrid", "#009E73", 7452),
)
AUGMENTED = (
    Scheme("alm_cn", "ALM, Crank-Nicolson", "#000000", 1181),
    Scheme("alm_hht", r"ALM, HHT $\alpha = 0.05$", "#0072B2", 1111),
    Scheme("alm_trbdf2", "ALM, TR-BDF2", "#D55E00", 2076),
)
SCHEMES = NITSCHE + AUGMENTED


@dataclass(frozen=True)
class Sphere:
    """Soft or hard: figure, moment of the picture, what the reference shows."""

    name: str
    number: int  # of the figure
    time_step: float
    picture: float
    # The reference: touches from .. to, touches again, largest force of the first bounce.
    on: float
    off: float
    again: float
    force: float
    straight_force: float
    first_bounce: float  # s, when the first bounce is over for certain

    def run(self, scheme):
        step = round(self.picture / self.time_step)
        every = step if scheme.key == "nitsche_hht" else 0
        return Run(
            f"C-{self.number}",
            scheme.key,
            "sphere",
            f"sphere/figure_{self.number}_{scheme.key}.prm",
            (f"Output/Fields every={every}", "Output/Log every=0"),
            cost=25.0 if scheme.key.endswith("trbdf2") else 18.0,
        )

    @property
    def runs(self):
        return {scheme.key: self.run(scheme) for scheme in SCHEMES}


SOFT = Sphere("soft", 16, 0.25, 16.0, 6.5, 28.25, 40.0, 1.08e4, 1.07e4, 33.0)
HARD = Sphere("hard", 17, 0.05, 6.8, 6.35, 7.5, 20.1, 7.4e4, 6.68e4, 12.0)
SPHERES = (SOFT, HARD)
CURVED = Run(
    "C-17",
    "curved",
    "sphere",
    "sphere/figure_17_curved.prm",
    ("Output/Fields every=0", "Output/Log every=0"),
    cost=18.0,
)


# Numbers --------------------------------------------------------------------


def conserved(table):
    """What a scheme should keep: modified energy without the work of gravity."""
    return table["modified_energy"] - table["external_work"]


def change_of_energy(table):
    """Its change at the end and its largest gain in a step, of the largest energy."""
    scale = np.abs(table["energy"]).max()
    kept = conserved(table)
    return (kept[-1] - kept[0]) / scale, np.diff(kept).max() / scale


def touches(table):
    """First touch, lift-off (after the whole first bounce), next touch (s)."""
    time, touching = table["time"], table["contact_force_foundation"] > 0
    starts = time[1:][touching[1:] & ~touching[:-1]]
    ends = time[1:][~touching[1:] & touching[:-1]]
    # In the bounce of a hard body points may open for a step.
    gap = np.diff(starts).argmax()
    return starts[0], ends[ends < starts[gap + 1]][-1], starts[gap + 1]


def peak(table, until):
    """The largest force of the first bounce, and when."""
    first = table["time"] < until
    k = table["contact_force_foundation"][first].argmax()
    return table["contact_force_foundation"][k], table["time"][k]


def variation(table):
    """How much the velocity of the lowest point goes up and down."""
    return np.abs(np.diff(table["lowest_velocity"])).sum()


def hertz_force(lame, density=1.0):
    """The largest force when an elastic sphere falls, by Hertz's quasi-static theory."""
    modulus = 4 * lame * (2 * lame) / (3 * lame)  # E / (1 - nu^2), lambda = mu
    stiffness = 4 / 3 * modulus * np.sqrt(RADIUS)
    mass = density * 4 / 3 * np.pi * RADIUS**3
    approach = (1.25 * mass * SPEED**2 / stiffness) ** 0.4
    return stiffness * approach**1.5


# Figures 16 and 17: series --------------------------------------------------

QUANTITIES = (
    ("lowest_displacement", "displacement of the lowest point (m)"),
    ("lowest_velocity", "velocity of the lowest point (m/s)"),
    ("contact_force_foundation", "contact force (N)"),
    (None, "modified energy less work of gravity (J)"),
)


def draw_series(sphere):
    figure, axes = plt.subplots(4, 2, figsize=(13, 14), sharex=True)
    for column, schemes in enumerate((NITSCHE, AUGMENTED)):
        for row, (name, label) in enumerate(QUANTITIES):
            panel = axes[row, column]
            for scheme in schemes:
                table = sphere.runs[scheme.key].read()
                values = table[name] if name else conserved(table)
                panel.plot(
                    table["time"], values, color=scheme.colour, label=scheme.label, linewidth=0.9
                )
            if sphere is HARD and column == 0:
                table = CURVED.read()
                values = table[name] if name else conserved(table)
                panel.plot(
                    table["time"],
                    values,
                    color="#CC79A7",
                    label="Nitsche, Crank-Nicolson, curved cells",
                    linewidth=0.9,
                )
            panel.set_ylabel(label)
        axes[0, column].legend(loc="upper center", ncol=2, fontsize=9)
        axes[-1, column].set_xlabel("time (s)")
    figure.tight_layout()
    return figure


def checks_series(sphere):
    rows = []
    # A step; the facets of the mesh and the quadrature points on them leave 0.1 s
    # open when a hard body touches.
    slack = (0.25, 0.375, 0.5) if sphere is SOFT else (0.16, 0.2, 0.5)
    for scheme in SCHEMES:
        times = touches(sphere.runs[scheme.key].read())
        reference = (sphere.on, sphere.off, sphere.again)
        rows.append(
            check(
                f"{scheme.label}: touches, lifts off, touches again (s)",
                ", ".join(f"{t:g}" for t in times),
                all(abs(a - b) <= s + 1e-9 for a, b, s in zip(times, reference, slack)),
                "within " + ", ".join(f"{s:g}" for s in slack) + " s of the reference run",
                paper=", ".join(f"{t:g}" for t in reference),
            )
        )
    for scheme in SCHEMES:
        force, time = peak(sphere.runs[scheme.key].read(), sphere.first_bounce)
        if sphere is SOFT:
            rows.append(
                check(
                    f"{scheme.label}: largest force of the first bounce (N), at (s)",
                    f"{force:.4g}, {time:g}",
                    abs(force / sphere.force - 1) < 0.03,
                    "within 3 %",
                    paper=f"{sphere.force:.4g}",
                )
            )
        else:
            exact = hertz_force(30000.0)
            # The reference has a run of this scheme alone.
            if scheme.key == "nitsche_cn":
                rows.append(
                    check(
                        f"{scheme.label}, straight cells: largest force (N)",
                        f"{force:.4g}",
                        abs(force / sphere.straight_force - 1) < 0.03,
                        "within 3 % of the reference on the same mesh",
                        paper=f"{sphere.straight_force:.4g}",
                    )
                )
            rows.append(
                check(
                    f"{scheme.label}: largest force of the first bounce (N), at (s)",
                    f"{force:.4g}, {time:g}",
                    abs(force / exact - 1) < 0.08,
                    "within 8 % of Hertz: a few facets carry it",
                    exact=f"{exact:.4g}",
                )
            )
    for scheme in SCHEMES:
        total, gain = change_of_energy(sphere.runs[scheme.key].read())
        name = f"{scheme.label}: conserved energy, change and largest gain in a step"
        ours = f"{total:.1e}, {gain:.1e}"
        if scheme.key == "hybrid":
            rows.append(check(name, ours, gain < 1e-11, "no gain beyond Newton's tolerance"))
        elif scheme.key.endswith("_cn"):
            rows.append(info(name, ours, remark="what it gains and loses at contact changes"))
        else:
            rows.append(
                check(name, ours, -0.02 < total < 0, "loses, and at most 2 % of the energy")
            )
    if sphere is HARD:
        table = CURVED.read()
        force, time = peak(table, sphere.first_bounce)
        times = touches(table)
        rows.append(
            check(
                "curved cells: largest force of the first bounce (N), at (s)",
                f"{force:.4g}, {time:g}",
                abs(force / sphere.force - 1) < 0.02 and abs(time - 6.9) < 0.051,
                "within 2 % of the reference, and a step of its time",
                paper=f"{sphere.force:.4g}, 6.9",
            )
        )
        rows.append(
            check(
                "curved cells: touches, lifts off, touches again (s)",
                ", ".join(f"{t:g}" for t in times),
                all(
                    abs(a - b) < 0.101
                    for a, b in zip(times, (sphere.on, sphere.off, sphere.again))
                ),
                "within 0.1 s of the reference run",
                paper=f"{sphere.on:g}, {sphere.off:g}, {sphere.again:g}",
            )
        )
    values = {key: variation(run.read()) for key, run in sphere.runs.items()}
    for method in ("nitsche", "alm"):
        rows.append(
            statement(
                f"{method}: variation of the velocity, TR-BDF2 and HHT (m/s)",
                f"{values[f'{method}_trbdf2']:.3g}, {values[f'{method}_hht']:.3g}",
                values[f"{method}_trbdf2"] < values[f"{method}_hht"],
                "TR-BDF2 is smoother",
                "TR-BDF2 smoother",
                "not here",
            )
        )
    rows.append(
        check(
            "variation of the velocity, hybrid over TR-BDF2",
            f"{values['hybrid'] / values['nitsche_trbdf2']:.3g}",
            values["hybrid"] > 2 * values["nitsche_trbdf2"],
            "more than 2",
            paper="strong oscillations",
        )
    )
    return rows + checks_of_runs(
        list(sphere.runs.values()) + ([CURVED] if sphere is HARD else [])
    )


# Figure 18: pictures --------------------------------------------------------


def picture(sphere, field):
    """An image of the deformed sphere, coloured by a field, drawn by VTK."""
    step = round(sphere.picture / sphere.time_step)
    file = sphere.runs["nitsche_hht"].folder / "solution" / f"step-{step:06d}.vtu"
    target = OUTPUT / "figures" / f"C-18_{sphere.name}_{field}.png"
    script = pathlib.Path(__file__).with_name("render_sphere.py")
    run_with_screen([sys.executable, str(script), str(file), field, str(target)])
    return plt.imread(target)


def draw_18():
    figure, axes = plt.subplots(2, 2, figsize=(12, 9.6))
    for column, sphere in enumerate(SPHERES):
        for row, (field, label) in enumerate(
            (("von_mises", "von Mises stress"), ("contact_pressure", "contact pressure, from below"))
        ):
            axes[row, column].imshow(picture(sphere, field))
            axes[row, column].axis("off")
            axes[row, column].set_title(f"{sphere.name}, t = {sphere.picture:g} s: {label} (Pa)")
    figure.tight_layout()
    return figure


def checks_18():
    rows, active = [], []
    for sphere in SPHERES:
        table = sphere.runs["nitsche_hht"].read()
        k = np.abs(table["time"] - sphere.picture).argmin()
        active.append(table["active_points_foundation"][k])
        rows.append(
            info(
                f"{sphere.name}, t = {sphere.picture:g} s: contact force (N), active points",
                f"{table['contact_force_foundation'][k]:.4g}, "
                f"{active[-1]:.0f}",
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


# Figure 19 and table 1: iterations ------------------------------------------


def draw_19():
    figure, axes = plt.subplots(1, 2, figsize=(13, 4.6), sharey=True)
    for panel, (first, last) in zip(axes, ((0, 60), (6, 29))):
        for scheme in NITSCHE:
            table = SOFT.runs[scheme.key].read()
            panel.step(
                table["time"],
                table["newton_iterations"],
                where="pre",
                color=scheme.colour,
                label=scheme.label,
                linewidth=0.9,
            )
        panel.set_xlim(first, last)
        panel.set_xlabel("time (s)")
    axes[0].set_ylabel("Newton iterations in a step")
    axes[0].legend(fontsize=9)
    figure.tight_layout()
    return figure


def checks_19():
    rows = []
    for scheme, most, paper in zip(
        NITSCHE, (5, 5, 8, 8), ("4, at most 5", "4, at most 5", "6, at most 8", "more than 25")
    ):
        table = SOFT.runs[scheme.key].read()
        touching = table["contact_force_foundation"] > 0
        counts = table["newton_iterations"][touching]
        rows.append(
            check(
                f"{scheme.label}: iterations in contact, mean and most",
                f"{counts.mean():.2f}, {counts.max():.0f}",
                counts.max() <= most,
                f"at most {most}",
                paper=paper,
            )
        )
    return rows


def paper_ratio(scheme):
    return scheme.iterations / NITSCHE[0].iterations


def totals(sphere):
    """Iterations of each run, and their ratio to those of Nitsche, Crank-Nicolson."""
    counts = {key: run.read()["newton_iterations"].sum() for key, run in sphere.runs.items()}
    return counts, {key: count / counts["nitsche_cn"] for key, count in counts.items()}


def draw_table_1():
    rows = []
    of_spheres = [totals(sphere) for sphere in SPHERES]
    for scheme in SCHEMES:
        row = [scheme.label, f"{scheme.iterations}", f"{paper_ratio(scheme):.2f}"]
        for counts, ratios in of_spheres:
            row += [f"{counts[scheme.key]:.0f}", f"{ratios[scheme.key]:.2f}"]
        rows.append(row)
    header = ["", "paper", "ratio", "soft", "ratio", "hard", "ratio"]
    return table_image(header, rows, [0.28, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1])


def checks_table_1():
    rows = []
    ratios_of_spheres = [totals(sphere)[1] for sphere in SPHERES]
    for scheme in SCHEMES:
        ours = [ratios[scheme.key] for ratios in ratios_of_spheres]
        paper = paper_ratio(scheme)
        rows.append(
            check(
                f"{scheme.label}: iterations over those of Nitsche, Crank-Nicolson, soft and hard",
                f"{ours[0]:.2f}, {ours[1]:.2f}",
                max(ours) < 1.2 * paper,
                "at most 1.2 times the paper's ratio",
                paper=f"{paper:.2f}",
            )
        )
    return rows


def series_figure(sphere):
    return Figure(
        f"C-{sphere.number}",
        f"Sphere: {sphere.name}, two bounces",
        "Displacement and velocity of the lowest point, contact force, and the energy that a "
        "scheme should keep, with Nitsche's method (left) and the augmented Lagrangian (right). "
        "14112 unknowns. The column paper holds the reference run, which was on curved cells"
        + (": so is one of the curves." if sphere is HARD else "."),
        list(sphere.runs.values()) + ([CURVED] if sphere is HARD else []),
        lambda: draw_series(sphere),
        lambda: checks_series(sphere),
    )


ALL_RUNS = [run for sphere in SPHERES for run in sphere.runs.values()]

FIGURES = [
    series_figure(SOFT),
    series_figure(HARD),
    Figure(
        "C-18",
        "Sphere: stress and contact pressure",
        "Deformed, with Nitsche's method and HHT (alpha = 0.05): the soft sphere at t = 16 s, the "
        "hard one at 6.8 s. A quarter is cut out above; below, the sphere is seen from below.",
        [sphere.runs["nitsche_hht"] for sphere in SPHERES],
        draw_18,
        checks_18,
    ),
    Figure(
        "C-19",
        "Sphere: Newton iterations in each step",
        "Soft sphere; on the right the first contact. In free flight a stage takes one iteration, "
        "since the equations are linear and the predicted state is not taken for the solution.",
        [SOFT.runs[scheme.key] for scheme in NITSCHE],
        draw_19,
        checks_19,
    ),
    Figure(
        "C-T1",
        "Sphere: Newton iterations of the schemes",
        "Totals of a run and their ratio to Crank-Nicolson with Nitsche's method. Seconds: "
        "benchmarks/README.md.",
        ALL_RUNS,
        draw_table_1,
        checks_table_1,
    ),
]
