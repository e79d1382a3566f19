# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks of the schemes that damp: HHT (figures 8 and 14) and TR-BDF2 (9 and 15)."""

from .common import ALPHA, ALPHAS, MASSES, PLAIN, TREATMENTS
from .rows import (
    checks_of_runs,
    checks_off_contact,
    compare,
    energy_change,
    energy_rows,
    smoother_rows,
    variation,
)


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
