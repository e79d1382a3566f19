# SPDX-License-Identifier: LGPL-2.1-or-later
"""A picture of the results of `ricochet FILE.prm --validate --output-dir FOLDER`: the bodies and
their boundaries with the names by which a parameter file knows them."""

from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass

from . import curves, fields, files
from .errors import NotARun
from .results import read_fields

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.transforms import ScaledTranslation
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from numpy.typing import NDArray

OBSTACLE = "0.45"
# Numbers of points of VTK's cells, by type; those of bodies in 3D come last.
LINE, TRIANGLE, QUADRILATERAL, TETRAHEDRON, HEXAHEDRON = 3, 5, 9, 10, 12


@dataclass(frozen=True)
class _Setup:
    points: NDArray[np.float64]
    #: Points and parts of the cells of the bodies.
    cells: list[tuple[list[int], int]]
    #: Points and numbers of the faces of the boundary.
    faces: list[tuple[list[int], int]]
    #: Names of the boundaries by their numbers.
    names: dict[int, str]
    dim: int
    #: Pieces of rigid obstacles: positions of their corners.
    obstacles: list[NDArray[np.float64]]


def is_setup(folder: pathlib.Path) -> bool:
    """Whether there is a set-up, and no run, in this folder."""
    return (folder / "setup.vtk").exists() and not (folder / "energy.csv").exists()


def _sections(text: str) -> dict[str, list[str]]:
    """The numbers after each keyword of a legacy VTK file."""
    found: dict[str, list[str]] = {}
    current: list[str] = []
    for line in text.splitlines():
        words = line.split()
        if words and words[0][0].isalpha() and words[0] != "LOOKUP_TABLE":
            key = words[0] if words[0] != "SCALARS" else words[1]
            current = found.setdefault(key, [])
        elif words and words[0] != "LOOKUP_TABLE":
            current.extend(words)
    return found


def _names(folder: pathlib.Path) -> dict[int, str]:
    """Names of boundaries from setup.txt, "body: name"."""
    names: dict[int, str] = {}
    body = ""
    try:
        lines = files.read_text(folder / "setup.txt").splitlines()
    except (OSError, ValueError):
        return names
    for line in lines:
        if match := re.match(r"Body (.*?): \d+ cells", line):
            body = match[1]
        elif match := re.match(r"  boundary (\d+)(?: \((.*)\))?: .*, number (\d+) in", line):
            names[int(match[3])] = f"{body}: {match[2] or match[1]}"
    return names


def read(folder: pathlib.Path) -> _Setup:
    """Read the set-up in a folder.

    Raises: NotARun: it is not written by the program.
    """
    try:
        sections = _sections(files.read_text(folder / "setup.vtk", None))
        points = np.array(sections["POINTS"], dtype=float).reshape(-1, 3)
        types = list(map(int, sections["CELL_TYPES"]))
        numbers = list(map(int, sections["MaterialID"]))
        entries = list(map(int, sections["CELLS"]))
        if not np.isfinite(points).all() or not len(points):
            raise ValueError("points have to be finite numbers")
        return _setup(folder, points, list(zip(types, numbers)), entries)
    except (OSError, LookupError, ValueError) as error:
        raise NotARun(f"'{folder / 'setup.vtk'}' cannot be read as a set-up: {error}.") from None


def _setup(
    folder: pathlib.Path,
    points: NDArray[np.float64],
    kinds: list[tuple[int, int]],
    entries: list[int],
) -> _Setup:
    """Cells and faces, from their types with the numbers of their parts, and their corners."""
    types = [kind for kind, _ in kinds]
    dim = 3 if TETRAHEDRON in types or HEXAHEDRON in types else 2
    bodies = (TETRAHEDRON, HEXAHEDRON) if dim == 3 else (TRIANGLE, QUADRILATERAL)
    cells, faces, place = [], [], 0
    for kind, number in kinds:
        count = entries[place]
        corners = entries[place + 1 : place + 1 + count]
        place += 1 + count
        if not corners or not 0 <= min(corners) <= max(corners) < len(points):
            raise ValueError("a cell has a corner that does not exist")
        if kind in bodies:
            cells.append((corners, number))
        elif 0 <= number < 1 << 24:
            faces.append((corners, number))
    return _Setup(points, cells, faces, _names(folder), dim, _obstacles(folder))


