# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results of a run in its folder."""

from __future__ import annotations

import functools
import json
import math
import numbers
import os
import pathlib
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import files, measures, prm, vtu, xdmf
from .contact import Contact
from .errors import BadParameterFile, NotARun, RicochetError
from .fields import array, array_of_points, joined_points
from .names import Named
from .tables import Array, Table, read_hdf5, read_table

if TYPE_CHECKING:
    import pandas
    import xarray
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid


#: The name of a program.
WORD = "[A-Za-z][A-Za-z0-9_]*"


@dataclass(frozen=True)
class FieldFile:
    """A file of fields of a run."""

    step: int
    time: float
    path: pathlib.Path

    @property
    def obstacles(self) -> pathlib.Path | None:
        """The VTU file of rigid obstacles at that time, if there are any."""
        path = self.path.parent / f"obstacles-{self.step:06}.vtu"
        return path if path.exists() else None


class Run:
    """The results of one run of a program, read when they are asked for.

        run = ricochet.Run("output/elastic_ball/default")
        run.energy.plot(x="time", y=["kinetic_energy", "elastic_energy"])
        print(run.summary())
        grid = run.fields(0.02)  # the VTK grid of the written time nearest to 0.02

    A run that is still at work can be read too: the energy table then ends with its last complete
    row. Data read once are kept; make another `Run` to see later rows.

    Raises:
        NotARun: there is no such folder, or no run in it.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = pathlib.Path(folder)
        #: How long the program took (s), if `ricochet.run` has run it.
        self.wall_seconds: float | None = None
        if not self.folder.is_dir():
            raise NotARun(f"There is no folder '{self.folder}'.")
        of_run = ("energy.csv", "energy.h5", "parameters.prm")
        if not any((self.folder / name).is_file() for name in of_run):
            raise NotARun(
                f"The folder '{self.folder}' holds no run: none of {', '.join(of_run)} is in it."
            )

    def __repr__(self) -> str:
        return f"ricochet.Run({str(self.folder)!r})"

    # The table ----------------------------------------------------------------

    @functools.cached_property
    def table(self) -> Table:
        """The columns of energy.csv as arrays, and their units; it needs NumPy only.

        Where energy.csv is missing, those of energy.h5, by h5py, with the same values.
        """
        path = self.folder / "energy.csv"
        if not path.exists() and (self.folder / "energy.h5").exists():
            path = self.folder / "energy.h5"
        table = read_table(path) if path.suffix == ".csv" else read_hdf5(path)
        if "time" not in table or "energy" not in table:
            raise NotARun(
                f"The file '{path}' is no energy table: it has no columns 'time' and 'energy'."
            )
        if len(table) == 0:
            raise NotARun(f"The table '{path}' has no rows yet.")
        if not np.isfinite(table["time"]).all():
            raise NotARun(f"The table '{path}' has times that are not finite.")
        return table

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column of energy.csv, as its header has it."""
        return self.table.units

    @functools.cached_property
    def energy(self) -> pandas.DataFrame:
        """energy.csv, one row per step; `energy.attrs["units"]` has the columns' units."""
        try:
            import pandas
        except ImportError:
            raise RicochetError(
                "Run.energy needs pandas: install the package python3-pandas. Run.table has the "
                "same columns as arrays of NumPy."
            ) from None
        frame = pandas.DataFrame(self.table.columns)
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """The energy table over the coordinate `time`; each variable has its `units`."""
        try:
            import xarray
        except ImportError:
            raise RicochetError(
                "Run.to_xarray needs xarray: install the package python3-xarray, or xarray from "
                "PyPI. Run.energy has the same columns as a DataFrame of pandas, Run.table as "
                "arrays of NumPy."
            ) from None
        columns = {
            name: ("time", values, {"units": self.units[name]})
            for name, values in self.table.columns.items()
        }
        time = columns.pop("time")
        return xarray.Dataset(columns, coords={"time": time}, attrs={"run": str(self.folder)})

    @property
    def contacts(self) -> list[str]:
        """The names of the contacts, from the columns `contact_force_NAME`."""
        return measures.contacts(self.table)

    def summary(self) -> measures.Summary:
        """The most important numbers of the run."""
        try:
            turns = measures.turns_at_start(self.parameters)
        except NotARun:
            # A table alone has a summary too.
            turns = True
        try:
            return measures.summarise(self.table, self.log, turns, self._restitutions())
        except (ArithmeticError, LookupError, ValueError) as error:
            raise NotARun(
                f"The energy table in '{self.folder}' has no summary: {error}."
            ) from None

    def _restitutions(self) -> dict[str, float]:
        """Restitution of the contacts that have one in summary.json; none without that file.

        Raises:
            NotARun: it is damaged.
        """
        if not (self.folder / "summary.json").exists():
            return {}
        try:
            found = {name: one.get("restitution") for name, one in self.result["contacts"].items()}
            return {name: float(number) for name, number in found.items() if number is not None}
        except (AttributeError, LookupError, TypeError, ValueError) as error:
            raise NotARun(f"The summary in '{self.folder}' is damaged: {error}.") from None

    @functools.cached_property
    def result(self) -> dict[str, Any]:
        """summary.json: losses, contacts, checks and the extremes of all columns.

        The program writes it at its end, also when it was stopped or has failed; a run that is
        still at work has none.
        """
        path = self.folder / "summary.json"
        try:
            data = json.loads(
                files.read_text(path), object_hook=lambda found: Named("member", found)
            )
        except FileNotFoundError:
            raise NotARun(f"There is no '{path}': the run has not come to an end.") from None
        except (OSError, ValueError, RecursionError) as error:
            raise NotARun(f"The summary '{path}' cannot be read: {error}.") from None
        if not isinstance(data, dict) or data.get("format") != 1:
            raise NotARun(f"The file '{path}' is no summary of this version of Ricochet.")
        return data

    # Parameters ---------------------------------------------------------------

    @functools.cached_property
    def parameters(self) -> dict[str, str]:
        """All parameters of the run, "Section/Name" -> value as text.

        Sections may nest: "Section/Section/Name".
        """
        try:
            return Named("parameter", prm.read(self.folder / "parameters.prm").values)
        except BadParameterFile as error:
            raise NotARun(f"The parameters of the run cannot be read: {error}") from None

    @functools.cached_property
    def program(self) -> str:
        """The name of the program, from run.txt or else from the parameters.

        Raises:
            NotARun: there is none, or it is that of a path.
        """
        text = self._text("run.txt")
        match = re.search(r"^program = (.+)$", text, re.MULTILINE)
        name = match.group(1).strip() if match else self.parameters.get("Program", "")
        if not name:
            raise NotARun(f"Nothing in the folder '{self.folder}' says which program has run.")
        # The folder may be a stranger's, and the name may be given to `ricochet.run`.
        if not re.fullmatch(WORD, name):
            raise NotARun(
                f"The program of the run '{self.folder}' is called '{name[:60]}', and a program "
                "has a word as its name."
            )
        return name

    @functools.cached_property
    def log(self) -> str:
        """The text of log.txt; empty if there is none."""
        return self._text("log.txt")

    def _text(self, name: str) -> str:
        """The text of a file; empty if it is not there or cannot be read."""
        try:
            return files.read_bytes(self.folder / name, None).decode("utf-8", errors="replace")
        except (OSError, ValueError):
            return ""

    @property
    def open_lines(self) -> list[str]:
        """The message of log.txt on an energy balance that does not close or a broken promise."""
        marks = ("THE ENERGY BALANCE DOES NOT CLOSE", "THE PROMISE IS BROKEN")
        return [line for line in self.log.splitlines() if line.endswith(marks)]

    @property
    def is_open(self) -> bool:
        """Whether the balance of energy does not close, or a promise of contact is broken."""
        return bool(self.open_lines)

    @property
    def seconds_in_steps(self) -> float | None:
        """The time spent in the steps (s), without start and output, if log.txt has it."""
        number = r"\d+\.?\d*(?:e[+-]?\d+)?"
        match = re.search(rf"^\| steps +\| +\d+ \| +({number})s", self.log, re.MULTILINE)
        return float(match.group(1)) if match else None

    def contact(self, name: str) -> Contact:
        """Gap and forces of a contact in each written step, point by point and node by node.

            run.contact("floor")[-1].pressure
            run.contact("floor").frame()

        Raises:
            NotARun: the run has written none (Output/Contact every).
            NoSuchName: there is no such contact; the message has the nearest one.
        """
        return Contact(self.folder, name)

    # Fields -------------------------------------------------------------------

    @functools.cached_property
    def field_files(self) -> list[FieldFile]:
        """The files of fields that solution.pvd or solution.xdmf lists, in their order.

        Raises:
            NotARun: there is no such list, it is damaged, or a file of it is not in the folder.
        """
        path = self.folder / "solution.pvd"
        if not path.exists() and path.with_suffix(".xdmf").exists():
            path = path.with_suffix(".xdmf")
        try:
            entries = xdmf.entries(path) if path.suffix == ".xdmf" else vtu.entries(path)
        except FileNotFoundError:
            raise NotARun(
                f"There is no '{path}': the run has written no fields (Output/Fields every)."
            ) from None
        except KeyError as error:
            raise NotARun(f"The list of fields '{path}' has an entry without {error}.") from None
        except (OSError, ValueError) as error:
            raise NotARun(f"The list of fields '{path}' cannot be read: {error}.") from None
        for time, name in entries:
            inside = pathlib.PurePath(name)
            if inside.is_absolute() or ".." in inside.parts or not math.isfinite(time):
                raise NotARun(
                    f"The list of fields '{path}' names '{name[:200]}' at the time {time}: files "
                    "are in the folder of the run, and times are finite."
                )
        result = []
        # The files of phases, which are in folders of their own, are counted in their order.
        of_phases = len({pathlib.PurePath(name).parent for _, name in entries}) > 1
        for number, (time, name) in enumerate(entries):
            match = None if of_phases else re.search(r"(\d{1,18})\.(?:vtu|h5)$", name)
            step = int(match.group(1)) if match else number
            result.append(FieldFile(step, time, self.folder / name))
        if not result:
            raise NotARun(f"The list of fields '{path}' is empty.")
        return result

    @property
    def steps(self) -> list[int]:
        """The steps of which there are fields; of a run in phases the numbers of its files."""
        return [file.step for file in self.field_files]

    @property
    def times(self) -> Array:
        """The times of which there are fields."""
        return np.array([file.time for file in self.field_files])

    def field_file(self, at: int | float = -1) -> FieldFile:
        """The file of a step (an integer; -1 for the last one), or of the time nearest to `at`.

        Raises:
            NotARun: there are no fields of that step, or none at all; or the time is outside of
                those that are written, by more than the largest distance between them.
        """
        files = self.field_files
        if isinstance(at, numbers.Integral):
            if at == -1:
                return files[-1]
            for file in files:
                if file.step == at:
                    return file
            steps = ", ".join(map(str, self.steps[:5]))
            if len(files) > 5:
                steps += f" and so on to {files[-1].step}"
            raise NotARun(
                f"The run '{self.folder}' has no fields of step {at}; it has those of {steps}."
            )
        times, time = self.times, float(at)
        distance = float(np.diff(times).max(initial=0.0))
        if not times[0] - distance <= time <= times[-1] + distance:
            raise NotARun(
                f"The run '{self.folder}' has no fields of the time {time:g}; it has those from "
                f"{times[0]:g} to {times[-1]:g}. A whole number without a point is a step."
            )
        return files[int(np.abs(times - time).argmin())]

    def fields(self, at: int | float = -1) -> vtkUnstructuredGrid:
        """The fields of a step (an integer), or of the written time nearest to `at` (a float).

        Points are at their initial positions; `displacement` leads to the current ones.
        Without an argument: the last ones.

        Raises:
            NotARun: there are no fields of that step or that time, see `field_file`, or the file
                is damaged.
        """
        return read_fields(self.field_file(at).path)

    def nodes(self, at: int | float = -1) -> Array:
        """Initial positions of the nodes, (n, 3), each once for each body that has it.

        Raises:
            NotARun: as fields().
        """
        grid = self.fields(at)
        return array_of_points(grid)[joined_points(grid)[0]]

    def field(self, name: str, at: int | float = -1) -> Array:
        """Values of a field at the nodes(), (n, components): `displacement`, `velocity`,
        `contact_force` (N), `contact_pressure`, `von_mises`, ...

        Where cells have different values, as of stress, their mean. The sum of `contact_force`
        over the nodes of a body is that of the columns `resultant_...` of its contacts. Files of
        fields have seven digits, those of `contact` all of them.

        Raises:
            NotARun: as fields().
            RicochetError: there is no such field; the message has the nearest name.
        """
        grid = self.fields(at)
        number = joined_points(grid)[1]
        values = array(grid, name)
        count = np.bincount(number)
        return np.column_stack([np.bincount(number, column) / count for column in values.T])


