# SPDX-License-Identifier: LGPL-2.1-or-later
"""Papers A and B, section 6.1: the elastic ball.

A: figures 3 to 9, tables 1 and 2. B: figures 3 to 6. All runs start just above the
foundation, and their mesh has 1580 nodes, 128 of them on the circle.
"""

import matplotlib.pyplot as plt
import numpy as np

from paper_ab_common import (
    EMM,
    HAURET,
    INC,
    PERSISTENT,
    SCALE,
    SIGNORINI,
    SNC,
    TWO_STEP,
    band,
    body,
    checks_of_runs,
    constant_row,
    cost_checks,
    curve,
    dip,
    dissipative_row,
    energy,
    energy_axes,
    factor_row,
    fill,
    loses_row,
    lost,
    momentum_row,
    order_row,
    penetration,
    percent,
    recovered_row,
    span,
    statement,
    table_image,
    timing_of_steps,
)
from report import Figure, check, info
from runs import QUIET, Run

# What the parameter files impact_*.prm hold: time step (s), initial gap (m), and the
# whole steps in that gap.
STEP = {"0.1ms": (1e-4, 0.0055, 5), "1ms": (1e-3, 0.055, 5), "10ms": (1e-2, 0.15, 1)}

AGAINST = "time since the ball touches (ms)"


def run(figure, key, file=None, overrides=(), cost=1.0):
    return Run(
        figure,
        key,
        "elastic_ball",
        f"elastic_ball/figure_{figure[0]}{int(figure[2:]):02}_{file or key}.prm",
        (*QUIET, *overrides),
        cost=cost,
    )


def positions(one, step):
    time_step, _, steps = STEP[step]
    return band(one, steps, time_step, one.cost)


def lines(axes, methods, runs, bands, step, values=energy, width=1.3):
    """A curve and a band for each method."""
    start = STEP[step][1]
    for method in methods:
        if method.key in bands:
            fill(axes, bands[method.key], values, start, method.colour)
        # Persistent contact lies on the two-step scheme.
        style = (0, (4, 3)) if method is PERSISTENT else "-"
        curve(
            axes,
            runs[method.key],
            values,
            start,
            method.colour,
            method.label,
            linewidth=width,
            linestyle=style,
        )


# The runs -------------------------------------------------------------------

METHODS_A = (SIGNORINI, SNC, EMM, TWO_STEP, INC[2], PERSISTENT)
METHODS_B = (SIGNORINI, SNC, EMM, TWO_STEP, HAURET, PERSISTENT)

FINE = {method.key: run("A-4", method.key) for method in METHODS_A}
FINE["hauret"] = run("B-4", "hauret")
FINE.update({INC[alpha].key: run("A-9", INC[alpha].key) for alpha in (3, 4, 5)})
FINE_BAND = {key: positions(one, "1ms") for key, one in FINE.items()}

COARSE = {INC[alpha].key: run("A-8", INC[alpha].key) for alpha in (2, 3, 4, 5)}
COARSE["snc"] = run("A-8", "snc")
COARSE_BAND = {key: positions(one, "10ms") for key, one in COARSE.items()}


def with_bands(methods, runs, bands):
    return [r for m in methods for r in (runs[m.key], *bands[m.key])]


# Pictures: A 3 and B 3 ------------------------------------------------------

PICTURE = Run(
    "A-3", "fields", "elastic_ball", "elastic_ball/figure_A03.prm", ("Output/Log every=0",)
)
SNAPSHOTS = ((0, "before"), (20, "during"), (60, "after"))  # step, label


def draw_picture(stress):
    figure, axes = plt.subplots(1, 3, figsize=(12, 4.4), sharey=True)
    time = PICTURE.read()["time"]
    for panel, (step, label) in zip(axes, SNAPSHOTS):
        _, drawn = body(
            panel,
            PICTURE.folder / "solution" / f"step-{step:06}.vtu",
            arrow=4 / 2e8,
            stress=stress,
            limit=2.5e7 if stress else None,
        )
        panel.set_title(f"{label}, {1e3 * time[step]:.0f} ms")
        panel.set_xlim(-11.5, 11.5)
        panel.set_ylim(-1, 21)
        panel.set_xlabel("$x_1$ (m)")
    axes[0].set_ylabel("$x_2$ (m)")
    if stress:
        figure.colorbar(drawn, ax=axes, label="von Mises stress (Pa)", shrink=0.9)
    else:
        figure.tight_layout()
    return figure


