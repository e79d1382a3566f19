# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hyperelastic ring: friction that depends on the slip rate.

Improved normal compliance, alpha = 2, and mu(v) = (a - b) exp(-v / v_0) + b beside Coulomb's friction
with its bounds a and b, stick exact, on a coarse mesh. Left: a = 1.5, b = 0.5, v_0 = 0.01 m/s, the numbers of A 2.3:
the ring rolls with all of them. Right: a = 0.3, b = 0.1, v_0 = 3 m/s: it slips, at first with b, as the slip is fast,
and more and more with a.
"""

import matplotlib.pyplot as plt

from shared.figure import Figure, check
from shared.measures import lost
from shared.rows import checks_of_runs, dissipative_row

from .common import COARSE, draw_lines, run, share_row


def coulomb(mu):
    overrides = (*COARSE, "Contact/Stick=exact", f"Contact/Friction coefficient={mu}")
    return run("R-7", f"coulomb_{mu}", "figure_A15_inc2.prm", overrides, cost=12)


def by_slip_rate(a, b, decay):
    overrides = (
        *COARSE,
        "Contact/Stick=exact",
        "Contact/Friction law=slip-rate dependent",
        f"Contact/Static coefficient={a}",
        f"Contact/Dynamic coefficient={b}",
        f"Contact/Slip-rate decay={decay}",
    )
    return run("R-7", f"slip_rate_{a}_{b}", "figure_A13_inc2.prm", overrides, cost=12)


CASES = [(1.5, 0.5, 100), (0.3, 0.1, 1 / 3)]
RUNS = {case: (coulomb(case[0]), by_slip_rate(*case), coulomb(case[1])) for case in CASES}
ALL = [one for runs in RUNS.values() for one in runs]


def draw():
    figure, axes = plt.subplots(1, 2, figsize=(6.8, 3), sharey=True, layout="constrained")
    for panel, (case, runs) in zip(axes, RUNS.items()):
        labels = (rf"$\mu$ = {case[0]}", r"$\mu(v)$", rf"$\mu$ = {case[1]}")
        draw_lines(panel, zip(runs, ("#0072B2", "#000000", "#D55E00"), labels))
    axes[0].set_ylabel("energy / energy at the start")
    return figure


def checks():
    rows = [dissipative_row("with friction", ALL, "modified_energy", 1e-11)]
    for case, (static, between, dynamic) in RUNS.items():
        losses = [lost(one) for one in (static, between, dynamic)]
        name = f"a = {case[0]}, b = {case[1]}"
        rows.append(share_row(name, between, "friction_work"))
        rows.append(
            check(
                f"{name}: energy lost with a, mu(v), b",
                ", ".join(f"{100 * loss:.2f} %" for loss in losses),
                min(losses[0], losses[2]) <= losses[1] <= max(losses[0], losses[2])
                or max(losses) / min(losses) < 1.1,
                "between both, or all within 10 %: it rolls",
            )
        )
    # A coefficient that falls while slipping nodes come to rest, which has several solutions in a step.
    falling = RUNS[CASES[1]][1]
    halved = int(falling.read()["step_halvings"][-1])
    rows.append(check("a = 0.3, b = 0.1: steps halved", f"{halved}", halved < 12, "below 2 %"))
    return rows + checks_of_runs([one for one in ALL if one is not falling])


FIGURE = Figure("R-7", __doc__, ALL, draw, checks)