def read_fields(path: str | os.PathLike[str]) -> Any:
    """A VTU file, or an HDF5 file of fields, as an unstructured grid of VTK.

    Raises:
        NotARun: the file is missing or damaged.
        RicochetError: VTK is missing.
    """
    path = pathlib.Path(path)
    try:
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
    except ImportError:
        raise RicochetError("Fields need VTK: install the package python3-vtk9.") from None
    try:
        found = xdmf.read(path) if path.suffix == ".h5" else vtu.read(path)
    except FileNotFoundError:
        raise NotARun(f"There is no file of fields '{path}'.") from None
    except (OSError, ValueError) as error:
        raise NotARun(f"The file of fields '{path}' is damaged: {error}.") from None
    if not len(found.points) or not len(found.types):
        raise NotARun(f"The file of fields '{path}' has no points or no cells.")
    grid, points, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(found.points, deep=True))
    grid.SetPoints(points)
    ends = np.concatenate([[0], found.ends])
    cells.SetData(*(numpy_to_vtkIdTypeArray(a, deep=True) for a in (ends, found.corners)))
    grid.SetCells(numpy_to_vtk(found.types.astype(np.uint8), deep=True), cells)
    for name, values in found.fields.items():
        column = numpy_to_vtk(values, deep=True)
        column.SetName(name)
        grid.GetPointData().AddArray(column)
    return grid
