# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: improved normal compliance with friction.

Energy relative to the start with Coulomb's friction, mu = 0.2, c_tau = 1e9 Pa s/m, for alpha = 2,
3 and 4. It falls by the work of friction.
"""

from shared.curves import energy_axes
from shared.figure import Figure, check
from shared.measures import lost
from shared.methods import INC, SCALE
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, dissipative_row

from .common import draw_lines, rigid_row, run, share_row

RUNS = {a: run("A-15", f"inc{a}") for a in (2, 3, 4)}
SOFTER = {
    a: run(
        "A-15", f"inc{a}_softer", f"figure_A15_inc{a}.prm", ("Contact/Tangential compliance=1e6",)
    )
    for a in RUNS
}


def draw():
    figure, axes = energy_axes()
    draw_lines(axes, zip(RUNS.values(), SCALE, (INC[a].label for a in RUNS)))
    return figure


def checks():
    # Friction this stiff multiplies Newton's tolerance.
    rows = [dissipative_row("with friction", RUNS.values(), "modified_energy", 1e-11)]
    for a, one in RUNS.items():
        rows.append(share_row(INC[a].name, one, "friction_work"))
        rows.append(rigid_row(INC[a].name, 0.2, one))
        rows.append(compare(f"A.figure_15.lost_{a}", lost(one)))
    losses = [lost(one) for one in RUNS.values()]
    rows.append(compare("A.figure_15.differs", max(losses) / min(losses)))
    change = max(abs(lost(RUNS[a]) / lost(SOFTER[a]) - 1) for a in RUNS)
    rows.append(
        check(
            "energy lost with c_tau = 1e6 Pa s/m: relative change",
            f"{change:.3f}",
            change < 0.02,
            "< 2 %: points stick well enough for the regularisation not to count",
        )
    )
    return rows + checks_of_runs([*RUNS.values(), *SOFTER.values()])


FIGURE = Figure("A-15", __doc__, [*RUNS.values(), *SOFTER.values()], draw, checks)
