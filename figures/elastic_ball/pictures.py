# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the ball before, during and after the impact: figures A-3 and B-3."""

import matplotlib.pyplot as plt

from shared.figure import check
from shared.pictures import body
from shared.rows import checks_of_runs
from shared.runs import Run

PICTURE = Run(
    "A-3", "fields", "elastic_ball", "elastic_ball/figure_A03.prm", ("Output/Log every=0",)
)
SNAPSHOTS = ((0, "before"), (20, "during"), (60, "after"))  # step, label


def draw_picture(stress):
    figure, axes = plt.subplots(1, 3, figsize=(12, 4.4), sharey=True)
    time = PICTURE.read()["time"]
    for panel, (step, label) in zip(axes, SNAPSHOTS):
        _, drawn = body(
            panel,
            PICTURE.field_file(step),
            arrow=4 / 2e8,
            stress=stress,
            limit=2.5e7 if stress else None,
        )
        panel.set_title(f"{label}, {1e3 * time[step]:.0f} ms")
        panel.set_xlim(-11.5, 11.5)
        panel.set_ylim(-1, 21)
        panel.set_xlabel("$x_1$ (m)")
    axes[0].set_ylabel("$x_2$ (m)")
    if stress:
        figure.colorbar(drawn, ax=axes, label="von Mises stress (Pa)", shrink=0.9)
    else:
        figure.tight_layout()
    return figure


def checks_picture():
    table = PICTURE.read()
    rows = []
    for step, label in SNAPSHOTS:
        force, _ = body(plt.figure().add_subplot(), PICTURE.field_file(step))
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
                "the ledger's contact force within 1e-5; some during the impact only",
                exact=f"{ledger:.4e}",
            )
        )
    return rows + checks_of_runs([PICTURE])
