# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks of several figures of the bars."""

import numpy as np

from shared.figure import check
from shared.paper_numbers import compare

from .common import MASSES, PLAIN

TIME_STEP = 0.05  # s


def checks_of_runs(bar, runs):
    """Conditions that must hold in each run, whatever the scheme."""
    tables = [run.read() for run in runs]
    # Newton's tolerance; round-off is a thousand times less at h = 0.05, and
    # about half of it on the finest mesh of figure 10.
    residual = max(np.abs(table["balance_residual"]).max() for table in tables)
    halvings = sum(table["step_halvings"].sum() for table in tables)

    # At a jump (whole seconds) the value is arbitrary, so that only times in between are compared.
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


def gain(table):
    """The largest gain of modified energy, relative to the start."""
    return table["modified_energy"].max() / table["modified_energy"][0] - 1


def loss(table):
    """Loss of modified energy at the end, relative to the start."""
    return 1 - table["modified_energy"][-1] / table["modified_energy"][0]


def loss_rows(place, curves, runs):
    """Loss of modified energy of each curve."""
    return [
        compare(f"{place}.{curve.key}_{mass}", loss(runs[curve.key, mass].read()))
        for curve in curves
        for mass in MASSES
    ]


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


COLUMN = {"pressure": "stress_pressure", "velocity": "velocity", "displacement": "displacement"}


def variation(bar, table, quantity):
    """Total variation in time of a quantity at the ends: large when it oscillates."""
    column = COLUMN[quantity]
    return sum(np.abs(np.diff(table[f"{column}_{end.name}"][1:])).sum() for end in bar.ends)


def smoother_rows(bar, place, curves, runs, quantities):
    """Total variation with the redistributed mass over that with the consistent one."""
    rows = []
    for curve in curves:
        for quantity in quantities:
            with_mass = {m: variation(bar, runs[curve.key, m].read(), quantity) for m in MASSES}
            ratio = with_mass["redistributed"] / with_mass["consistent"]
            rows.append(compare(f"{place}.{quantity}_{curve.key}", ratio))
    return rows


def error_rows(bar, place, curves, runs):
    """Errors of displacement and velocity of the ends against the exact solution that is drawn.

    Root of the mean square over the steps, and the largest; for the velocity, which jumps at
    whole seconds, over those farther than two steps from a jump.
    """
    rows = []
    for curve in curves:
        for mass in MASSES:
            table = runs[curve.key, mass].read()
            time = table["time"]
            off_jumps = np.abs(time - np.round(time)) > 2.5 * TIME_STEP
            errors = {"displacement": [], "velocity": []}
            for end in bar.ends:
                exact = end.piecewise(end.velocity, time + 1e-9)
                errors["displacement"].append(
                    table[f"displacement_{end.name}"] - end.displacement_at(time)
                )
                errors["velocity"].append((table[f"velocity_{end.name}"] - exact)[off_jumps])
            for name, values in errors.items():
                which = f"{name}_{curve.key}_{mass}"
                rows += [
                    compare(f"{place}.{which}", np.sqrt(np.mean(np.square(values)))),
                    compare(f"{place}.largest_{which}", np.abs(values).max()),
                ]
    return rows
