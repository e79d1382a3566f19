# SPDX-License-Identifier: LGPL-2.1-or-later
"""Energy with viscosity and with friction: figures B-15 and B-16."""

from shared.methods import SCALE

from .common import change, dissipation


def draw_steps(left, right, runs, name):
    for (key, one), colour in zip(runs.items(), ("#000000", *SCALE[1:])):
        table = one.read()
        left.plot(table["time"][1:], 1e3 * change(one), color=colour, label=name(*key))
        right.plot(table["time"], dissipation(one), color=colour, label=name(*key))
    left.set_ylabel(r"$\Delta E - \Delta W$ in a step ($\mu$J)")
    right.set_ylabel("dissipated until then (mJ)")
    right.legend(fontsize=9, loc="upper left")
    for panel in (left, right):
        panel.set_xlim(0, 1)
        panel.set_xlabel("time (s)")
