# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures and animations of deformed bodies: VTK draws them, matplotlib puts axes around."""

from __future__ import annotations

import itertools
import math
import os
import pathlib
import shutil
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from . import curves, fields, render
from .errors import RicochetError
from .results import FieldFile, Run
from .screen import run_with_screen
from .tables import Array

import matplotlib.animation as animation
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from PIL import Image

COLOUR_MAP = "viridis"
# Edges are drawn of meshes whose cells have this area in the picture at least (pixels).
SMALLEST_CELL = 150


def check_ffmpeg() -> None:
    """Raises: RicochetError: there is no ffmpeg."""
    if not shutil.which("ffmpeg"):
        raise RicochetError(
            "An animation as MP4 needs ffmpeg, which is not installed; '--animation gif' needs "
            "nothing more."
        )


@dataclass(frozen=True)
class _Scene:
    """Common settings of the frames of a run."""

    run: Run
    colour: str
    dim: int
    limits: tuple[float, float]
    #: Whether some values are above the limits.
    exceeds: bool
    view: render.View
    edges: bool
    cut: float | None
    #: In 3D, distance from the bodies' box up to which obstacles are shown.
    box: tuple[tuple[float, float], ...] | None

    @property
    def label(self) -> str:
        """For the colour bar, with the unit."""
        colour = fields.COLOURS[self.colour]
        unit = _unit(self.run, colour.kind)
        return colour.label + (f" ({unit})" if unit else "")

    @property
    def mappable(self) -> ScalarMappable:
        """Quantity of the colour bar."""
        return ScalarMappable(Normalize(*self.limits), COLOUR_MAP)

    @property
    def extend(self) -> str:
        """The ends of the colour bar that are open."""
        return "max" if self.exceeds else "neither"


def _unit(run: Run, kind: str) -> str:
    """The unit of a kind of fields, as matplotlib takes it."""
    return curves.plain(fields.unit(run.units, kind))


@dataclass(frozen=True)
class Shown:
    """Result of `show`: its time, and the data for a colour bar."""

    time: float
    mappable: ScalarMappable
    label: str
    extend: str

    def colour_bar(self, axes: Any, **keywords: Any) -> Colorbar:
        """A colour bar beside axes, with the keywords of matplotlib."""
        panel = np.ravel(np.asarray(axes, dtype=object))[0]
        return panel.figure.colorbar(
            self.mappable, ax=axes, label=self.label, extend=self.extend, **keywords
        )


def _axes(view: Array) -> tuple[Array, Array]:
    """Right and up of a picture for an eye in the direction `view`, with z up."""
    view = view / np.linalg.norm(view)
    right = np.cross((0.0, 0.0, 1.0), view)
    right /= np.linalg.norm(right)
    return right, np.cross(view, right)


