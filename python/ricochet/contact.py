# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gap and forces of a contact, point by point and node by node, from contact/step-NNNNNN.h5."""

from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import hdf5
from .errors import NotARun
from .names import no_such
from .tables import Array

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True)
class ContactStep:
    """A contact at one time: quantities of its points, and of the nodes that have a force."""

    time: float
    step: int
    #: Positions of the points, displaced, (points, dim).
    position: Array
    gap: Array
    #: Normal force of each point, positive in compression; its sum is `contact_force_NAME`.
    normal_force: Array
    #: Part of the surface that a point stands for.
    area: Array
    active: Array
    #: Initial positions of the nodes with a force, their forces (with friction) and
    #: displacements, (nodes, dim); None where the contacts of the run have none of their own.
    nodes: Array | None
    force: Array | None
    displacement: Array | None

    @property
    def pressure(self) -> Array:
        """Normal force over area; 0 for points without area, such as corners."""
        result = np.zeros_like(self.normal_force)
        np.divide(self.normal_force, self.area, out=result, where=self.area > 0)
        return result


class Contact:
    """The steps of a contact.

        floor = run.contact("floor")
        floor.times                    # s
        floor[-1].pressure             # of the points in the last step
        floor.frame()                  # all of them, as a pandas.DataFrame

    Raises:
        NotARun: the run has written none (Output/Contact every), or a file is damaged.
        RicochetError: there is no such contact; the message has the nearest name.
    """

    def __init__(self, folder: pathlib.Path, name: str) -> None:
        self.name = name
        files = sorted((folder / "contact").glob("step-*.h5"), key=_number)
        if not files:
            raise NotARun(
                f"The run '{folder}' has no data of contact: set Output/Contact every = 1."
            )
        self._steps = [
            _step(path, found, name) for path, found in zip(files, hdf5.read(files))
        ]

    def __len__(self) -> int:
        return len(self._steps)

    def __getitem__(self, number: int) -> ContactStep:
        return self._steps[number]

    @property
    def steps(self) -> list[int]:
        """The numbers of the steps."""
        return [each.step for each in self]

    @property
    def times(self) -> Array:
        """The times of the steps."""
        return np.array([each.time for each in self])

    def frame(self) -> pandas.DataFrame:
        """All points of all steps: time, step, x, y, z, gap, normal_force, pressure, active."""
        import pandas

        parts = []
        for each in self:
            part = pandas.DataFrame(each.position, columns=list("xyz")[: each.position.shape[1]])
            part.insert(0, "step", each.step)
            part.insert(0, "time", each.time)
            for quantity in ("gap", "normal_force", "pressure", "active"):
                part[quantity] = getattr(each, quantity)
            parts.append(part)
        return pandas.concat(parts, ignore_index=True)


def _number(file: pathlib.Path) -> int:
    match = re.search(r"step-(\d+)\.h5$", file.name)
    return int(match.group(1)) if match else -1


def _step(path: pathlib.Path, found: hdf5.Hdf5, name: str) -> ContactStep:
    names = [key.removesuffix("/gap") for key in found.arrays if key.endswith("/gap")]
    if name not in names:
        raise no_such("contact", name, names)

    def nodal(quantity: str) -> Array | None:
        # A treatment with several boundaries has those of all together.
        return found.arrays.get(f"{name}/{quantity}", found.arrays.get(quantity))

    try:
        points = {
            quantity: found.arrays[f"{name}/{quantity}"]
            for quantity in ("gap", "normal_force", "area", "active")
        }
        position = found.arrays[f"{name}/position"].reshape(len(points["gap"]), -1)
        if len({array.shape for array in points.values()}) > 1:
            raise ValueError("lists of different lengths")
        return ContactStep(
            found.attributes["time"],
            int(found.attributes["step"]),
            position,
            **points,
            nodes=nodal("nodes"),
            force=nodal("nodal_force"),
            displacement=nodal("nodal_displacement"),
        )
    except (KeyError, ValueError) as error:
        raise NotARun(f"The file '{path}' has no data of contact: {error}.") from None
