# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers that characterise a run, each with its definition."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .names import Named
from .tables import Array, Table

# A force below this part of the largest one is round-off, not contact.
_ROUND_OFF = 1e-10


def contacts(table: Table) -> list[str]:
    """The names of the contacts of a table, from its columns `contact_force_NAME`."""
    begin = "contact_force_"
    return [name[len(begin) :] for name in table.columns if name.startswith(begin)]


def contact_force(table: Table) -> Array:
    """The sum of the forces of all contacts, at each row."""
    return sum(
        (table[f"contact_force_{name}"] for name in contacts(table)),
        start=np.zeros(len(table)),
    )


def touching(table: Table, name: str | None = None) -> Array:
    """Whether there is force in a contact, at each row; of all contacts without a name."""
    names = contacts(table) if name is None else [name]
    result = np.zeros(len(table), dtype=bool)
    for each in names:
        force = np.nan_to_num(np.abs(table[f"contact_force_{each}"]))
        result |= force > _ROUND_OFF * force.max(initial=0.0)
    return result


def work_from_outside(table: Table) -> Array:
    """The work of loads, of imposed displacements and of moving obstacles up to each row."""
    columns = ("external_work", "imposed_work", "obstacle_work")
    return sum((table[name] for name in columns if name in table), start=np.zeros(len(table)))


def begins_at_rest(table: Table) -> bool:
    """Whether the first energy is negligible beside the largest one: bodies at rest, or nearly."""
    energy = table["energy"]
    return not energy[0] > 1e-9 * np.nanmax(energy)


def energy_scale(table: Table) -> float:
    """Scale of energies: the first one, or for bodies that begin at rest the largest one."""
    energy = table["energy"]
    return float(np.nanmax(energy)) if begins_at_rest(table) else float(energy[0])


def has_work_from_outside(table: Table) -> bool:
    """Whether loads, imposed displacements or moving obstacles work on the bodies."""
    work = np.abs(work_from_outside(table)).max(initial=0.0)
    return bool(work > 1e-12 * np.nanmax(table["energy"]))


def change_of_energy(table: Table, column: str = "energy") -> Array:
    """By how much an energy has changed since the first row, without the work from outside.

    As a part of `energy_scale`; of "modified_energy" the change of itself.
    """
    change: Array = table[column] - table[column][0] - work_from_outside(table)
    return change / (energy_scale(table) or 1.0)


def largest_balance_residual(table: Table) -> float:
    """By how much the energy balance of a step fails to close at most.

    The scale is the largest sum so far of the absolute values of energies and works.
    """
    if "balance_residual" not in table:
        return float("nan")
    return float(np.nanmax(np.abs(table["balance_residual"])))


def largest_promise_residual(table: Table) -> float:
    """Largest deviation of the total energy from the promise of contact, on the scale of the
    balance.

    Where nothing is promised, by how much it has risen; not a number without a potential.
    """
    if "promise_residual" not in table or np.isnan(table["promise_residual"]).all():
        return float("nan")
    return float(np.nanmax(table["promise_residual"]))


def energy_lost(table: Table) -> float:
    """The part of the energy that is gone at the end.

    This is (E_first + work from outside - E_last) / E_first, with the largest energy in place of
    the first one if it begins at rest. Negative if there is more than there should be.
    """
    energy = table["energy"]
    scale = energy_scale(table)
    lost = float(energy[0] + work_from_outside(table)[-1] - energy[-1])
    return lost / scale if scale > 0 else float("nan")


#: Columns of what takes energy; their sum is what is lost.
LOSSES: dict[str, tuple[str, ...]] = {
    "contact": ("contact_work", "obstacle_work"),
    "friction": ("friction_work",),
    "viscosity": ("viscous_dissipation",),
    "scheme": ("numerical_dissipation",),
}


def part_lost(table: Table, what: str) -> float:
    """The part of the energy that one of LOSSES has taken, over the scale of energy_lost().

    That of contact has what its potential still stores.
    """
    scale = energy_scale(table)
    taken = sum(float(table[column][-1]) for column in LOSSES[what] if column in table)
    return taken / scale if scale > 0 else float("nan")


def duration(table: Table, name: str | None = None) -> float:
    """The length of all steps at whose end there is force in a contact, together."""
    return float(np.diff(table["time"])[touching(table, name)[1:]].sum())


