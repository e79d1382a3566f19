# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the figures of the ring: runs of the methods, curves, losses and their causes."""

from shared.curves import curve, legend_above
from shared.figure import check
from shared.measures import energy, lost
from shared.methods import INC, PERSISTENT, SIGNORINI, SNC, TWO_STEP, band
from shared.runs import QUIET, Run, with_overrides

GAP = 0.55  # m, of default.prm
AGAINST = "time since the ring touches (s)"


def run(figure, key, file=None, overrides=(), cost=20.0):
    """A run; the file is figure_FIGURE_KEY.prm unless it is named."""
    file = file or f"figure_{figure[0]}{int(figure[2:]):02}_{key}.prm"
    return Run(
        figure,
        key,
        "hyperelastic_ring",
        f"hyperelastic_ring/{file}",
        (*QUIET, *overrides),
        cost=cost,
    )


# The mesh of the papers.
METHODS = (SIGNORINI, SNC, TWO_STEP, INC[2], PERSISTENT)
FULL = {method.key: run("A-11", method.key, cost=20) for method in METHODS}
FULL.update({INC[a].key: run("A-13", INC[a].key, cost=20) for a in (3, 4, 5)})
# The ring lifts off for good before 6 s.
BANDS = {
    key: band(with_overrides(FULL[key], "Time/Final time=6"), 5, 1e-2, 12)
    for key in ("signorini", "snc", "two_step", "persistent", "inc2", "inc3")
}
# For scans of many runs.
COARSE = ("Mesh/Nodes around=64", "Mesh/Nodes across=5", "Time/Final time=6")
EXPONENTS = (2, 3, 4, 5)


def draw_lines(axes, runs, start=GAP):
    """Curves, from a list of run, colour and label."""
    for one, colour, label in runs:
        curve(axes, one, energy, start, colour, label, 1.0)
    axes.set_xlabel(AGAINST)
    legend_above(axes)


def share_row(name, one, *columns):
    """The loss is the dissipation of friction and viscosity."""
    table = one.read()
    taken = sum(table[column][-1] for column in columns) / table["energy"][0]
    error = abs(taken - lost(one))
    return check(
        f"{name}: energy lost less the work of {' and '.join(c.split('_')[0] for c in columns)}",
        f"{error:.1e}",
        error < 1e-9,
        "< 1e-9 of the energy: nothing else dissipates",
        exact="0",
    )


def rigid_loss(mu):
    """Energy that a rigid ring loses that rebounds with the speed it came with.

    The ring slides with friction mu until it rolls; the two components of its velocity are equal.
    """
    inertia = (9**2 + 10**2) / (2 * 10**2)  # over mass and outer radius squared
    impulse = min(2 * mu, inertia / (1 + inertia))  # over mass and speed
    return (1 - (1 - impulse) ** 2 - impulse**2 / inertia) / 2


def rigid_row(name, mu, one, paper="-"):
    """A soft ring rebounds more slowly, as it vibrates: it loses less than a rigid one."""
    rigid = rigid_loss(mu)
    return check(
        f"{name}: energy lost, and by a rigid ring that rebounds elastically",
        f"{100 * lost(one):.2f} %, {100 * rigid:.2f} %",
        0.5 * rigid < lost(one) < rigid,
        "between half of the rigid ring's and all of it",
        paper,
    )