def checks_picture():
    table = PICTURE.read()
    rows = []
    for step, label in SNAPSHOTS:
        force, _ = body(
            plt.figure().add_subplot(),
            PICTURE.folder / "solution" / f"step-{step:06}.vtu",
        )
        plt.close()
        ledger = table["contact_force_foundation"][step]
        # The arrows are stored in single precision.
        good = abs(force[1] - ledger) <= 1e-5 * max(ledger, 1)
        good &= (ledger > 0) == (label == "during")
        rows.append(
            check(
                f"sum of the arrows {label} the impact (N)",
                f"{force[1]:.4e}",
                bool(good),
                "the ledger's contact force within 1e-5; some during the impact only",
                exact=f"{ledger:.4e}",
            )
        )
    return rows + checks_of_runs([PICTURE])


# Energy of the methods: A 4, B 4 --------------------------------------------

# An experiment on EMM: the Crank-Nicolson scheme in place of the midpoint rule.
EMM_CN = positions(run("A-4", "emm_cn", "emm", ("Time/Scheme=Crank-Nicolson",)), "1ms")


def draw_energy(methods):
    figure, axes = energy_axes()
    lines(axes, methods, FINE, FINE_BAND, "1ms")
    axes.set_xlabel(AGAINST)
    axes.set_xlim(-2, 40)
    axes.legend(fontsize=8, loc="lower right")
    return figure


def mean(values):
    return sum(values) / len(values)


def lost_on_landing(one):
    """Energy lost in the steps after which more nodes are in contact than before."""
    return -np.diff(energy(one))[np.diff(one.read()["active_points_foundation"]) > 0].sum()


def checks_energy(methods):
    rows = [constant_row("persistent", [FINE["persistent"], *FINE_BAND["persistent"]])]
    rows.append(
        constant_row("two-step", [FINE["two_step"], *FINE_BAND["two_step"]])
    )
    for method in methods:
        if method in (INC[2], HAURET):
            all_runs = [FINE[method.key], *FINE_BAND[method.key]]
            rows.append(constant_row(method.name, all_runs, "modified_energy", "-"))
            rows.append(recovered_row(method.name, all_runs))
            rows.append(
                info(f"{method.name}: largest dip", percent([dip(r) for r in all_runs]), "a dip")
            )
    # A's text names 1 % for SNC at this step (below figure 9).
    for method, paper in ((SIGNORINI, "loses"), (SNC, "about 1 %")):
        rows.append(
            loses_row(
                method.name,
                FINE_BAND[method.key],
                paper,
                (0.001, 0.02),
                "between 0.1 and 2 % at each position",
            )
        )
    losses = {key: [lost(r) for r in FINE_BAND[key]] for key in ("emm", "signorini")}
    ratio = mean(losses["emm"]) / mean(losses["signorini"])
    losing = [r for key in losses for r in FINE_BAND[key]]
    elsewhere = max(abs(lost(r) - lost_on_landing(r)) for r in losing)
    change = [-lost(r) for r in EMM_CN]
    rows += [
        check(
            "EMM: energy lost",
            percent(losses["emm"]),
            min(losses["emm"]) > 1e-9 and ratio < 1,
            "some at each position, on average less than Signorini",
            "some",
        ),
        check(
            "Signorini and EMM: energy lost in steps in which no node lands",
            f"{elsewhere:.1e}",
            elsewhere < 1e-9,
            "< 1e-9 of the initial energy",
        ),
        statement(
            "EMM loses much less than Signorini: ratio of the means",
            f"{ratio:.2f}",
            ratio < 0.5,
            "below 0.5",
            "strongly reduced",
            "each node that lands costs its pressure times the rest of its way in that step, "
            "whatever its inertia; with Crank-Nicolson in place of the midpoint rule the change "
            f"is {100 * min(change):+.2f} to {100 * max(change):+.2f} %",
        ),
    ]
    runs = with_bands(methods, FINE, FINE_BAND)
    return rows + [momentum_row(runs)] + checks_of_runs(runs)


