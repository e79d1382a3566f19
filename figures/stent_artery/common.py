# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the figures of the stent: runs, energies and their checks."""

import numpy as np

from shared.figure import check
from shared.runs import QUIET, Run

# The viscosity that is shown with friction (MPa s); the paper's "1" has no unit.
ETA_WITH_FRICTION = "1"


def stent(figure, key, mu="0", eta="0", output=QUIET):
    """A run with friction, or with viscosity, or with both."""
    has_file = eta in ("0", "0.001", "0.01", "0.03")
    file = f"mu_{mu}" if mu != "0" else f"eta_{eta}" if eta != "0" and has_file else "default"
    overrides = list(output)
    if eta != "0" and not file.startswith("eta"):
        for part in ("Artery", "Stent"):
            overrides += [f"{part}/Viscosity=Curnier", f"{part}/Viscosity eta={eta}"]
    return Run(figure, key, "stent_artery", f"stent_artery/{file}.prm", tuple(overrides), cost=4)


# Every other step is written, for the animation.
DEPLOYMENT = stent("B-14", "fields", output=("Output/Fields every=2", "Output/Log every=0"))
STEPS = (0, 20, 30, 50)

ETAS = ("0", "0.001", "0.01", "0.03")  # MPa s
MUS = ("0", "0.1", "0.2", "0.4")
# key: mu, eta
STENTS = {("0", eta): stent("B-15", f"eta_{eta}", eta=eta) for eta in ETAS}
STENTS.update({(mu, "0"): stent("B-16", f"mu_{mu}", mu=mu) for mu in MUS[1:]})
STENTS.update(
    {
        (mu, ETA_WITH_FRICTION): stent(
            "B-16", f"mu_{mu}_eta_{ETA_WITH_FRICTION}", mu, ETA_WITH_FRICTION
        )
        for mu in MUS
    }
)


def family(mus=("0",), etas=("0",)):
    return {(mu, eta): STENTS[mu, eta] for mu in mus for eta in etas}


def dissipation(one):
    """Dissipation of friction and viscosity until each step (mJ)."""
    table = one.read()
    return table["friction_work"] + table["viscous_dissipation"]


def change(one):
    """Change of energy less the work of the imposed displacement, in each step (mJ)."""
    table = one.read()
    return np.diff(table["energy"] - table["imposed_work"])


def largest_energy(one):
    return one.read()["energy"].max()


def ledger_rows(runs):
    """The balance in each step, over the largest energy: it begins with next to none."""
    runs = list(runs)
    worst = max(
        np.abs(change(one) + np.diff(dissipation(one))).max() / largest_energy(one) for one in runs
    )
    return [
        check(
            f"largest residual of the balance in a step, {len(runs)} run{'s' * (len(runs) > 1)}",
            f"{worst:.1e}",
            worst < 1e-9,
            "< 1e-9 of the largest energy",
            exact="0",
        ),
    ]


def halvings(runs):
    return sum(int(one.read()["step_halvings"].max()) for one in runs)


def largest_change(runs):
    """The largest change of energy less work in a step of some runs, of the largest energy."""
    return max(change(one).max() / largest_energy(one) for one in runs)
