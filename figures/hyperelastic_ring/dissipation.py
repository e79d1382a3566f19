# SPDX-License-Identifier: LGPL-2.1-or-later
"""Energy with viscosity and with friction: figures B-9 to B-11."""

from shared.curves import energy_axes
from shared.measures import lost, smallest_factor
from shared.methods import SCALE
from shared.paper_numbers import compare
from shared.rows import checks_of_runs, dissipative_row

from .common import draw_lines, run

B9 = {eta: run("B-9", f"eta_{eta}") for eta in (0, 100, 400, 1600)}
B10 = {"0": B9[0]}
B10.update({mu: run("B-10", f"mu_{mu}") for mu in ("0.1", "0.2", "0.3")})
B11 = {("0", 0): B9[0], ("0.1", 0): B10["0.1"]}
B11.update({("0.1", eta): run("B-11", f"mu_0.1_eta_{eta}") for eta in (100, 400)})


def draw_family(runs, label):
    figure, axes = energy_axes()
    lines = zip(runs.values(), ("#D55E00", *SCALE), (label(key) for key in runs))
    draw_lines(axes, lines)
    return figure


def taken(one):
    """Dissipation of friction and viscosity, over the initial energy."""
    table = one.read()
    return (table["friction_work"] + table["viscous_dissipation"])[-1] / table["energy"][0]


def checks_family(place, runs, names):
    """Rows of the numbers of `place`: losses, growing, to friction and viscosity alone.

    `names`: of the numbers of the losses, by the keys of the runs.
    """
    rest = list(runs.values())[1:]
    return [
        compare(f"{place}.grows", smallest_factor([lost(one) for one in rest])),
        compare(f"{place}.of_the_model", max(abs(taken(one) - lost(one)) for one in rest)),
        *(compare(f"{place}.{name}", lost(runs[key])) for key, name in names.items()),
        dissipative_row("with viscosity or friction", rest),
    ] + checks_of_runs(runs.values())