# A 5: the coefficient of compliance -----------------------------------------

# 2.6e12 Pa/m^2 stands for the paper's 1000.
COEFFICIENTS = (2.6e10, 2.6e11, 2.6e12, 2.6e13, 2.6e14)
BY_COEFFICIENT = {
    c: COARSE["inc3"]
    if c == 2.6e12
    else Run(
        "A-5",
        f"inc3_{c:.1e}",
        "elastic_ball",
        "elastic_ball/figure_A08_inc3.prm",
        (*QUIET, f"Contact/Compliance coefficient={c:g}"),
        cost=0.8,
    )
    for c in COEFFICIENTS
}
# Every other position.
BY_COEFFICIENT_BAND = {c: positions(r, "10ms")[::2] for c, r in BY_COEFFICIENT.items()}
A5_RUNS = [r for c in COEFFICIENTS for r in (BY_COEFFICIENT[c], *BY_COEFFICIENT_BAND[c])]


def draw_a5():
    figure, axes = energy_axes()
    for c, colour in zip(COEFFICIENTS, SCALE):
        label = rf"$c_\nu = {c / 1e12:g}\cdot 10^{{12}}$ Pa/m$^2$"
        fill(axes, BY_COEFFICIENT_BAND[c], energy, STEP["10ms"][1], colour)
        curve(axes, BY_COEFFICIENT[c], energy, STEP["10ms"][1], colour, label)
    axes.set_xlabel(AGAINST)
    axes.set_xlim(-20, 90)
    axes.legend(fontsize=8, loc="lower right")
    return figure


def checks_a5():
    deepest = [max(penetration(r) for r in BY_COEFFICIENT_BAND[c]) for c in COEFFICIENTS]
    dips = [mean([100 * dip(r) for r in BY_COEFFICIENT_BAND[c]]) for c in COEFFICIENTS]
    falls = all(a > b for a, b in zip(dips, dips[1:]))
    return [
        recovered_row("all c_nu", A5_RUNS),
        constant_row("all c_nu", A5_RUNS, "modified_energy", "-"),
        order_row(
            "largest penetration (m), by c_nu from small to large",
            deepest,
            "falls from each to the next",
            "practically none for large c_nu",
            "{:.1e}",
            rising=False,
        ),
        statement(
            "mean dip, by c_nu from small to large",
            ", ".join(f"{value:.1f} %" for value in dips),
            falls,
            "falls from each to the next",
            "slight for c_nu > 1e4, more below",
            "the dip is the energy in the contact potential, which falls as c_nu grows, but at "
            "this step a stiffer contact also lands nodes deeper than they would stay: the dip "
            "ends at the loss that Signorini's condition has",
        ),
    ] + checks_of_runs(A5_RUNS)


# A 6: the time step ---------------------------------------------------------

FINEST = run("A-6", "inc3_0.1ms", cost=5)
A6 = (("10ms", COARSE["inc3"]), ("1ms", FINE["inc3"]), ("0.1ms", FINEST))
A6_BANDS = {"10ms": COARSE_BAND["inc3"], "1ms": FINE_BAND["inc3"]}


def draw_a6():
    figure, axes = energy_axes()
    for (step, one), colour in zip(A6, ("#D55E00", "#0072B2", "#000000")):
        start = STEP[step][1]
        if step in A6_BANDS:
            fill(axes, A6_BANDS[step], energy, start, colour)
        curve(axes, one, energy, start, colour, rf"$\Delta t = {1e3 * STEP[step][0]:g}$ ms")
    axes.set_xlabel(AGAINST)
    axes.set_xlim(-15, 70)
    axes.legend(loc="lower right")
    return figure