def _scene(
    run: Run, colour: str, files: Sequence[FieldFile], pixels: int, obstacles: bool = True
) -> _Scene:
    """View and limits of the colours that suit all of these files."""
    first = run.fields(files[0].step)
    dim, cells = fields.dimension(first), first.GetNumberOfCells()
    on_foundation = _stands_on_zero(run, dim, first.GetLength())
    cut, box = None, None
    if dim == 2:
        right, up = np.array((1.0, 0.0, 0.0)), np.array((0.0, 1.0, 0.0))
    else:
        from_below = colour == "contact_pressure" and on_foundation
        if colour in ("von_mises", "stress") or (
            colour == "contact_pressure" and not on_foundation
        ):
            cut = 0.5 * sum(first.GetBounds()[2:4])
        # A cut through a body on a foundation is seen from a direction in which that is level.
        from_above = (0.0, -1.0, 0.3) if cut is not None and on_foundation else (0.35, -1.0, 0.4)
        right, up = _axes(np.array((0.6, -0.9, -0.75) if from_below else from_above))

    lowest, highest, largest = math.inf, -math.inf, -math.inf
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    seen_low, seen_high = np.full(2, np.inf), np.full(2, -np.inf)
    for file in files:
        grid = run.fields(file.step)
        values = fields.values(grid, colour)
        lowest = min(lowest, float(values.min()))
        largest = max(largest, float(values.max()))
        # A few points at an edge of contact would take all colours for themselves.
        part = 100.0 if colour == "contact_pressure" else 99.0
        highest = max(highest, float(np.percentile(values, part)))
        start = fields.array_of_points(grid)
        places = start + fields.displacements(grid)
        low, high = np.minimum(low, places.min(axis=0)), np.maximum(high, places.max(axis=0))
        seen = places if cut is None else places[start[:, 1] >= cut - 1e-9 * grid.GetLength()]
        plane = np.stack((seen @ right, seen @ up), axis=1)
        seen_low = np.minimum(seen_low, plane.min(axis=0))
        seen_high = np.maximum(seen_high, plane.max(axis=0))
    if colour in ("von_mises", "contact_pressure", "stress") and dim > 1:
        lowest = max(lowest, 0.0)
    if not highest > lowest:
        highest = lowest + 1.0
    size = float(np.linalg.norm(high - low))
    if dim == 2 and on_foundation:
        low[1] = seen_low[1] = min(low[1], 0.0)
    if dim == 3 and obstacles and colour != "contact_pressure" and files[0].obstacles:
        # Seen from below, contact would be behind them.
        low, high = low - 0.1 * size, high + 0.1 * size
        box = tuple(zip(map(float, low), map(float, high)))
        corners = np.array(list(itertools.product(*zip(low, high))))
        plane = np.stack((corners @ right, corners @ up), axis=1)
        seen_low = np.minimum(seen_low, plane.min(axis=0))
        seen_high = np.maximum(seen_high, plane.max(axis=0))
    middle = 0.5 * (seen_low + seen_high)
    width, height = seen_high - seen_low + 0.08 * (seen_high - seen_low).max()
    # A thin body is shown with something around it.
    height, width = max(height, 0.15 * width), max(width, 0.15 * height)
    towards = np.cross(right, up)
    centre = middle[0] * right + middle[1] * up + 0.5 * ((low + high) @ towards) * towards
    scale = pixels / max(width, height)
    # How large a cell is in the picture: a thin ring has small cells in a large view.
    many = cells if dim == 2 else 2 * cells ** (2 / 3)
    area = (fields.area(first) if dim == 2 else width * height) * scale**2
    view = render.View(
        tuple(map(float, centre)),  # type: ignore[arg-type]
        tuple(map(float, right)),  # type: ignore[arg-type]
        tuple(map(float, up)),  # type: ignore[arg-type]
        float(width),
        float(height),
        size,
        (max(16, round(width * scale)), max(16, round(height * scale))),
    )
    return _Scene(
        run,
        colour,
        dim,
        (lowest, highest),
        largest > highest * (1 + 1e-9),
        view,
        bool(area > SMALLEST_CELL * many),
        cut,
        box,
    )


def _stands_on_zero(run: Run, dim: int, size: float) -> bool:
    """Whether the contact called `foundation` is with the plane at the height 0: then the gap
    at the start is the height of the lowest point."""
    column = "smallest_gap_foundation"
    file = run.field_files[0]
    if column not in run.table or file.step != 0:
        return False
    grid = run.fields(file.step)
    places = fields.array_of_points(grid) + fields.displacements(grid)
    height = float(places[:, dim - 1].min())
    return abs(height - float(run.table[column][0])) < 1e-3 * size


def palette() -> list[tuple[float, ...]]:
    """Red, green and blue of the colours that stand for values, from the least to the largest."""
    return [tuple(map(float, c[:3])) for c in plt.get_cmap(COLOUR_MAP)(np.linspace(0, 1, 256))]


def _render(scene: _Scene, files: Sequence[FieldFile], folder: pathlib.Path) -> list[Array]:
    """The pictures of some files, as arrays of red, green and blue."""
    images = [folder / f"{number:06}.png" for number in range(len(files))]
    job = render.Job(
        [
            (str(f.path.resolve()), str(f.obstacles.resolve()) if f.obstacles else None, str(image))
            for f, image in zip(files, images)
        ],
        scene.colour,
        scene.limits,
        palette(),  # type: ignore[arg-type]
        scene.view,
        scene.edges,
        scene.cut,
        scene.box,
    )
    (folder / "job.json").write_text(job.to_json(), encoding="utf-8")
    command = [sys.executable, "-m", "ricochet.render", str(folder / "job.json")]
    package = str(pathlib.Path(__file__).resolve().parents[1])
    path = os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH"))))
    run_with_screen(command, {"PYTHONPATH": path})
    return [plt.imread(image) for image in images]


def _scale_bar(panel: Axes, scene: _Scene) -> None:
    """A length to compare with, in a picture of a body in 3D."""
    raw = 0.25 * scene.view.width
    power = 10.0 ** math.floor(math.log10(raw))
    length = max(f * power for f in (1, 2, 5) if f * power <= raw)
    # Below the picture, and beside the bar its length: both are clear of the body.
    x, y = -0.47 * scene.view.width, -0.54 * scene.view.height
    panel.plot([x, x + length], [y, y], color="black", linewidth=2, solid_capstyle="butt")
    unit = _unit(scene.run, "length")
    panel.text(
        x + length + 0.02 * scene.view.width,
        y,
        f"{length:g} {unit}".strip(),
        va="center",
        fontsize=9,
    )
    panel.set_ylim(-0.58 * scene.view.height, 0.5 * scene.view.height)


