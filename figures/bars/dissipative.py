# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks of the schemes that damp: HHT (figures 8 and 14) and TR-BDF2 (9 and 15)."""

from shared.paper_numbers import compare

from .common import ALPHA, ALPHAS, MASSES, TREATMENTS
from .rows import checks_of_runs, checks_off_contact, error_rows, loss, loss_rows, variation


def checks_hht(bar, place, runs):
    """Rows that figures 8 and 14 have in common: alpha = -0.02 over 0.05."""
    rows = []
    for mass in MASSES:
        positive, negative = (runs[key, mass].read() for key in ALPHA)
        swings = [variation(bar, table, "velocity") for table in (positive, negative)]
        rows += [
            compare(f"{place}.swing_{mass}", swings[1] / swings[0]),
            compare(f"{place}.loss_{mass}", loss(negative) / loss(positive)),
        ]
    own = f"own.{bar.program}_hht"
    return (
        rows
        + loss_rows(own, ALPHAS, runs)
        + error_rows(bar, own, ALPHAS, runs)
        + checks_off_contact(bar, ALPHAS, runs, ALPHA)
        + checks_of_runs(bar, runs.values())
    )


def checks_tr_bdf2(bar, place, runs, hht):
    """Rows that figures 9 and 15 have in common: Nitsche with TR-BDF2 over HHT."""
    rows = []
    for mass in MASSES:
        ours = runs["nitsche", mass].read()
        for number, key in enumerate(ALPHA):
            other = hht[key, mass].read()
            swings = [variation(bar, table, "velocity") for table in (ours, other)]
            rows += [
                compare(f"{place}.swing_{mass}_{number}", swings[0] / swings[1]),
                compare(f"{place}.loss_{mass}_{number}", loss(ours) / loss(other)),
            ]
    own = f"own.{bar.program}_tr_bdf2"
    return (
        rows
        + loss_rows(own, TREATMENTS, runs)
        + error_rows(bar, own, TREATMENTS, runs)
        + checks_off_contact(bar, TREATMENTS, runs)
        + checks_of_runs(bar, runs.values())
    )
