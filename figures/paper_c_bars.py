# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paper C (Huang, Pignet, Drouet and Chouly), figures 6 to 10 and 13 to 15: bars.

1D-SD (section 4.1) is a bar held at its right end that hits an obstacle with its
left end; 1D-SS (section 4.2) flies to and fro between two obstacles. Each figure
has the consistent ("standard") mass on the left and the redistributed one on the
right.
"""

from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

from report import Figure, check, info, note
from runs import QUIET, Run

FINAL_TIME = 12.0  # s
TIME_STEP = 0.05  # s
GAMMA_N = 5 / 0.05  # Pa/m, gamma_0/h

MASSES = ("consistent", "redistributed")
BLUE, ORANGE = "#0072B2", "#D55E00"


# Exact solutions ------------------------------------------------------------


@dataclass(frozen=True)
class End:
    """Exact motion of an end of the bar: piecewise linear and periodic.

    It is written down here from the characteristics, apart from the program's
    own, so that one checks the other.
    """

    name: str
    displacement: tuple  # m, at t = 0, 1, ..., period
    pressure: tuple  # Pa, constant between these times

    @property
    def period(self):
        return len(self.pressure)

    @property
    def velocity(self):
        return np.diff(self.displacement)

    def displacement_at(self, time):
        return np.interp(np.mod(time, self.period), range(self.period + 1), self.displacement)

    def piecewise(self, values, time):
        return np.asarray(values)[np.floor(np.mod(time, self.period)).astype(int)]

    def steps(self, values):
        """Corners of the graph of a piecewise constant function, with its jumps."""
        n = int(FINAL_TIME)
        return np.repeat(np.arange(n + 1), 2)[1:-1], np.repeat(np.resize(values, n), 2)


@dataclass(frozen=True)
class Bar:
    """A benchmark: its program, its exact solution."""

    name: str
    program: str
    ends: tuple
    energy: float  # J, at all times

    # In both benchmarks the initial strain -1/2 stands at the free left end,
    # where the exact solution drops it at once. Nitsche's modified energy
    # starts with this inconsistency: C (13) gives E - sigma_n^2/(2 gamma_N).
    @property
    def initial_modified_energy(self):
        return self.energy - 0.5**2 / (2 * GAMMA_N)


SD = Bar("1D-SD", "bar_sd", (End("left", (0.5, 0, 0, 0.5), (0, 0.5, 0)),), 1 / 8)
SS = Bar(
    "1D-SS",
    "bar_ss",
    (
        End("left", (1, 0, 0, 0, 0, 1, 1), (0, 0, 1, 0, 0, 0)),
        End("right", (0.5, 0.5, -0.5, -0.5, 0.5, 0.5, 0.5), (0, 0, 0, 0, 0, 1)),
    ),
    1 / 4,
)


# The runs -------------------------------------------------------------------



@dataclass(frozen=True)
class Curve:
    """A method in a figure: the name in its parameter files, label, colour."""

    key: str
    label: str
    colour: str


TREATMENTS = (Curve("nitsche", "Nitsche", BLUE), Curve("penalty", "penalty", ORANGE))
ALPHAS = (
    Curve("alpha_0.05", r"Nitsche, $\tilde\alpha = 0.05$", BLUE),
    Curve("alpha_-0.02", r"Nitsche, $\tilde\alpha = -0.02$", ORANGE),
)

# Names of the curves in the tables.
PLAIN = {
    "nitsche": "Nitsche",
    "penalty": "penalty",
    "alpha_0.05": "alpha = 0.05",
    "alpha_-0.02": "alpha = -0.02",
}


def bar_run(bar, number, curve, mass=None):
    key = curve.key + (f"_{mass}" if mass else "")
    return Run(
        f"C-{number}",
        key,
        bar.program,
        f"{bar.program}/figure_{number:02}_{key}.prm",
        overrides=QUIET,
    )


def bar_runs(bar, number, curves):
    """The runs of a figure by curve and mass."""
    return {
        (curve.key, mass): bar_run(bar, number, curve, mass) for curve in curves for mass in MASSES
    }


# Drawing --------------------------------------------------------------------


def _exact(axes, time, values):
    axes.plot(time, values, color="black", linewidth=2.2, alpha=0.9, label="exact", zorder=2)


def draw_panels(bar, curves, runs):
    """Motion of the ends, contact pressure and energy; a column for each mass."""
    rows = [
        (quantity, end)
        for quantity in ("displacement", "velocity", "pressure")
        for end in bar.ends
    ] + [("energy", None)]
    figure, axes = plt.subplots(
        len(rows), 2, figsize=(12, 2.3 * len(rows)), sharex=True, sharey="row", squeeze=False
    )
    units = {"displacement": "m", "velocity": "m/s", "pressure": "Pa", "energy": "J"}
    for column, mass in enumerate(MASSES):
        tables = [runs[curve.key, mass].read() for curve in curves]
        axes[0, column].set_title(f"{mass} mass")
        axes[-1, column].set_xlabel("time (s)")
        for row, (quantity, end) in enumerate(rows):
            panel = axes[row, column]
            if quantity == "displacement":
                time = np.arange(FINAL_TIME + 1)
                _exact(panel, time, end.displacement_at(time))
                name = f"displacement_{end.name}"
            elif quantity == "velocity":
                _exact(panel, *end.steps(end.velocity))
                name = f"velocity_{end.name}"
            elif quantity == "pressure":
                # The paper plots -sigma_n(u_h), not the pressure of the method.
                _exact(panel, *end.steps(end.pressure))
                name = f"stress_pressure_{end.name}"
            else:
                _exact(panel, [0, FINAL_TIME], [bar.energy] * 2)
                name = "modified_energy"
            for curve, table in zip(curves, tables):
                # The second curve is dashed, for prints without colour.
                panel.plot(
                    table["time"],
                    table[name],
                    color=curve.colour,
                    linestyle="-" if curve is curves[0] else (0, (4, 1.2)),
                    linewidth=1.1,
                    label=curve.label,
                    zorder=3,
                )
            if column == 0:
                title = {"pressure": "contact pressure", "energy": "modified energy"}
                where = f"{end.name} end " if end and len(bar.ends) > 1 else ""
                panel.set_ylabel(f"{title.get(quantity, quantity)}\n{where}({units[quantity]})")
    axes[0, 0].set_xlim(0, FINAL_TIME)
    figure.align_ylabels()
    figure.legend(
        *axes[0, 0].get_legend_handles_labels(),
        loc="lower center",
        bbox_to_anchor=(0.5, 0.99),
        ncol=3,
        fontsize=11,
    )
    figure.tight_layout()
    return figure


# Checks that several figures share ------------------------------------------


def _worst(runs, value):
    return max(value(run.read()) for run in runs)


def checks_of_runs(bar, runs):
    """What must hold in each run, whatever the scheme."""
    tables = [run.read() for run in runs]
    # Newton's tolerance; round-off is a thousand times less at h = 0.05, and
    # about half of it on the finest mesh of figure 10.
    residual = max(np.abs(table["balance_residual"]).max() for table in tables)
    halvings = sum(table["step_halvings"].sum() for table in tables)

    # At a jump (whole seconds) the value is a matter of taste, so look between.
    deviation = 0.0
    for table in tables:
        time = table["time"]
        between = np.abs(time - np.round(time)) > TIME_STEP / 2
        for end in bar.ends:
            pairs = (
                ("displacement", end.displacement_at(time)),
                ("velocity", end.piecewise(end.velocity, time + 1e-9)),
                ("pressure", end.piecewise(end.pressure, time + 1e-9)),
            )
            for name, values in pairs:
                ours = table[f"exact_{name}_{end.name}"]
                deviation = max(deviation, np.abs(ours - values)[between].max())
    return [
        check(
            "max |balance residual|, all runs",
            f"{residual:.1e}",
            residual < 1e-12,
            "< 1e-12 of the energy: Newton's tolerance",
            exact="0",
        ),
        check("step halvings, all runs", f"{halvings:.0f}", halvings == 0, "none", exact="0"),
        check(
            "program's exact solution against closed form",
            f"{deviation:.1e}",
            deviation < 1e-12,
            "< 1e-12, round-off",
            exact="0",
        ),
    ]


def checks_off_contact(bar, curves, runs, alpha=None):
    """Redistributed mass: no stress at an end that is not in contact.

    Such an end has no inertia, so that each step leaves (1 - alpha) F_new +
    alpha F_old = 0, with F its force. An initial force, and the initial strain is
    one, therefore shrinks by |alpha|/(1 - alpha) each step: at once with alpha =
    0 and TR-BDF2, geometrically with HHT. In contact F = 0 too, as the contact
    force is part of it, so that nothing has to decay again after an opening, and
    no step needs to be left out.
    """
    rows = []
    for curve in curves:
        table = runs[curve.key, "redistributed"].read()
        a = alpha[curve.key] if alpha else 0.0
        ratio = abs(a) / (1 - a)
        step = np.arange(len(table["time"]))
        excess, largest, nodes = -np.inf, 0.0, 0
        for end in bar.ends:
            free = (table[f"active_points_{end.name}"] == 0) & (step > 0)
            stress = np.abs(table[f"stress_pressure_{end.name}"][free])
            initial = abs(table[f"stress_pressure_{end.name}"][0])
            law = initial * ratio ** step[free] * (1 + 1e-9)
            excess = max(excess, (stress - law).max())
            # Reported: after the decay of HHT, for which 15 steps are ample.
            late = step[free] > (15 if ratio else 0)
            largest = max(largest, stress[late].max())
            nodes += int(late.sum())
        criterion = f"< 1e-10 at all {nodes} steps off contact"
        if ratio:
            criterion += f"; before, |stress| <= initial ({ratio:.4f})^n"
        rows.append(
            check(
                f"redistributed, {PLAIN[curve.key]}: max |stress| off contact",
                f"{largest:.1e}",
                # Thousands of times round-off, a billionth of the pressure.
                excess < 1e-10 and largest < 1e-10,
                criterion,
                paper="0",
                exact="0",
            )
        )
    return rows


def energy_change(table):
    """Largest gain and final change of modified energy, relative to the start."""
    energy = table["modified_energy"]
    return energy.max() / energy[0] - 1, energy[-1] / energy[0] - 1


def energy_rows(curves, runs, bound=None, dissipative=False, paper="-"):
    """Modified energy of each curve; with a bound for the gain, or for the end."""
    rows = []
    for curve in curves:
        for mass in MASSES:
            gain, end = energy_change(runs[curve.key, mass].read())
            quantity = f"modified energy, {PLAIN[curve.key]}, {mass}: max, end"
            ours = f"{100 * gain:+.2f} %, {100 * end:+.2f} %"
            if bound is not None:
                # 1.5 %: "about 1 %" with room for the oscillation around it.
                passed, criterion = gain <= bound, f"gain at most {100 * bound:g} %"
            elif dissipative:
                passed, criterion = end < 0, "ends below the initial energy"
            else:
                rows.append(info(quantity, ours, paper, "0 %"))
                continue
            rows.append(check(quantity, ours, passed, criterion, paper, "0 %"))
    return rows


def initial_energy_row(bar, run):
    ours = run.read()["modified_energy"][0]
    exact = bar.initial_modified_energy
    return check(
        "initial modified energy, Nitsche (J)",
        f"{ours:.8f}",
        abs(ours - exact) < 1e-14,
        "within 1e-14 of E - sigma_n^2/(2 gamma_N), C (13)",
        exact=f"{exact:.8f}",
    )


def variation(bar, table, quantity):
    """Total variation in time of a quantity at the ends: large when it oscillates."""
    return sum(np.abs(np.diff(table[f"{quantity}_{end.name}"][1:])).sum() for end in bar.ends)


def compare(quantity, larger, smaller, paper, known_otherwise=False):
    """A statement of the paper that one number is larger than another.

    Where it is known not to hold in our data the row is a note, and else it fails.
    """
    (name_l, value_l), (name_s, value_s) = larger, smaller
    ours = f"{name_s} {value_s:.3g}, {name_l} {value_l:.3g}"
    if value_s >= value_l and known_otherwise:
        return note(quantity, ours, "the paper's statement does not hold here", paper)
    return check(quantity, ours, value_s < value_l, "as the paper states", paper)


def smoother_rows(bar, curves, runs, known_otherwise=()):
    """The redistributed mass oscillates less, says paper C of each scheme."""
    rows = []
    for curve in curves:
        for quantity, column in (("pressure", "stress_pressure"), ("velocity", "velocity")):
            values = {m: variation(bar, runs[curve.key, m].read(), column) for m in MASSES}
            rows.append(
                compare(
                    f"total variation of {quantity}, {PLAIN[curve.key]}",
                    ("consistent", values["consistent"]),
                    ("redistributed", values["redistributed"]),
                    "redistributed less",
                    quantity in known_otherwise,
                )
            )
    return rows


def first_step_rows(curves, runs, remark=""):
    """Redistributed mass: most of the energy is lost in the first step, not later.

    The initial strain of the element at the free end has nothing to hold it once
    the end has no inertia.
    """
    rows = []
    for curve in curves:
        energy = runs[curve.key, "redistributed"].read()["modified_energy"]
        rows.append(
            info(
                f"redistributed, {PLAIN[curve.key]}: change in the first step, after it",
                f"{100 * (energy[1] / energy[0] - 1):+.2f} %, "
                f"{100 * (energy[-1] / energy[1] - 1):+.2f} %",
                exact="0 %, 0 %",
                remark=remark,
            )
        )
    return rows


# Crank-Nicolson: figures 6, 7 and 13 ----------------------------------------

CN_SD = bar_runs(SD, 6, TREATMENTS)
CN_SS = bar_runs(SS, 13, TREATMENTS)
PENETRATION = {curve.key: bar_run(SD, 7, curve) for curve in TREATMENTS}

# "Gains up to about 1 %": the largest gain over the four periods.
CN_GAIN = 0.015


def checks_figure_6():
    return (
        energy_rows(TREATMENTS, CN_SD, bound=CN_GAIN, paper="bounded")
        + [initial_energy_row(SD, CN_SD["nitsche", "consistent"])]
        + first_step_rows(
            # The elastic energy h (1/2)^2/2 of one element, of 1/8.
            TREATMENTS,
            CN_SD,
            "the first element holds 5 % of the energy, and relaxes",
        )
        + checks_off_contact(SD, TREATMENTS, CN_SD)
        + smoother_rows(SD, TREATMENTS, CN_SD)
        + checks_of_runs(SD, CN_SD.values())
    )


def checks_figure_13():
    return (
        # The paper states no number for 1D-SS.
        energy_rows(TREATMENTS, CN_SS)
        + [initial_energy_row(SS, CN_SS["nitsche", "consistent"])]
        + first_step_rows(TREATMENTS, CN_SS)
        + checks_off_contact(SS, TREATMENTS, CN_SS)
        + smoother_rows(SS, TREATMENTS, CN_SS)
        + checks_of_runs(SS, CN_SS.values())
    )


# The nodes of the first contact: t = 1.00, 1.05, ..., 2.10.
FIRST_CONTACT = slice(20, 43)


def mean_displacement(key):
    return PENETRATION[key].read()["displacement_left"][FIRST_CONTACT].mean()


def draw_figure_7():
    figure, (whole, zoom) = plt.subplots(1, 2, figsize=(12, 4.2))
    end = SD.ends[0]
    time = np.arange(FINAL_TIME + 1)
    for panel in (whole, zoom):
        panel.axhline(0, color="0.6", linewidth=0.6)
        _exact(panel, time, end.displacement_at(time))
        panel.set_xlabel("time (s)")
    for curve in TREATMENTS:
        table = PENETRATION[curve.key].read()
        for panel in (whole, zoom):
            panel.plot(
                table["time"],
                table["displacement_left"],
                color=curve.colour,
                marker="." if panel is zoom else None,
                label=curve.label,
                zorder=3,
            )
        zoom.plot(
            [1, 2.1],
            [mean_displacement(curve.key)] * 2,
            color=curve.colour,
            linestyle=":",
            linewidth=1.6,
            label=f"{curve.label}, mean: {1e3 * mean_displacement(curve.key):.2f} mm",
        )
    whole.set(xlim=(0, FINAL_TIME), ylim=(-0.015, 0.05), ylabel="displacement of the left end (m)")
    whole.set_title("four periods, near the obstacle")
    zoom.set(xlim=(0.9, 2.25), ylim=(-0.0125, 0.0175), title="first contact")
    figure.tight_layout()
    figure.legend(
        *zoom.get_legend_handles_labels(), loc="lower center", bbox_to_anchor=(0.5, 0.98), ncol=5
    )
    return figure


def checks_figure_7():
    rows = []
    for key, exact_digits in (("nitsche", 5.0e-4), ("penalty", -3.8e-3)):
        mean = mean_displacement(key)
        rows.append(
            check(
                f"mean displacement in the first contact, {PLAIN[key]} (m)",
                f"{mean:.3e}",
                float(f"{mean:.1e}") == exact_digits,
                "equal to the digits printed; t = 1.00 ... 2.10",
                paper=f"{exact_digits:.1e}",
                exact="0",
            )
        )
    largest = {key: run.read()["penetration_left"].max() for key, run in PENETRATION.items()}
    rows.append(
        check(
            "largest penetration: Nitsche, penalty (m)",
            f"{largest['nitsche']:.2e}, {largest['penalty']:.2e}",
            largest["nitsche"] < largest["penalty"],
            "less with Nitsche's method",
            paper="Nitsche less",
            exact="0",
        )
    )
    return rows + checks_of_runs(SD, PENETRATION.values())


# HHT: figures 8 and 14 ------------------------------------------------------

HHT_SD = bar_runs(SD, 8, ALPHAS)
HHT_SS = bar_runs(SS, 14, ALPHAS)
ALPHA = {"alpha_0.05": 0.05, "alpha_-0.02": -0.02}


def checks_hht(bar, runs, crank_nicolson):
    rows = energy_rows(ALPHAS, runs, dissipative=True, paper="loss")
    for mass in MASSES:
        tables = {key: runs[key, mass].read() for key in ALPHA}
        loss = {key: -100 * energy_change(table)[1] for key, table in tables.items()}
        swing = {key: variation(bar, table, "velocity") for key, table in tables.items()}
        undamped = variation(bar, crank_nicolson["nitsche", mass].read(), "velocity")
        rows += [
            compare(
                f"energy lost (%), {mass}, both alphas",
                ("-0.02:", loss["alpha_-0.02"]),
                ("0.05:", loss["alpha_0.05"]),
                "-0.02 more",
            ),
            compare(
                f"total variation of velocity, {mass}, both alphas",
                ("0.05:", swing["alpha_0.05"]),
                ("-0.02:", swing["alpha_-0.02"]),
                "-0.02 less",
            ),
            compare(
                f"total variation of velocity, {mass}, 0.05 and Crank-Nicolson",
                ("Crank-Nicolson", undamped),
                ("0.05:", swing["alpha_0.05"]),
                "HHT less",
            ),
        ]
    return rows + checks_off_contact(bar, ALPHAS, runs, ALPHA) + checks_of_runs(bar, runs.values())


# TR-BDF2: figures 9 and 15 --------------------------------------------------

TR_SD = bar_runs(SD, 9, TREATMENTS)
TR_SS = bar_runs(SS, 15, TREATMENTS)


def checks_tr_bdf2(bar, runs, hht, known_otherwise=False):
    """The energy and the oscillation of TR-BDF2, beside those of HHT.

    In 1D-SS (`known_otherwise`) the end does not swing less with TR-BDF2 than with
    alpha = -0.02, which pays for it with energy, and with the redistributed mass
    it leaves an obstacle that it should only graze.
    """
    rows = energy_rows(TREATMENTS, runs, dissipative=True, paper="loss")
    for mass in MASSES:
        ours = runs["nitsche", mass].read()
        for key in ALPHA:
            other = hht[key, mass].read()
            name = PLAIN[key].replace("alpha = ", "HHT ")
            otherwise = known_otherwise and (mass == "redistributed" or key == "alpha_-0.02")
            rows += [
                compare(
                    f"energy lost (%), Nitsche, {mass}, and {name}",
                    (name, -100 * energy_change(other)[1]),
                    ("TR-BDF2", -100 * energy_change(ours)[1]),
                    "TR-BDF2 less",
                ),
                compare(
                    f"total variation of velocity, Nitsche, {mass}, and {name}",
                    (name, variation(bar, other, "velocity")),
                    ("TR-BDF2", variation(bar, ours, "velocity")),
                    "TR-BDF2 less",
                    otherwise,
                ),
            ]
    return (
        rows
        + smoother_rows(bar, TREATMENTS, runs, ("velocity",) if known_otherwise else ())
        + checks_off_contact(bar, TREATMENTS, runs)
        + checks_of_runs(bar, runs.values())
    )


# Convergence: figure 10 -----------------------------------------------------

MESH_SIZES = [0.1 / 2**k for k in range(7)]

SCHEMES = {
    "crank_nicolson": ("Crank-Nicolson", "0.35", "o"),
    "alpha_0.05": (r"HHT, $\tilde\alpha = 0.05$", BLUE, "s"),
    "alpha_-0.02": (r"HHT, $\tilde\alpha = -0.02$", ORANGE, "^"),
    "tr_bdf2": ("TR-BDF2", "#CC79A7", "D"),
}
SCHEME_NAMES = {
    "crank_nicolson": "Crank-Nicolson",
    "alpha_0.05": "HHT 0.05",
    "alpha_-0.02": "HHT -0.02",
    "tr_bdf2": "TR-BDF2",
}


def convergence_run(bar, scheme, k):
    size = repr(MESH_SIZES[k])
    return Run(
        "C-10",
        f"{bar.program}_{scheme}_h{k}",
        bar.program,
        f"{bar.program}/figure_10_{scheme}.prm",
        overrides=(f"Mesh/Mesh size={size}", f"Time/Time step={size}"),
        # Steps times unknowns; TR-BDF2 has two stages.
        cost=0.3 + 8 * 4.0 ** (k - 6) * (2 if scheme == "tr_bdf2" else 1),
    )


CONVERGENCE = {
    (bar.name, scheme): [convergence_run(bar, scheme, k) for k in range(len(MESH_SIZES))]
    for bar in (SD, SS)
    for scheme in SCHEMES
}


def errors(bar, scheme):
    """L2(0,T; H1) errors on the family of meshes: sqrt(dt sum_(n>=1) |e_n|_1^2)."""
    return np.array(
        [
            np.sqrt(size * np.sum(run.read()["h1_error"][1:] ** 2))
            for size, run in zip(MESH_SIZES, CONVERGENCE[bar.name, scheme])
        ]
    )


def draw_figure_10():
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.8), sharey=True)
    sizes = np.array(MESH_SIZES)
    for panel, bar in zip(axes, (SD, SS)):
        for scheme, (label, colour, marker) in SCHEMES.items():
            panel.loglog(
                sizes,
                errors(bar, scheme),
                color=colour,
                marker=marker,
                markersize=5,
                linewidth=1.5,
                label=label,
            )
        for order, text, style in ((1 / 3, "1/3", ":"), (1 / 4, "1/4", "--")):
            guide = 0.045 * (sizes / sizes[-1]) ** order
            panel.loglog(sizes, guide, "k", linestyle=style, linewidth=1, label=f"order {text}")
        panel.set_xlabel(r"$h = \Delta t$ (m, s)")
        panel.set_title(bar.name)
        panel.grid(True, which="minor", color="0.95", linewidth=0.4)
        ticks = (0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125, 0.0015625)
        panel.set_xticks(ticks)
        panel.set_xticklabels([r"$\frac{1}{%d}$" % round(1 / t) for t in ticks], fontsize=13)
        panel.set_xticks([], minor=True)
    axes[0].set_ylabel(r"error in $L^2(0,T;H^1(\Omega))$")
    axes[0].legend(loc="upper left", ncol=1, fontsize=9)
    figure.tight_layout()
    return figure


def checks_figure_10():
    """Orders of convergence.

    The exact strain is discontinuous, so that no scheme can do better than order
    1/2 on meshes like these. How much worse it is depends on the width over which
    a scheme spreads a jump: like h^(2/3) by dispersion of second order
    (Crank-Nicolson, HHT with alpha > 0, TR-BDF2), hence order 1/3, and like
    h^(1/2) by the damping of first order that alpha < 0 has, hence 1/4. Where
    both are at work the order drifts from the larger to the smaller one, so a
    fit over the three finest meshes is asked to lie between 1/4 and 1/2, with
    0.02 to spare for the fit, and the error to fall with every refinement.
    """
    low, high = 0.25 - 0.02, 0.5 + 0.02
    rows = []
    for bar in (SD, SS):
        last = {}
        for scheme, name in SCHEME_NAMES.items():
            error = errors(bar, scheme)
            orders = np.diff(np.log(error)) / np.diff(np.log(MESH_SIZES))
            fit = np.polyfit(np.log(MESH_SIZES), np.log(error), 1)[0]
            last[scheme] = np.polyfit(np.log(MESH_SIZES[-3:]), np.log(error[-3:]), 1)[0]
            theory = "1/4" if scheme == "alpha_-0.02" else "1/3"
            rows += [
                info(
                    f"{bar.name}, {name}: errors for h = 1/10 ... 1/640",
                    " ".join(f"{value:.4f}" for value in error),
                ),
                check(
                    f"{bar.name}, {name}: orders between meshes",
                    " ".join(f"{order:.2f}" for order in orders),
                    np.all(orders > 0),
                    "the error falls with every refinement",
                ),
                check(
                    f"{bar.name}, {name}: order overall, last three meshes",
                    f"{fit:.3f}, {last[scheme]:.3f}",
                    low <= last[scheme] <= high,
                    f"last three: {low:.2f} ... {high:.2f}, from 1/4 to 1/2",
                    exact=theory,
                ),
            ]
        spread = abs(last["alpha_0.05"] - last["alpha_-0.02"])
        rows.append(
            check(
                f"{bar.name}: difference of the orders of alpha = 0.05 and -0.02",
                f"{spread:.3f}",
                # In the limit it is 1/3 - 1/4 = 0.083: similar, not the same.
                spread < 0.1,
                "< 0.1 on the last three meshes",
                paper="similar",
                exact="0.083",
            )
        )
    all_runs = [run for runs in CONVERGENCE.values() for run in runs]
    residual = _worst(all_runs, lambda table: np.abs(table["balance_residual"]).max())
    halvings = _worst(all_runs, lambda table: table["step_halvings"].max())
    return rows + [
        check(
            "max |balance residual|, all runs",
            f"{residual:.1e}",
            residual < 1e-11,
            "< 1e-11: Newton's tolerance; round-off grows as h^-2 (5.9e-13 seen)",
            exact="0",
        ),
        check("step halvings, all runs", f"{halvings:.0f}", halvings == 0, "none", exact="0"),
    ]


# The figures ----------------------------------------------------------------

PANELS = (
    "Motion of the {ends}, contact pressure -sigma_n(u_h) and modified energy, against the exact "
    "solution (black); consistent mass on the left, redistributed mass on the right. {what} "
    "h = dt = 0.05, gamma_0 = 1/epsilon_0 = 5."
)


def panel_figure(number, bar, curves, runs, what, checks, other_runs=()):
    ends = "left end" if len(bar.ends) == 1 else "ends"
    return Figure(
        f"C-{number}",
        f"{bar.name}, {what}",
        PANELS.format(ends=ends, what=f"{bar.name}, {what}."),
        [*runs.values(), *other_runs],
        lambda: draw_panels(bar, curves, runs),
        checks,
    )


FIGURES = [
    panel_figure(6, SD, TREATMENTS, CN_SD, "Crank-Nicolson", checks_figure_6),
    Figure(
        "C-7",
        "1D-SD, penetration of the penalty method and of Nitsche's",
        "Displacement of the left end near the obstacle, Crank-Nicolson with consistent mass; the "
        "obstacle is at 0. Right: the first contact, with the mean over its nodes (dotted).",
        list(PENETRATION.values()),
        draw_figure_7,
        checks_figure_7,
    ),
    panel_figure(
        8,
        SD,
        ALPHAS,
        HHT_SD,
        "HHT with alpha = 0.05 and -0.02",
        lambda: checks_hht(SD, HHT_SD, CN_SD),
        CN_SD.values(),
    ),
    panel_figure(
        9,
        SD,
        TREATMENTS,
        TR_SD,
        "TR-BDF2",
        lambda: checks_tr_bdf2(SD, TR_SD, HHT_SD),
        HHT_SD.values(),
    ),
    Figure(
        "C-10",
        "1D-SD and 1D-SS, convergence with h = dt",
        "Error in L2(0,T;H1) against h = dt, Nitsche's method with consistent mass. The paper "
        "shows 1D-SD. The strain jumps, so that the orders are low: 1/3 where dispersion spreads "
        "the jump, 1/4 where the first-order damping of alpha < 0 does.",
        [run for runs in CONVERGENCE.values() for run in runs],
        draw_figure_10,
        checks_figure_10,
    ),
    panel_figure(13, SS, TREATMENTS, CN_SS, "Crank-Nicolson", checks_figure_13),
    panel_figure(
        14,
        SS,
        ALPHAS,
        HHT_SS,
        "HHT with alpha = 0.05 and -0.02",
        lambda: checks_hht(SS, HHT_SS, CN_SS),
        CN_SS.values(),
    ),
    panel_figure(
        15,
        SS,
        TREATMENTS,
        TR_SS,
        "TR-BDF2",
        lambda: checks_tr_bdf2(SS, TR_SS, HHT_SS, known_otherwise=True),
        HHT_SS.values(),
    ),
]
