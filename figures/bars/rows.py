# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks that several figures of the bars share."""

import numpy as np

from shared.figure import check, info, note

from .common import MASSES, PLAIN

TIME_STEP = 0.05  # s


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