def checks_a6():
    runs = [one for _, one in A6] + [r for group in A6_BANDS.values() for r in group]
    dips = {step: [dip(r) for r in group] for step, group in A6_BANDS.items()}
    finest = dip(FINEST)
    return [
        recovered_row("all steps", runs),
        constant_row("all steps", runs, "modified_energy", "-"),
        info("dip, 10 ms", percent(dips["10ms"]), "more fluctuations"),
        check(
            "mean dip, 10 ms over 1 ms",
            f"{mean(dips['10ms']) / mean(dips['1ms']):.2f}",
            mean(dips["10ms"]) > 1.5 * mean(dips["1ms"]),
            "above 1.5",
            "> 1",
        ),
        check(
            "dip, 1 ms and 0.1 ms",
            f"{percent(dips['1ms'])}, {100 * finest:.2f} %",
            0.8 * min(dips["1ms"]) < finest < 1.25 * max(dips["1ms"]),
            "as large with the smaller step, to 25 %",
            "no less below 1 ms",
        ),
    ] + checks_of_runs(runs)


# A 7: the number of contact points ------------------------------------------

NODES = {16: 25, 32: 96, 64: 392, 128: 1580}
BY_MESH = {
    (method.key, n): COARSE[method.key]
    if n == 128
    else Run(
        "A-7",
        f"{method.key}_{n}",
        "elastic_ball",
        f"elastic_ball/figure_A08_{method.key}.prm",
        (*QUIET, f"Mesh/Nodes={NODES[n]}", f"Mesh/Boundary nodes={n}"),
        cost=0.3,
    )
    for method in (SNC, INC[3])
    for n in NODES
}
BY_MESH_BAND = {key: positions(r, "10ms") for key, r in BY_MESH.items()}
A7_RUNS = [r for key in BY_MESH for r in (BY_MESH[key], *BY_MESH_BAND[key])]


def draw_a7():
    figure, axes = energy_axes(2, sharey=True)
    for panel, method in zip(axes, (SNC, INC[3])):
        for n, colour in zip(NODES, SCALE):
            fill(panel, BY_MESH_BAND[method.key, n], energy, STEP["10ms"][1], colour)
            one = BY_MESH[method.key, n]
            curve(panel, one, energy, STEP["10ms"][1], colour, f"{n} nodes on the circle")
        panel.set_title(method.label)
        panel.set_xlabel(AGAINST)
        panel.set_xlim(-20, 90)
    axes[1].legend(fontsize=8, loc="lower right")
    figure.tight_layout()
    return figure


def checks_a7():
    rows = []
    for n in NODES:
        losses = [lost(r) for r in BY_MESH_BAND["snc", n]]
        reaches = min(losses) <= 0.28 and max(losses) >= 0.24
        rows.append(
            statement(
                f"SNC, {n} nodes on the circle: energy lost",
                percent(losses),
                reaches,
                "the ten positions reach 24 to 28 %",
                "24 to 28 %",
                "the positions do not reach the paper's range on this mesh",
            )
        )
        group = [BY_MESH["inc3", n], *BY_MESH_BAND["inc3", n]]
        rows.append(recovered_row(f"INC alpha = 3, {n} nodes", group))
    for n in NODES:
        ours = (
            mean([100 * dip(r) for r in BY_MESH_BAND["inc3", n]]),
            mean([100 * dip(r) for r in BY_MESH_BAND["snc", n]]),
        )
        rows.append(
            statement(
                f"mean dip of INC alpha = 3 and of SNC, {n} nodes",
                f"{ours[0]:.1f} %, {ours[1]:.1f} %",
                ours[0] < ours[1],
                "INC less",
                "INC has less fluctuation",
                "INC's dip is no smaller during the impact; what differs is that it comes back",
            )
        )
    return rows + checks_of_runs(A7_RUNS)


# A 8 and A 9: the exponent --------------------------------------------------

