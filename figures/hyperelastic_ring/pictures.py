# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the deformed ring: figures A-10 and B-7."""

import matplotlib.pyplot as plt

from shared.figure import check
from shared.pictures import body, draw_arrow, draw_ground, scale_bar
from shared.rows import checks_of_runs

# Where the six pictures stand (m): the middle of the ring and the foundation's surface. The
# last ring is in the air, and nothing is drawn below it.
PLACES = ((10.5, 17.5), (32.5, 17.5), (57.5, 17.5), (15.5, 5.5), (15.5, -7.0), (43.5, None))
LAST_BOTTOM = -7.0  # m, of the last one
ARROW = 8 / 2e5  # m per N


def draw_picture(one, steps, limit=None):
    """Six pictures of the same scale in one panel."""
    figure, axes = plt.subplots(figsize=(6.8, 4.5))
    time = one.read()["time"]
    for step, (middle, ground) in zip(steps, PLACES):
        place = body(plt.figure().add_subplot(), one.field_file(step))[2]
        plt.close()
        extent = 0.5 * (place[:, 0].min() + place[:, 0].max())
        lowest = place[:, 1].min()
        up = LAST_BOTTOM - lowest if ground is None else ground
        _, drawn, place = body(
            axes, one.field_file(step), ARROW, limit, (middle - extent, up), lines=False
        )
        left, right = place[:, 0].min(), place[:, 0].max()
        text = f"{time[step]:.1f} s"
        if ground is None:
            text += f",\n{lowest:.0f} m up" if lowest > 5 else f",\n{lowest:.1f} m up"
        else:
            draw_ground(axes, left - 1, right + 1, ground)
        # Inside the ring where it is wide open, else above it.
        top = place[:, 1].max()
        inside = top - place[:, 1].min() > 12
        y = 0.5 * (top + place[:, 1].min()) if inside else top + 0.6
        axes.text(middle, y, text, ha="center", va="center" if inside else "bottom")
    scale_bar(axes, 57, -5.0, 10)
    draw_arrow(axes, (58.5, 0.5), (58.5, 0.5 + 1e5 * ARROW))
    axes.text(59.7, 0.5 + 0.5e5 * ARROW, "contact force\n100 kN", va="center", fontsize=9)
    axes.set(xlim=(-1, 72), ylim=(-8, 38.5))
    axes.axis("off")
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1)
    if limit:
        drawn.set_clim(0, limit)
        bar = figure.colorbar(
            drawn,
            cax=axes.inset_axes([58, 12, 12.5, 0.9], transform=axes.transData),
            orientation="horizontal",
            extend="max",
            ticks=[0, limit / 2, limit],
            format=lambda stress, _: f"{stress / 1e3:g}",
        )
        bar.set_label("von Mises (kPa)")
    return figure


def checks_picture(one, steps):
    table = one.read()
    sums = []
    for step in steps:
        force = body(plt.figure().add_subplot(), one.field_file(step))[0]
        plt.close()
        sums.append((force[1], table["contact_force_foundation"][step]))
    error = max(abs(ours - ledger) / max(ledger, 1) for ours, ledger in sums)
    return [
        check(
            "sum of the arrows against the table's contact force, relative",
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