def _obstacles(folder: pathlib.Path) -> list[NDArray[np.float64]]:
    path = folder / "setup_obstacles.vtu"
    if not path.exists():
        return []
    grid = read_fields(path)
    if not grid.GetNumberOfCells():
        return []
    places = fields.array_of_points(grid)
    pieces = []
    for number in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(number).GetPointIds()
        pieces.append(places[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]])
    return pieces


def draw(folder: pathlib.Path) -> Figure:
    """The figure: cells in the colour of their part, boundaries in colours of their own."""
    setup = read(folder)
    known = sorted({number for _, number in setup.faces})
    colours = {number: plt.get_cmap("tab20")(k % 20) for k, number in enumerate(known)}
    if setup.dim == 2:
        figure, panel = plt.subplots(figsize=(8, 5.5), layout="constrained")
        _draw_plane(panel, setup, colours)
    else:
        figure = plt.figure(figsize=(8, 6.5), layout="constrained")
        panel = figure.add_subplot(projection="3d")
        _draw_space(panel, setup, colours)
    handles = [Line2D([], [], color=OBSTACLE, linewidth=2, label="obstacles")]
    handles = (handles if setup.obstacles else []) + [
        Line2D([], [], color=colours[k], linewidth=4, label=curves.plain(setup.names.get(k, f"number {k}")))
        for k in known
    ]
    panel.legend(
        handles=handles,
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        # Below what is written at the axis, however high the panel is.
        bbox_transform=panel.transAxes + ScaledTranslation(0.0, -0.45, figure.dpi_scale_trans),
        ncols=min(4, len(handles)) or 1,
    )
    return figure


def _draw_plane(panel: Axes, setup: _Setup, colours: dict[int, tuple[float, ...]]) -> None:
    shades = [0.93 - 0.09 * (part % 5) for _, part in setup.cells]
    polygons = [setup.points[corners, :2] for corners, _ in setup.cells]
    panel.add_collection(
        PolyCollection(
            polygons, facecolors=[str(s) for s in shades], edgecolors="0.6", linewidths=0.4
        )
    )
    panel.add_collection(
        LineCollection(
            [setup.points[corners, :2] for corners, _ in setup.faces],
            colors=[colours[number] for _, number in setup.faces],
            linewidths=3.0,
        )
    )
    panel.set_aspect("equal")
    panel.autoscale_view()
    # Only near parts of obstacles.
    panel.add_collection(
        LineCollection(
            [piece[:, :2] for piece in setup.obstacles], colors=OBSTACLE, linewidths=2.0, zorder=0.5
        ),
        autolim=False,
    )
    panel.grid(False)
    panel.set_xlabel("x")
    panel.set_ylabel("y")


def _draw_space(panel: Axes, setup: _Setup, colours: dict[int, tuple[float, ...]]) -> None:
    panel.add_collection(
        Poly3DCollection(
            [setup.points[corners] for corners, _ in setup.faces],
            facecolors=[colours[number] for _, number in setup.faces],
            edgecolors="0.3",
            linewidths=0.2,
        )
    )
    low, high = setup.points.min(axis=0), setup.points.max(axis=0)
    margin = 0.15 * (high - low).max()
    near = [
        piece
        for piece in setup.obstacles
        if (piece > low - margin).all() and (piece < high + margin).all()
    ]
    if near:
        panel.add_collection(Poly3DCollection(near, facecolors=OBSTACLE, alpha=0.3))
        corners = np.concatenate([setup.points, *near])
        low, high = corners.min(axis=0), corners.max(axis=0)
    for axis, name in enumerate("xyz"):
        getattr(panel, f"set_{name}lim")(low[axis], high[axis])
        getattr(panel, f"set_{name}label")(name)
    panel.locator_params(nbins=3)
    panel.set_box_aspect(np.maximum(high - low, 0.02 * (high - low).max()))