BY_EXPONENT = (SNC, INC[2], INC[3], INC[4], INC[5])
EXPONENT_COLOURS = dict(zip((m.key for m in BY_EXPONENT), ("#000000", *SCALE)))


def draw_exponents(runs, bands, step, limits):
    figure, axes = energy_axes()
    for method in BY_EXPONENT:
        colour = EXPONENT_COLOURS[method.key]
        fill(axes, bands[method.key], energy, STEP[step][1], colour)
        curve(axes, runs[method.key], energy, STEP[step][1], colour, method.label)
    axes.set_xlabel(AGAINST)
    axes.set_xlim(*limits)
    axes.legend(fontsize=8, loc="lower right")
    return figure


def checks_exponents(runs, bands, snc):
    rows = [snc]
    for alpha in (2, 3, 4, 5):
        group = [runs[INC[alpha].key], *bands[INC[alpha].key]]
        rows.append(recovered_row(INC[alpha].name, group))
    everything = [r for m in BY_EXPONENT for r in (runs[m.key], *bands[m.key])]
    inc = [r for m in BY_EXPONENT[1:] for r in (runs[m.key], *bands[m.key])]
    rows.append(constant_row("INC", inc, "modified_energy", "-"))
    return rows, everything


def checks_a8():
    losses = [lost(r) for r in COARSE_BAND["snc"]]
    snc = check(
        "SNC: energy lost",
        percent(losses),
        min(losses) <= 0.28 <= max(losses),
        "the ten positions reach 28 %",
        "28 %",
    )
    rows, runs = checks_exponents(COARSE, COARSE_BAND, snc)
    for alpha in (2, 3, 4, 5):
        dips = [dip(r) for r in COARSE_BAND[INC[alpha].key]]
        rows.append(info(f"{INC[alpha].name}: dip", percent(dips), "some fluctuations"))
    return rows + checks_of_runs(runs)


def checks_a9():
    snc = loses_row(
        "SNC", FINE_BAND["snc"], "1 %", (0.001, 0.02), "between 0.1 and 2 % at each position"
    )
    rows, runs = checks_exponents(FINE, FINE_BAND, snc)
    dips = [mean([100 * dip(r) for r in FINE_BAND[INC[a].key]]) for a in (2, 3, 4, 5)]
    rows.append(
        order_row(
            "mean dip for alpha = 2, 3, 4, 5",
            dips,
            "grows from each to the next",
            "strictly increasing; large above alpha = 4",
        )
    )
    return rows + checks_of_runs(runs)


# A, table 1: penetration ----------------------------------------------------

TABLE_1 = (
    (SIGNORINI, 0.0),
    (TWO_STEP, 5.1e-3),
    (PERSISTENT, 1.54e-2),
    (SNC, 1.4e-4),
    (INC[2], 5.7e-4),
    (INC[3], 8.05e-3),
)


def draw_t1():
    rows = []
    for method, paper in TABLE_1:
        values = [penetration(r) for r in FINE_BAND[method.key]]
        middle = penetration(FINE[method.key])
        rows.append([method.name, f"{paper:.2e}", span(values), f"{middle:.2e}"])
    return table_image(
        ["method", "paper (m)", "ours, ten positions (m)", "ours, middle of a step (m)"],
        rows,
        [0.2, 0.2, 0.33, 0.33],
    )


def checks_t1():
    rows = []
    for method, paper in TABLE_1:
        values = [penetration(r) for r in FINE_BAND[method.key]]
        if method is SIGNORINI:
            rows.append(
                check(
                    "largest penetration, Signorini (m)",
                    f"{max(values):.1e}",
                    max(values) < 1e-12,
                    "< 1e-12, round-off",
                    "0",
                    "0",
                )
            )
        else:
            rows.append(factor_row(method.name, values, paper, "no position comes within it"))
    runs = with_bands([method for method, _ in TABLE_1], FINE, FINE_BAND)
    return rows + checks_of_runs(runs)


# B 5: contact stress --------------------------------------------------------


def force(one):
    """The force (N) that acts during each step, from the momentum of the ball."""
    table = one.read()
    steps = np.diff(table["momentum_y"]) / np.diff(table["time"])
    return np.concatenate(([0.0], steps))


