# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing of motion, pressure and energy: figures 6, 8, 9 and 13 to 15."""

import matplotlib.pyplot as plt
import numpy as np

from .common import MASSES
from .exact import FINAL_TIME


def draw_exact(axes, time, values):
    axes.plot(time, values, color="black", linewidth=2.0, alpha=0.9, label="exact", zorder=2)


def draw_panels(bar, curves, runs):
    """Motion of the ends, contact pressure and energy; a column for each mass."""
    rows = [
        (quantity, end) for quantity in ("displacement", "velocity", "pressure") for end in bar.ends
    ] + [("energy", None)]
    figure, axes = plt.subplots(
        len(rows), 2, figsize=(6.8, 1.5 * len(rows) + 0.6), sharex=True, sharey="row", squeeze=False
    )
    units = {"displacement": "m", "velocity": "m/s", "pressure": "Pa", "energy": "J"}
    for column, mass in enumerate(MASSES):
        tables = [runs[curve.key, mass].read() for curve in curves]
        axes[0, column].set_title(f"{mass} mass")
        axes[-1, column].set_xlabel("time (s)")
        for row, (quantity, end) in enumerate(rows):
            panel = axes[row, column]
            if quantity == "displacement":
                time = np.arange(FINAL_TIME + 1)
                draw_exact(panel, time, end.displacement_at(time))
                name = f"displacement_{end.name}"
            elif quantity == "velocity":
                draw_exact(panel, *end.steps(end.velocity))
                name = f"velocity_{end.name}"
            elif quantity == "pressure":
                # The paper plots -sigma_n(u_h), not the pressure of the method.
                draw_exact(panel, *end.steps(end.pressure))
                name = f"stress_pressure_{end.name}"
            else:
                draw_exact(panel, [0, FINAL_TIME], [bar.energy] * 2)
                name = "modified_energy"
            for curve, table in zip(curves, tables):
                # The second curve is dashed, for prints without colour.
                panel.plot(
                    table["time"],
                    table[name],
                    color=curve.colour,
                    linestyle="-" if curve is curves[0] else (0, (4, 1.2)),
                    linewidth=0.9,
                    label=curve.label,
                    zorder=3,
                )
            if column == 0:
                title = {"pressure": "contact pressure", "energy": "modified energy"}
                where = f"{end.name} end " if end and len(bar.ends) > 1 else ""
                panel.set_ylabel(
                    f"{title.get(quantity, quantity)}\n{where}({units[quantity]})", fontsize=9
                )
    axes[0, 0].set_xlim(0, FINAL_TIME)
    figure.align_ylabels()
    figure.legend(
        *axes[0, 0].get_legend_handles_labels(),
        loc="lower center",
        bbox_to_anchor=(0.5, 0.99),
        ncol=3,
    )
    figure.tight_layout()
    return figure