def _show(panel: Axes, scene: _Scene, image: Array) -> None:
    """Put a picture into axes that have its lengths."""
    view = scene.view
    half = 0.5 * np.array((view.width, view.height))
    middle = np.array(view.centre[:2]) if scene.dim == 2 else np.zeros(2)
    (x0, y0), (x1, y1) = middle - half, middle + half
    panel.imshow(image, extent=(x0, x1, y0, y1), interpolation="antialiased")
    panel.grid(False)
    panel.set_aspect("equal")
    if scene.dim == 3:
        panel.axis("off")
        _scale_bar(panel, scene)
        return
    panel.set_xlim(x0, x1)
    panel.set_ylim(y0, y1)
    unit = _unit(scene.run, "length")
    panel.set_xlabel(f"x ({unit})" if unit else "x")
    panel.set_ylabel(f"y ({unit})" if unit else "y")


def _time(run: Run, file: FieldFile) -> str:
    """The time of a file, with as many digits as the times of the run need."""
    times = run.times
    step = np.diff(times).min() if len(times) > 1 else abs(times[0]) or 1.0
    digits = max(0, 1 - math.floor(math.log10(step))) if step > 0 else 6
    text = f"{file.time:.{digits}f}" if digits < 6 else f"{file.time:.3e}"
    return f"t = {text} {curves.plain(run.units.get('time', ''))}".strip()


def instants(run: Run) -> list[FieldFile]:
    """The files of the beginning, of the largest stored energy and of the end."""
    files = run.field_files
    time = float(run.table["time"][run.table["elastic_energy"].argmax()])
    middle = int(np.abs(run.times - time).argmin())
    if middle in (0, len(files) - 1):
        middle = len(files) // 2
    return [files[k] for k in sorted({0, middle, len(files) - 1})]


def check_colour(run: Run, colour: str | None) -> str:
    """The colour field of a run: `colour`, or without one von Mises stress, on bars stress.

    Raises:
        RicochetError: it has no fields, or not this one.
    """
    grid = run.fields(run.field_files[0].step)
    if colour is None:
        colour = "stress" if fields.dimension(grid) == 1 else "von_mises"
    try:
        fields.values(grid, colour)
    except RicochetError as error:
        raise RicochetError(f"{run.folder}: {error}") from None
    return colour


def show(
    panel: Axes,
    run: Run,
    time: float,
    colour: str,
    limits: tuple[float, float] | None = None,
    pixels: int = 900,
    obstacles: bool = True,
) -> Shown:
    """A picture of the deformed body, at the written time nearest to `time`, in given axes.

        shown = pictures.show(axes, run, 0.02, "von_mises")
        shown.colour_bar(axes)

    `limits` of the colours make panels comparable; without them they are those of the picture.
    A body in 3D is cut in halves for stress; contact pressure on a foundation is shown from below.
    Without `obstacles` those in 3D are left away.

    Raises:
        RicochetError: there are no such fields, or VTK cannot draw.
    """
    check_colour(run, colour)
    file = min(run.field_files, key=lambda f: abs(f.time - time))
    scene = _scene(run, colour, [file], pixels, obstacles)
    if limits is not None:
        values = fields.values(run.fields(file.step), colour)
        scene = replace(scene, limits=limits, exceeds=bool(values.max() > limits[1]))
    with tempfile.TemporaryDirectory(prefix="ricochet-") as folder:
        (image,) = _render(scene, [file], pathlib.Path(folder))
    _show(panel, scene, image)
    return Shown(file.time, scene.mappable, scene.label, scene.extend)


def _is_bar(run: Run) -> bool:
    return fields.dimension(run.fields(run.field_files[0].step)) == 1


def draw_instants(
    run: Run, colour: str, path: pathlib.Path, title: str | None = None
) -> pathlib.Path:
    """A picture of the body at the beginning, at the largest stored energy and at the end;
    of a bar the field over position and time.

    Raises:
        RicochetError: there are no such fields, or VTK cannot draw.
    """
    if _is_bar(run):
        return curves.save(_bar(run, colour, title), path)
    files = instants(run)
    scene = _scene(run, colour, files, 900)
    with tempfile.TemporaryDirectory(prefix="ricochet-") as folder:
        images = _render(scene, files, pathlib.Path(folder))
    ratio = scene.view.width / scene.view.height
    if ratio > 1.8:
        shape, size = (len(files), 1), (8.5, (7.0 / ratio + 0.75) * len(files))
    else:
        shape, size = (1, len(files)), ((3.9 * ratio + 0.7) * len(files) + 1.2, 4.7)
    figure, axes = plt.subplots(*shape, figsize=size, squeeze=False, layout="constrained")
    for panel, file, image in zip(axes.flat, files, images):
        _show(panel, scene, image)
        panel.set_title(_time(run, file))
        panel.label_outer()
    figure.colorbar(
        scene.mappable, ax=axes, label=scene.label, extend=scene.extend, shrink=0.85, aspect=28
    )
    if title:
        figure.suptitle(title)
    return curves.save(figure, path)


