# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colliding disks: three treatments.

Above: energy, and the work of friction, for three collisions. Below: output of the program.
Energy left counts vibrations; the drift is the largest of the three momenta, over the momentum of
a disk (times 1 m).
"""

import matplotlib.pyplot as plt
import numpy as np

from shared.figure import Figure, check
from shared.paper_numbers import compare
from shared.rows import checks_of_runs

from .common import CASES, MOMENTA, TREATMENTS, disks, momenta_row, printed

RUNS = {
    (key, *case): disks("D-2", f"{key}_b_{case[0]}_mu_{case[1]}", key, case)
    for key in TREATMENTS
    for case in CASES
}
HEADER = (
    "treatment",
    "offset, friction",
    "velocity left (m/s)",
    "velocity right (m/s)",
    "restitution",
    "energy left",
    "drift of momenta",
    "penetration (mm)",
)


def table_of_disks():
    rows = []
    for (key, offset, mu), one in RUNS.items():
        values = printed(one)
        mass = one.read()["momentum_x_left"][0]
        drift = max(abs(values[f"drift_{name}"]) for name in MOMENTA)
        deep = 1e3 * values["penetration"]
        rows.append(
            [
                TREATMENTS[key][1],
                rf"$b$ = {offset} m, $\mu$ = {mu}",
                "({velocity_x_left:.5f}, {velocity_y_left:.5f})".format(**values),
                "({velocity_x_right:.5f}, {velocity_y_right:.5f})".format(**values),
                f"{values['restitution']:.5f}",
                f"{values['energy_left_over']:.6f}",
                f"{drift / mass:.0e}",
                f"{deep:.3f}" if deep > 1e-6 else "0",
            ]
        )
    return rows


def draw():
    figure = plt.figure(figsize=(14, 9.4), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=(1.15, 1))
    for column, (offset, mu) in enumerate(CASES):
        axes = figure.add_subplot(grid[0, column])
        for key, (_, text, colour) in TREATMENTS.items():
            table = RUNS[key, offset, mu].read()
            axes.plot(
                table["time"],
                (table["energy"] + table["friction_work"]) / table["energy"][0],
                color=colour,
                linestyle=(0, (4, 3)) if key == "persistent" else "-",
                label=text,
                zorder=4 if key == "persistent" else 3,
            )
        axes.set_title(rf"offset {offset} m, $\mu$ = {mu}")
        axes.set_xlabel("time (s)")
        axes.set_xlim(0, table["time"][-1])
    figure.axes[0].set_ylabel("energy and work of friction,\nover the energy at the start")
    figure.axes[0].legend(fontsize=8.5)
    axes = figure.add_subplot(grid[1, :])
    axes.axis("off")
    table = axes.table(
        cellText=table_of_disks(),
        colLabels=HEADER,
        loc="center",
        cellLoc="center",
        colWidths=[0.15, 0.13, 0.16, 0.16, 0.09, 0.09, 0.11, 0.11],
    )
    table.auto_set_font_size(False)
    table.set_fontsize(9)
    table.scale(1, 1.6)
    for (row, _), cell in table.get_celld().items():
        cell.set_edgecolor("0.8")
        if row == 0:
            cell.set_facecolor("0.93")
    return figure


def checks():
    def of(treatment):
        return [one for key, one in RUNS.items() if key[0] == treatment]

    rows = []
    for key, name in (("persistent", "energy"), ("inc", "energy, contact potential")):
        worst = 0.0
        for one in of(key):
            table = one.read()
            kept = table["modified_energy"] + table["friction_work"]
            worst = max(worst, np.abs(kept / kept[0] - 1).max())
        rows.append(
            check(
                f"{TREATMENTS[key][0]}: max change of {name} and work of friction",
                f"{worst:.1e}",
                worst < 1e-9,
                "< 1e-9 of the energy: Newton's tolerance, summed over the steps",
                exact="0",
            )
        )
    worst = 0.0
    for one in of("inc"):
        table = one.read()
        free = np.flatnonzero(table["active_points_disks"] == 0)
        kept = (table["energy"] + table["friction_work"]) / table["energy"][0]
        worst = max(worst, np.abs(kept[free] - 1).max())
    rows.append(
        check(
            "improved normal compliance: the same of energy and friction when nothing touches",
            f"{worst:.1e}",
            worst < 1e-9,
            "< 1e-9 of the energy: it comes back",
            exact="0",
        )
    )
    rise, lost = -np.inf, []
    for one in of("signorini"):
        table = one.read()
        kept = (table["energy"] + table["friction_work"]) / table["energy"][0]
        rise = max(rise, np.diff(kept).max())
        lost.append(1 - kept[-1])
    rows += [
        check(
            "Signorini: largest rise of energy and work of friction in a step",
            f"{rise:.1e}",
            rise <= 1e-12,
            "at most 1e-12 of the energy: it only loses",
            exact="<= 0",
        ),
        *(
            compare(f"own.collisions.{name}", part)
            for name, part in zip(("head_on", "oblique", "friction"), lost)
        ),
        check(
            "Signorini: largest penetration (m)",
            f"{max(printed(one)['penetration'] for one in of('signorini')):.1e}",
            all(printed(one)["penetration"] < 1e-12 for one in of("signorini")),
            "< 1e-12: round-off",
            exact="0",
        ),
    ]
    for case in CASES:
        values = [printed(RUNS[key, *case]) for key in TREATMENTS]
        restitution = [v["restitution"] for v in values]
        spread = max(restitution) - min(restitution)
        rows.append(
            check(
                f"b = {case[0]} m, mu = {case[1]}: restitution, the three treatments",
                ", ".join(f"{x:.5f}" for x in restitution),
                spread < 0.01,
                "within 0.01 of each other",
            )
        )
    mass = RUNS["persistent", "0", "0"].read()["momentum_x_left"][0]
    return rows + [momenta_row(RUNS.values(), mass)] + checks_of_runs(RUNS.values())


FIGURE = Figure("D-2", __doc__, list(RUNS.values()), draw, checks)