@dataclass(frozen=True)
class Approach:
    """How a body comes to its first contact."""

    #: When the smallest gap is zero, were the body to fly on as in the last two rows before.
    time: float
    #: How fast the gap gets smaller then.
    speed: float


def first_approach(table: Table) -> Approach | None:
    """The first approach of a run; None if nothing touches, or touches from the first step on."""
    names = contacts(table)
    rows = np.flatnonzero(touching(table))
    if not len(rows):
        return None
    time, gaps = table["time"], np.min([table[f"smallest_gap_{name}"] for name in names], axis=0)
    # A treatment may answer in the step after that in which a point comes into the obstacle.
    last = int(rows[0]) - 1
    while last > 0 and not gaps[last] > 0:
        last -= 1
    # At the change of a phase there are two rows of one time.
    if last < 1 or time[last] == time[last - 1]:
        return None
    speed = float((gaps[last - 1] - gaps[last]) / (time[last] - time[last - 1]))
    return Approach(float(time[last] + gaps[last] / speed), speed) if speed > 0 else None


def turns_at_start(parameters: Mapping[str, str]) -> bool:
    """Whether a body may turn at the start, by the parameters of the run."""
    words = ("spin", "angular velocity")
    values = [v for name, v in parameters.items() if any(w in name.lower() for w in words)]
    return any(re.search(r"[^0., ]", value) for value in values)


def restitution(table: Table, log: str = "", turns: bool = True) -> float | None:
    """The coefficient of restitution of a collision, or None where it has no meaning.

    This is e = -(w_after . n) / (w_before . n). There w is the velocity of the centre of mass, of
    two bodies that of one relative to the other, in the rows before the first and after the
    last force of contact; n is the normal of contact.

    Where the program prints it itself, that number is taken (it knows masses and normal).
    Otherwise n is the direction of the momentum that is exchanged, which is the normal without
    friction; with friction it is the vertical for a contact called `foundation`, and for others
    there is no number. The momenta must be in the table. Of two bodies the masses are found
    from momenta and kinetic energies at the start, so that they must not turn then: `turns` is
    false if that is known; otherwise only bodies without any angular momentum are taken. It needs a collision: one contact only, no contact at the
    beginning and at the end, no work from outside.
    """
    match = re.search(r"^restitution\s+(\S+)\s*$", log, re.MULTILINE)
    if match:
        try:
            return float(match.group(1))
        except ValueError:
            return None
    names = [name for name in contacts(table) if touching(table, name).any()]
    if len(names) != 1 or energy_scale(table) <= 0:
        return None
    active = touching(table)
    if active[0] or active[-1]:
        return None
    if np.abs(work_from_outside(table)).max() > 1e-9 * energy_scale(table):
        return None
    before, after = np.flatnonzero(active)[0] - 1, len(active) - 1
    axes = [axis for axis in "xyz" if f"momentum_{axis}" in table]
    if not axes:
        return None

    def momentum(row: int, body: str = "") -> Array:
        return np.array([table[f"momentum_{axis}{body}"][row] for axis in axes])

    bodies = [name[len("momentum_x") :] for name in table.columns if name.startswith("momentum_x_")]
    friction = np.abs(table["friction_work"]).max() if "friction_work" in table else 0.0
    has_friction = friction > 1e-12 * energy_scale(table)
    if len(bodies) <= 1:
        first, last = momentum(before), momentum(after)
        if not has_friction:
            normal = last - first
        elif names[0] == "foundation":
            normal = np.eye(len(axes))[-1]
        else:
            return None
    elif len(bodies) == 2 and not has_friction:
        # Masses are not in the table. The bodies fly without deformation at first, so that
        # p^2 / (2 T) is the mass of one that does not turn.
        # No other force may act on them, such as the reaction of a held boundary.
        exchanged = [momentum(after, body) - momentum(before, body) for body in bodies]
        if np.linalg.norm(exchanged[0] + exchanged[1]) > 1e-6 * np.linalg.norm(exchanged[0]):
            return None
        masses = []
        for body in bodies:
            if f"kinetic_energy{body}" not in table or not _flies(table, axes, body, turns):
                return None
            masses.append(
                float(momentum(0, body) @ momentum(0, body) / 2 / table[f"kinetic_energy{body}"][0])
            )
        first, last = (
            momentum(row, bodies[1]) / masses[1] - momentum(row, bodies[0]) / masses[0]
            for row in (before, after)
        )
        normal = exchanged[0]
    else:
        return None
    approach = float(first @ normal)
    return -float(last @ normal) / approach if approach != 0 else None