def draw_b5():
    figure, axes = plt.subplots(2, 1, figsize=(7.5, 7), sharex=True)
    panels = (
        (force, "contact force of the step (N)"),
        (lambda r: r.read()["contact_pressure_foundation"], "largest contact pressure (Pa)"),
    )
    for panel, (values, label) in zip(axes, panels):
        for method in METHODS_B:
            colour = method.colour
            one = FINE[method.key]
            curve(panel, one, values, STEP["1ms"][1], colour, method.label, linewidth=1.0)
        panel.set_ylabel(label)
    axes[0].legend(fontsize=8)
    axes[1].set_xlabel(AGAINST)
    axes[1].set_xlim(-1, 35)
    return figure


def roughness(values):
    """Total variation over twice the largest value: 1 for a single bump."""
    return np.abs(np.diff(values)).sum() / (2 * values.max())


def checks_b5():
    rows = []
    momentum = abs(FINE["signorini"].read()["momentum_y"][0])
    for method in METHODS_B:
        one = FINE[method.key]
        table = one.read()
        # Newton's second law; the force of a step acts during all of it.
        impulse = 1e-3 * table["contact_force_foundation"].sum()
        change = table["momentum_y"][-1] - table["momentum_y"][0]
        error = abs(impulse / change - 1)
        rows.append(
            statement(
                f"{method.name}: impulse of the ledger's contact force / change of momentum - 1",
                f"{error:.1e}",
                error < 1e-9,
                "< 1e-9: Newton's tolerance",
                "-",
                "the ledger's force is that of the penetration at the end of a step, not the "
                "one that acts during it; the upper panel takes the change of momentum",
            )
            if method is HAURET
            else check(
                f"{method.name}: impulse of the ledger's contact force / change of momentum - 1",
                f"{error:.1e}",
                error < 1e-9,
                "< 1e-9: Newton's tolerance",
                exact="0",
            )
        )
        rows.append(
            info(
                f"{method.name}: impulse / momentum before; largest force (N); bumps of the force",
                f"{change / momentum:.4f}; {force(one).max():.2e}; {roughness(force(one)):.2f}",
            )
        )
    peak = {
        key: max(force(r).max() for r in FINE_BAND[key]) for key in ("two_step", "signorini")
    }
    rows.append(
        statement(
            "largest force over the positions, two-step over Signorini",
            f"{peak['two_step'] / peak['signorini']:.3f}",
            peak["two_step"] > 1.02 * peak["signorini"],
            "above 1.02",
            "two-step raises the contact stress",
            "the force of our two-step scheme is that of Signorini's condition to one per cent",
        )
    )
    return rows + checks_of_runs([FINE[m.key] for m in METHODS_B])


# B 6: viscosity -------------------------------------------------------------

VISCOUS = {0: FINE["persistent"]}
VISCOUS.update({float(eta): run("B-6", f"eta_{eta}") for eta in ("1e5", "1e6", "1e7")})


def draw_b6():
    figure, axes = energy_axes()
    for (eta, one), colour in zip(VISCOUS.items(), ("#D55E00", *SCALE)):
        label = rf"$\eta = {eta / 1e6:g}$ MPa s"
        curve(axes, one, energy, STEP["1ms"][1], colour, label)
    axes.set_xlabel(AGAINST)
    axes.set_xlim(-2, 54)
    axes.legend(loc="lower left")
    return figure


def checks_b6():
    losses = [100 * lost(r) for r in VISCOUS.values()]
    rows = [constant_row("no viscosity", VISCOUS[0])]
    rows.append(dissipative_row("with viscosity", [r for eta, r in VISCOUS.items() if eta]))
    for eta, one in VISCOUS.items():
        if eta:
            table = one.read()
            part = table["viscous_dissipation"][-1] / (table["energy"][0] - table["energy"][-1])
            rows.append(
                check(
                    f"eta = {eta:g} Pa s: viscous dissipation / energy lost - 1",
                    f"{part - 1:.1e}",
                    abs(part - 1) < 1e-9,
                    "< 1e-9: nothing else dissipates",
                    exact="0",
                )
            )
    rows.append(
        order_row(
            "energy lost for eta = 0, 0.1, 1, 10 MPa s",
            losses,
            "grows with eta",
            "grows with eta",
        )
    )
    return rows + checks_of_runs(VISCOUS.values())


