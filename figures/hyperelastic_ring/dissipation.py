# SPDX-License-Identifier: LGPL-2.1-or-later
"""Energy with viscosity and with friction: figures B-9 to B-11."""

from shared.curves import energy_axes
from shared.measures import lost
from shared.methods import SCALE
from shared.rows import checks_of_runs, constant_row, dissipative_row, order_row

from .common import draw_lines, run, share_row

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


def checks_family(runs, what, paper):
    """Constant without, falling with viscosity or friction, and ever more of it."""
    (_, first), *rest = runs.items()
    rows = [
        constant_row("neither viscosity nor friction", first),
        dissipative_row("with viscosity or friction", [one for _, one in rest], tolerance=1e-12),
        order_row(
            f"energy lost, {what}", [100 * lost(one) for one in runs.values()], "grows", paper
        ),
    ]
    for key, one in rest:
        name = f"mu = {key[0]}, eta = {key[1]}" if isinstance(key, tuple) else f"{key}"
        rows.append(share_row(name, one, "friction_work", "viscous_dissipation"))
    return rows + checks_of_runs(runs.values())