def _flies(table: Table, axes: list[str], body: str, turns: bool) -> bool:
    """Whether a body moves at the start, is not deformed and does not turn.

    A spin would show in the angular momentum; that of a body which flies past the origin has
    another part.
    """
    energy = table[f"kinetic_energy{body}"][0]
    elastic = table[f"elastic_energy{body}"][0] if f"elastic_energy{body}" in table else 0.0
    if energy <= 0 or elastic > 1e-9 * energy:
        return False
    if not turns:
        return True
    spins = [
        name for name in table.columns if re.fullmatch(rf"angular_momentum(_[xyz])?{body}", name)
    ]
    momentum = np.sqrt(sum(table[f"momentum_{axis}{body}"][0] ** 2 for axis in axes))
    return bool(spins) and all(abs(table[name][0]) <= 1e-9 * momentum for name in spins)


@dataclass(frozen=True)
class ContactMeasures:
    """Numbers of one contact, in the units of the table."""

    #: The largest force, and when.
    largest_force: float
    time_of_largest_force: float
    #: The deepest point of the run, 0 without any.
    largest_penetration: float
    #: Time with force, see `measures.duration`.
    duration: float
    #: Times of the first and of the last row with force; None if it never touches.
    first_touch: float | None
    last_touch: float | None
    #: That of summary.json: velocity of separation over that of approach, of the centres of mass,
    #: along the change of the relative velocity. None where there is none.
    restitution: float | None = None


@dataclass(frozen=True)
class Summary:
    """The most important numbers of a run; `print` shows them with their units."""

    #: How many steps the table has, and the time of the last one.
    steps: int
    end: float
    #: As a part of the first energy, or of the largest one if it begins at rest; see
    #: `measures.energy_lost`.
    energy_lost: float
    #: See `measures.restitution`; where the table has none, that of the one contact that has one
    #: in summary.json.
    restitution: float | None
    #: Largest force of each contact.
    largest_force: dict[str, float]
    #: Largest penetration of all contacts.
    largest_penetration: float
    #: Time with force in any contact, see `measures.duration`.
    contact_duration: float
    #: Newton iterations of all steps.
    newton_iterations: int
    #: How often a step was halved.
    step_halvings: int
    #: How many steps were solved by each strategy, and needed each fallback.
    solvers: dict[str, int]
    #: See `measures.largest_balance_residual`.
    largest_balance_residual: float
    #: See `measures.largest_promise_residual`.
    largest_promise_residual: float
    #: More of each contact.
    contacts: dict[str, ContactMeasures]
    units: dict[str, str]
    #: Reference of the energy lost: "first" or "largest".
    energy_scale: str = "first"

    def __str__(self) -> str:
        time, length = self.units.get("time", ""), _unit(self.units, "penetration_")
        force = _unit(self.units, "contact_force_")
        lines = [
            f"{'steps':<26} {self.steps}, until {self.end:.6g} {time}",
            f"{'energy lost':<26} {100 * self.energy_lost:.4g} % of the {self.energy_scale} energy",
        ]
        if self.restitution is not None:
            lines.append(f"{'restitution':<26} {self.restitution:.6g}")
        for name, contact in self.contacts.items():
            lines.append(
                f"{'largest force':<26} {contact.largest_force:.6g} {force} at "
                f"{contact.time_of_largest_force:.6g} {time} ({name})"
            )
        lines += [
            f"{'largest penetration':<26} {self.largest_penetration:.6g} {length}",
            f"{'contact lasts':<26} {self.contact_duration:.6g} {time}",
            f"{'Newton iterations':<26} {self.newton_iterations}, {self.step_halvings} halvings",
            f"{'solved by':<26} {', '.join(f'{k} {n}' for k, n in self.solvers.items()) or '-'}",
            f"{'largest balance residual':<26} {self.largest_balance_residual:.3g}",
            f"{'largest promise residual':<26} {self.largest_promise_residual:.3g}",
        ]
        return "\n".join(lines)