def _bar(run: Run, colour: str, title: str | None) -> Figure:
    """A field of a bar: positions of its points over time, with their values as colours."""
    places, shown = [], []
    for file in run.field_files:
        grid = run.fields(file.step)
        start = fields.array_of_points(grid)[:, 0]
        order = np.argsort(start, kind="stable")
        places.append((start + fields.displacements(grid)[:, 0])[order])
        shown.append(fields.values(grid, colour)[order])
    if len(places) < 2:
        raise RicochetError(f"The run '{run.folder}' has fields of one time only.")
    times = np.repeat(run.times[:, None], len(places[0]), axis=1)
    figure, axes = plt.subplots(figsize=(7.5, 4.6), layout="constrained")
    drawn = axes.pcolormesh(
        times,
        np.array(places),
        np.array(shown),
        shading="gouraud",
        cmap=COLOUR_MAP,
        rasterized=True,
    )
    unit = _unit(run, "length")
    axes.set_xlabel(f"time ({curves.plain(run.units.get('time', ''))})")
    axes.set_ylabel(f"x of the deformed bar ({unit})" if unit else "x of the deformed bar")
    axes.grid(False)
    colour_unit = _unit(run, fields.COLOURS[colour].kind)
    label = fields.COLOURS[colour].label
    figure.colorbar(drawn, label=f"{label} ({colour_unit})" if colour_unit else label)
    if title:
        axes.set_title(title)
    return figure


def animate(
    run: Run, colour: str, path: pathlib.Path, title: str | None = None, most_frames: int = 100
) -> pathlib.Path:
    """An animation of the deformed body, GIF or MP4 by the ending of `path`.

    Raises:
        RicochetError: there are no such fields, VTK cannot draw, or ffmpeg is missing.
    """
    if path.suffix == ".mp4":
        check_ffmpeg()
    if _is_bar(run):
        raise RicochetError("Bars are drawn over place and time by --fields, not as animations.")
    if most_frames < 2:
        raise RicochetError("An animation needs at least two frames.")
    files = run.field_files
    if len(files) > most_frames:
        chosen = np.linspace(0, len(files) - 1, most_frames).round().astype(int)
        files = [files[k] for k in chosen]
    scene = _scene(run, colour, files, 560)
    with tempfile.TemporaryDirectory(prefix="ricochet-") as folder:
        images = _render(scene, files, pathlib.Path(folder))
    ratio = scene.view.width / scene.view.height
    size = (5.6 * min(ratio, 1.0) + 1.9, 5.6 * min(1 / ratio, 1.0) + 1.0)
    figure, panel = plt.subplots(figsize=size)
    figure.subplots_adjust(left=0.13, right=0.9, bottom=0.12, top=0.9)
    _show(panel, scene, images[0])
    shown = panel.images[0]
    figure.colorbar(scene.mappable, ax=panel, label=scene.label, extend=scene.extend, shrink=0.9)
    # About five seconds, and a second at the end.
    speed = max(4, min(25, round(len(files) / 5)))
    writer: Any = (
        animation.FFMpegWriter(fps=speed) if path.suffix == ".mp4" else _GifWriter(fps=speed)
    )
    with writer.saving(figure, str(path), dpi=90):
        for file, image in [*zip(files, images), *[(files[-1], images[-1])] * speed]:
            shown.set_data(image)
            panel.set_title((f"{title}\n" if title else "") + _time(run, file))
            writer.grab_frame()
    plt.close(figure)
    return path


class _GifWriter(animation.PillowWriter):  # type: ignore[misc]
    """Writes GIFs with the colours of the map in the palette, the same in all frames.

    A palette of its own for each frame has mostly those of the axes, and flickers.
    """

    def finish(self) -> None:
        colours = plt.get_cmap(COLOUR_MAP)(np.linspace(0, 1, 112))[:, :3]
        greys = np.repeat(np.linspace(0, 1, 32)[:, None], 3, axis=1)
        # Bodies in 3D are in the shade where they face away from the light.
        palette = np.concatenate((colours, 0.75 * colours, greys))
        holder = Image.new("P", (1, 1))
        holder.putpalette((255 * palette).round().astype(np.uint8).tobytes())
        frames = [
            frame.convert("RGB").quantize(palette=holder, dither=Image.Dither.NONE)
            for frame in self._frames
        ]
        frames[0].save(
            self.outfile,
            save_all=True,
            append_images=frames[1:],
            duration=round(1000 / self.fps),
            loop=0,
        )
