# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the deformed ring: figures A-10 and B-7."""

import matplotlib.pyplot as plt

from shared.figure import check
from shared.pictures import body
from shared.rows import checks_of_runs


def draw_picture(one, steps, arrow, limit=None):
    figure, axes = plt.subplots(2, 3, figsize=(12, 9.5))
    time = one.read()["time"]
    for panel, step in zip(axes.flat, steps):
        _, drawn = body(panel, one.field_file(step), arrow=arrow, stress=bool(limit), limit=limit)
        extent = drawn.get_datalim(panel.transData)
        middle = extent.x0 + extent.width / 2
        panel.set_title(f"t = {time[step]:.2f} s")
        panel.set_xlim(middle - 15, middle + 15)
        panel.set_ylim(-1, 35)
    for panel in axes[:, 0]:
        panel.set_ylabel("$x_2$ (m)")
    for panel in axes[1]:
        panel.set_xlabel("$x_1$ (m)")
    if limit:
        figure.colorbar(drawn, ax=axes, label="von Mises stress (Pa)", shrink=0.8)
    else:
        figure.tight_layout()
    return figure


def checks_picture(one, steps):
    table = one.read()
    sums = []
    for step in steps:
        force, _ = body(plt.figure().add_subplot(), one.field_file(step))
        plt.close()
        sums.append((force[1], table["contact_force_foundation"][step]))
    error = max(abs(ours - ledger) / max(ledger, 1) for ours, ledger in sums)
    return [
        check(
            "sum of the arrows against the ledger's contact force, relative",
            f"{error:.1e}",
            error < 1e-5,
            "< 1e-5: fields have single precision",
            exact="0",
        ),
        check(
            "contact force of the pictures (N)",
            ", ".join(f"{ours:.2e}" for ours, _ in sums),
            sums[0][1] == 0 and sums[-1][1] == 0 and max(s[1] for s in sums) > 0,
            "none in the first and the last, some between",
        ),
    ] + checks_of_runs([one])
