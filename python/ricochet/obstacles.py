# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rigid obstacles of a run in the plane, as its parameters tell, for pictures."""

from __future__ import annotations

import math
from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.patches import Circle, Polygon

FACE, EDGE = "0.88", "0.25"


def _numbers(text: str) -> list[float]:
    return [float(part) for part in text.replace(";", ",").split(",")]


def _is_at_rest(section: Mapping[str, str]) -> bool:
    """Whether its motion is plainly none: expressions of time are not evaluated here."""
    parts = section.get("Translation", "0").split(";") + [section.get("Rotation", "0")]
    try:
        return all(float(part) == 0.0 for part in parts)
    except ValueError:
        return False


def sections(parameters: Mapping[str, str]) -> list[dict[str, str]]:
    """The parameters of each obstacle of a run, whether its section has a name or not."""
    found: dict[str, dict[str, str]] = {}
    for name, value in parameters.items():
        section, _, last = name.rpartition("/")
        if section == "Obstacle" or section.startswith("Obstacle "):
            found.setdefault(section, {})[last] = value
    return list(found.values())


def draw(panel: Axes, parameters: Mapping[str, str], size: float) -> None:
    """Draw half spaces and circles that are at rest behind a picture.

    `size` is a length beyond which nothing is seen. Level sets and obstacles that move are left
    out.
    """
    for section in sections(parameters):
        if not _is_at_rest(section):
            continue
        try:
            centre = _numbers(section.get("Centre", "0, 0"))
            direction = _numbers(section.get("Direction", "0, 1"))
            radius = float(section.get("Radius", "1"))
        except ValueError:
            continue
        if len(centre) != 2 or len(direction) != 2:
            continue
        if section.get("Shape") == "half space":
            length = math.hypot(*direction)
            nx, ny = direction[0] / length, direction[1] / length
            far = 10.0 * size
            corners = [
                (
                    centre[0] - along * ny * far - deep * nx * far,
                    centre[1] + along * nx * far - deep * ny * far,
                )
                for along, deep in ((-1, 0), (1, 0), (1, 1), (-1, 1))
            ]
            panel.add_patch(
                Polygon(corners, facecolor=FACE, edgecolor=EDGE, linewidth=1.0, zorder=1.5)
            )
        elif section.get("Shape") == "circle":
            inside = section.get("Body inside", "false") == "true"
            panel.add_patch(
                Circle(
                    (centre[0], centre[1]),
                    radius,
                    facecolor="none" if inside else FACE,
                    edgecolor=EDGE,
                    linewidth=1.0,
                    zorder=1.5,
                )
            )
