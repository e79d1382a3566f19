# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks of figures 16 and 17."""

from shared.figure import check
from shared.paper_numbers import compare
from shared.rows import checks_of_runs

from .common import CURVED, HARD, SCHEMES
from .measures import (
    change_before_contact,
    change_of_energy,
    hertz_force,
    largest_gain,
    peak,
    touches,
    variation,
)


def checks_series(sphere):
    place, own = f"C.figure_{sphere.number}", f"own.sphere_{sphere.name}"
    tables = {key: run.read() for key, run in sphere.runs.items()}
    rows = []
    for scheme in SCHEMES:
        table = tables[scheme.key]
        force, _ = peak(table, sphere.first_bounce)
        names = ("touches", "lifts_off", "touches_again")
        rows += [
            *(
                compare(f"{own}.{name}_{scheme.key}", time)
                for name, time in zip(names, touches(table))
            ),
            compare(f"{own}.force_{scheme.key}", force),
            compare(f"{own}.lost_{scheme.key}", -change_of_energy(table)),
        ]
        if sphere is HARD:
            exact = hertz_force(30000.0)
            rows.append(
                check(
                    f"{scheme.label}: largest force over that of Hertz's theory",
                    f"{force / exact:.3f}",
                    0.92 < force / exact < 1.08,
                    "within 8 %: a few facets carry it",
                    exact="1",
                )
            )
    hybrid = largest_gain(tables["hybrid"])
    rows.append(
        check(
            "Nitsche-hybrid: largest gain of the conserved energy in a step",
            f"{hybrid:.1e}",
            hybrid < 1e-11,
            "no gain beyond Newton's tolerance",
            exact="<= 0",
        )
    )
    swings = {key: variation(table) for key, table in tables.items()}
    lost = {key: -change_of_energy(table) for key, table in tables.items()}
    for method in ("nitsche", "alm"):
        trbdf2, hht = f"{method}_trbdf2", f"{method}_hht"
        rows += [
            compare(f"{place}.{method}_smoother", swings[trbdf2] / swings[hht]),
            compare(f"{place}.{method}_loss", lost[trbdf2] / lost[hht]),
        ]
    rows += [
        compare(f"{place}.hybrid_conserves", lost["hybrid"] / lost["nitsche_trbdf2"]),
        compare(f"{place}.hybrid_flight", change_before_contact(tables["hybrid"])),
        compare(f"{place}.hybrid_swings", swings["hybrid"] / swings["nitsche_trbdf2"]),
    ]
    runs = list(sphere.runs.values())
    if sphere is HARD:
        runs.append(CURVED)
        force, time = peak(CURVED.read(), sphere.first_bounce)
        rows += [
            compare(f"{own}.curved_force", force),
            compare(f"{own}.curved_force_time", time),
        ]
    return rows + checks_of_runs(runs)
