# SPDX-License-Identifier: LGPL-2.1-or-later
"""Motion, force and energy against time: figures 16 and 17."""

import matplotlib.pyplot as plt

from .common import AUGMENTED, CURVED, HARD, NITSCHE
from .measures import conserved

QUANTITIES = (
    ("lowest_displacement", "displacement of the lowest point (m)"),
    ("lowest_velocity", "velocity of the lowest point (m/s)"),
    ("contact_force_foundation", "contact force (N)"),
    (None, "modified energy less work of gravity (J)"),
)


def draw_series(sphere):
    figure, axes = plt.subplots(4, 2, figsize=(13, 14), sharex=True)
    for column, schemes in enumerate((NITSCHE, AUGMENTED)):
        for row, (name, label) in enumerate(QUANTITIES):
            panel = axes[row, column]
            for scheme in schemes:
                table = sphere.runs[scheme.key].read()
                values = table[name] if name else conserved(table)
                panel.plot(
                    table["time"], values, color=scheme.colour, label=scheme.label, linewidth=0.9
                )
            if sphere is HARD and column == 0:
                table = CURVED.read()
                values = table[name] if name else conserved(table)
                panel.plot(
                    table["time"],
                    values,
                    color="#CC79A7",
                    label="Nitsche, Crank-Nicolson, curved cells",
                    linewidth=0.9,
                )
            panel.set_ylabel(label)
        axes[0, column].legend(loc="upper center", ncol=2, fontsize=9)
        axes[-1, column].set_xlabel("time (s)")
    figure.tight_layout()
    return figure
