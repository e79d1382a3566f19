# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the ball before, during and after the impact: figures A-3 and B-3."""

import matplotlib.pyplot as plt

from shared.figure import check
from shared.pictures import bare, body, draw_arrow, draw_ground, scale_bar
from shared.rows import checks_of_runs
from shared.runs import Run

PICTURE = Run(
    "A-3", "fields", "elastic_ball", "elastic_ball/figure_A03.prm", ("Output/Log every=0",)
)
SNAPSHOTS = ((0, "before"), (20, "during"), (60, "after"))  # step, label


ARROW = 4 / 2e8  # m per N
LIMIT = 2.5e7  # Pa


def draw_picture(stress):
    figure, axes = plt.subplots(1, 3, figsize=(6.8, 3.2 if stress else 2.9), sharey=True)
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.2 if stress else 0.01, wspace=0.03)
    time = PICTURE.read()["time"]
    for panel, (step, label) in zip(axes, SNAPSHOTS):
        limit = LIMIT if stress else None
        drawn = body(panel, PICTURE.field_file(step), ARROW, limit)[1]
        draw_ground(panel, -11, 11)
        bare(panel, f"{label}, {1e3 * time[step]:.0f} ms", (-11, 11), (-4.6, 20.8))
        panel.axis("off")
    scale_bar(axes[0], -2.5, -4, 5)
    draw_arrow(axes[1], (-5, -3), (-5 + 2e8 * ARROW, -3))
    axes[1].text(0, -3, "200 MN", fontsize=9, va="center")
    if stress:
        bar = figure.colorbar(
            drawn,
            cax=figure.add_axes([0.25, 0.13, 0.5, 0.035]),
            orientation="horizontal",
            extend="max",
            format=lambda value, _: f"{value / 1e6:g}",
        )
        bar.set_label("von Mises stress (MPa)")
    return figure


def checks_picture():
    table = PICTURE.read()
    rows = []
    for step, label in SNAPSHOTS:
        force = body(plt.figure().add_subplot(), PICTURE.field_file(step))[0]
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
                "the table's contact force within 1e-5; some during the impact only",
                exact=f"{ledger:.4e}",
            )
        )
    return rows + checks_of_runs([PICTURE])