# A, table 2: cost (timed) ---------------------------------------------------

COST_METHODS = (SIGNORINI, PERSISTENT, INC[3], SNC)
FAMILY = {16: 25, 32: 96, 64: 392, 128: 1580, 256: 6260}
PAPER_CPU = {
    "signorini": (6.2, 25.6, 248.9, 2950.1, 47452.8),
    "persistent": (7.2, 33.7, 159.2, 1089.9, 10492.8),
    "inc3": (7.2, 34.2, 158.6, 1101.1, 10527.1),
    "snc": (7.9, 33.8, 159.1, 1074.5, 10384.2),
}
COST = {
    (method.key, n): Run(
        "A-T2",
        f"{method.key}_{n}",
        "elastic_ball",
        "elastic_ball/figure_A08_inc3.prm"
        if method is INC[3]
        else f"elastic_ball/figure_A04_{method.key}.prm",
        (
            *QUIET,
            f"Mesh/Nodes={nodes}",
            f"Mesh/Boundary nodes={n}",
            "Time/Time step=1e-2",
            "Time/Final time=2",
            "Start/Initial gap=15.05",
            *(("Contact/Compliance exponent=3",) if method is SNC else ()),
        ),
        cost=n,
    )
    for method in COST_METHODS
    for n, nodes in FAMILY.items()
}


def draw_t2():
    header = ["nodes on the circle", *map(str, FAMILY)]
    rows = [["degrees of freedom", *(str(2 * nodes) for nodes in FAMILY.values())]]
    for method in COST_METHODS:
        ours = [timing_of_steps(COST[method.key, n])[0] for n in FAMILY]
        rows.append([f"{method.name}, ours (s)", *(f"{t:.3g}" for t in ours)])
        rows.append([f"{method.name}, paper (s)", *(f"{t:g}" for t in PAPER_CPU[method.key])])
    return table_image(header, rows, [0.34] + 5 * [0.16])


def checks_t2():
    return cost_checks(COST_METHODS, COST, FAMILY, PAPER_CPU) + checks_of_runs(
        COST.values(), 1e-8, "< 1e-8: round-off of 15 m of flight, as large before the impact"
    )


# The figures ----------------------------------------------------------------

PLACE = "Bands: ten positions of the impact within a step. "
ENERGY_CAPTION = (
    "Energy relative to the start during the impact, steps of 1 ms. " + PLACE + "Signorini's "
    "condition and standard normal compliance lose energy as nodes land, "
)