#: The numbers whose sum is the column `solver`, as in `lib/solvers/solver_report.cc`; those from 16
#: on are fallbacks.
SOLVERS = {
    1: "direct",
    2: "multigrid",
    4: "condensed",
    8: "frozen tangent",
    16: "tangent made anew within the step",
    32: "condensed iterations begun anew",
    64: "whole system instead of the condensed one",
    128: "factored instead of iterated",
    256: "stage begun again from the last state",
    512: "pseudo-transient continuation",
}


def solvers(table: Table) -> dict[str, int]:
    """How many steps were solved by each strategy, and needed each fallback."""
    numbers = table["solver"][1:].astype(int) if "solver" in table else np.zeros(0, int)
    counts = {name: int(np.count_nonzero(numbers & number)) for number, name in SOLVERS.items()}
    return {name: count for name, count in counts.items() if count}


def _unit(units: dict[str, str], begin: str) -> str:
    """The unit of the first column whose name begins so."""
    return next((unit for name, unit in units.items() if name.startswith(begin)), "")


def measure_contact(
    table: Table, name: str, restitution: float | None = None
) -> ContactMeasures:
    """The numbers of one contact; its restitution is in none of the columns."""
    time, force = table["time"], table[f"contact_force_{name}"]
    rows = np.flatnonzero(touching(table, name))
    largest = int(np.nanargmax(force))
    depth = table[f"penetration_{name}"] if f"penetration_{name}" in table else np.zeros(1)
    return ContactMeasures(
        largest_force=float(force[largest]),
        time_of_largest_force=float(time[largest]),
        largest_penetration=float(np.nanmax(depth)),
        duration=duration(table, name),
        first_touch=float(time[rows[0]]) if len(rows) else None,
        last_touch=float(time[rows[-1]]) if len(rows) else None,
        restitution=restitution,
    )


def summarise(
    table: Table,
    log: str = "",
    turns: bool = True,
    restitutions: Mapping[str, float] | None = None,
) -> Summary:
    """The summary of an energy table; `log` is the text of log.txt, `turns` as for
    `restitution`, `restitutions` those of contacts in summary.json."""
    names, known = contacts(table), restitutions or {}
    each = Named("contact", {name: measure_contact(table, name, known.get(name)) for name in names})
    of_run = restitution(table, log, turns)
    if of_run is None and len(known) == 1:
        [of_run] = known.values()

    def column(name: str) -> Array:
        return table[name] if name in table else np.zeros(1)

    return Summary(
        steps=len(table) - 1,
        end=float(table["time"][-1]),
        energy_lost=energy_lost(table),
        restitution=of_run,
        largest_force=Named("contact", {name: each[name].largest_force for name in names}),
        largest_penetration=max((c.largest_penetration for c in each.values()), default=0.0),
        contact_duration=duration(table),
        newton_iterations=int(column("newton_iterations").sum()),
        # This column counts from the start.
        step_halvings=int(column("step_halvings").max()),
        solvers=solvers(table),
        largest_balance_residual=largest_balance_residual(table),
        largest_promise_residual=largest_promise_residual(table),
        contacts=each,
        units=table.units,
        energy_scale="largest" if begins_at_rest(table) else "first",
    )


def histories(table: Table) -> list[str]:
    """The columns with the position of the body: displacements, or else the gaps."""
    names = [
        name for name in table.columns if "displacement" in name and not name.startswith("exact_")
    ]
    return names or [f"smallest_gap_{name}" for name in contacts(table)]


def error_of_energy(table: Table, finest: Table) -> float:
    """How far the energy is from that of another run, over the first energy.

    Root of the mean square over the rows of `table`; the other run is interpolated linearly.
    """
    scale = energy_scale(finest)
    return _distance(table, finest, "energy") / scale if scale > 0 else float("nan")


def error_of_displacement(table: Table, finest: Table) -> float:
    """How far the displacements are from those of another run, over their range there.

    The largest error of the columns `histories`; otherwise as error_of_energy.
    """
    errors = []
    for name in histories(table):
        if name in finest:
            span = float(np.nanmax(finest[name]) - np.nanmin(finest[name]))
            if span > 0:
                errors.append(_distance(table, finest, name) / span)
    return max(errors, default=float("nan"))


def _distance(table: Table, finest: Table, name: str) -> float:
    time = table["time"]
    both = (time <= finest["time"][-1] * (1 + 1e-12)) & ~np.isnan(table[name])
    there = np.interp(time[both], finest["time"], finest[name])
    return float(np.sqrt(np.mean((table[name][both] - there) ** 2)))