FIGURES = [
    Figure(
        "A-3",
        "Elastic ball: deformed body and contact forces",
        "The ball before, during and after the impact, with improved normal compliance "
        "(alpha = 2) and steps of 1 ms. The displacement is not magnified; arrows are nodal "
        "contact forces.",
        [PICTURE],
        lambda: draw_picture(False),
        checks_picture,
    ),
    Figure(
        "A-4",
        "Elastic ball: energy of the methods, steps of 1 ms",
        ENERGY_CAPTION + "and so does the equivalent mass matrix; improved normal compliance "
        "takes energy into its potential and gives it all back; the two-step scheme and "
        "persistent contact change nothing.",
        with_bands(METHODS_A, FINE, FINE_BAND) + EMM_CN,
        lambda: draw_energy(METHODS_A),
        lambda: checks_energy(METHODS_A),
    ),
    Figure(
        "A-5",
        "Elastic ball: improved normal compliance for several coefficients",
        "Energy relative to the start, alpha = 3, steps of 10 ms. Bands: five positions of the "
        "impact within a step. The energy comes back whatever the coefficient. 2.6e12 Pa/m^2 "
        "stands for the paper's 1000.",
        A5_RUNS,
        draw_a5,
        checks_a5,
    ),
    Figure(
        "A-6",
        "Elastic ball: improved normal compliance for several time steps",
        "Energy relative to the start, alpha = 3. " + PLACE + "None is shown for 0.1 ms. The dip "
        "of the small steps is the contact potential of the true motion, and does not vanish.",
        [one for _, one in A6] + [r for group in A6_BANDS.values() for r in group],
        draw_a6,
        checks_a6,
    ),
    Figure(
        "A-7",
        "Elastic ball: number of contact points",
        "Energy relative to the start for meshes of 25, 96, 392 and 1580 nodes, steps of 10 ms. "
        + PLACE + "Left: standard normal compliance. Right: improved, alpha = 3.",
        A7_RUNS,
        draw_a7,
        checks_a7,
    ),
    Figure(
        "A-8",
        "Elastic ball: exponent of improved normal compliance, steps of 10 ms",
        "Energy relative to the start. " + PLACE + "With steps of 10 ms, three to an impact, the "
        "position decides more than the exponent does.",
        [r for m in BY_EXPONENT for r in (COARSE[m.key], *COARSE_BAND[m.key])],
        lambda: draw_exponents(COARSE, COARSE_BAND, "10ms", (-20, 90)),
        checks_a8,
    ),
    Figure(
        "A-9",
        "Elastic ball: exponent of improved normal compliance, steps of 1 ms",
        "Energy relative to the start. " + PLACE + "The larger the exponent, the softer the "
        "contact at these penetrations, and the more energy its potential holds.",
        [r for m in BY_EXPONENT for r in (FINE[m.key], *FINE_BAND[m.key])],
        lambda: draw_exponents(FINE, FINE_BAND, "1ms", (-2, 45)),
        checks_a9,
    ),
    Figure(
        "A-T1",
        "Elastic ball: largest penetration",
        "Largest penetration with steps of 1 ms, for ten positions of the impact within a step, "
        "beside table 1 of the paper.",
        with_bands([method for method, _ in TABLE_1], FINE, FINE_BAND),
        draw_t1,
        checks_t1,
    ),
    Figure(
        "A-T2",
        "Elastic ball: cost against degrees of freedom (timed)",
        "Seconds for the 200 steps of 10 ms, without the start of the program, beside the CPU "
        "seconds of the paper's table 2. One factorisation serves all steps without contact. "
        "The numbers depend on the machine, the exponents hardly.",
        list(COST.values()),
        draw_t2,
        checks_t2,
        timed=True,
    ),
    Figure(
        "B-3",
        "Elastic ball: deformed body, stress and contact forces",
        "The run of figure A-3, with von Mises stress: waves still run through the ball after "
        "the impact.",
        [PICTURE],
        lambda: draw_picture(True),
        checks_picture,
    ),
    Figure(
        "B-4",
        "Elastic ball: energy of the methods of paper B, steps of 1 ms",
        ENERGY_CAPTION + "and so does the equivalent mass matrix; Hauret and Le Tallec's "
        "penalisation dips and recovers; the two-step scheme and persistent contact change "
        "nothing.",
        with_bands(METHODS_B, FINE, FINE_BAND) + EMM_CN,
        lambda: draw_energy(METHODS_B),
        lambda: checks_energy(METHODS_B),
    ),
    Figure(
        "B-5",
        "Elastic ball: contact force and pressure of the methods of paper B",
        "Force that acts during each step and largest pressure over the time of the impact, "
        "steps of 1 ms, with the impact in the middle of a step.",
        with_bands(METHODS_B, FINE, FINE_BAND),
        draw_b5,
        checks_b5,
    ),
    Figure(
        "B-6",
        "Elastic ball: persistent contact with viscosity",
        "Energy relative to the start for linear viscosities. Without viscosity it is constant; "
        "the larger the viscosity, the more is dissipated, and the energy never rises.",
        list(VISCOUS.values()),
        draw_b6,
        checks_b6,
    ),
]
