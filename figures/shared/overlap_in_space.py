# SPDX-License-Identifier: LGPL-2.1-or-later
"""Overlap of bodies of hexahedra in 3D with each other or with themselves, from a picture alone.

The method is independent of contact, and of the search for it in the programs. The boundary of a
deformed mesh is seen from any point of space under 4 pi as often as the bodies cover it. Points
within the cells that are covered twice give the volume of the overlap; nodes of the boundary that
are covered by cells which they are not part of give its depth.
"""

from dataclasses import dataclass

import numpy as np

from ricochet.fields import array, array_of_points
from ricochet.results import read_fields

# Faces of VTK's hexahedron, seen anticlockwise from outside.
FACES = ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))


@dataclass(frozen=True)
class Overlap:
    volume: float  # m^3; what is covered three times counts twice
    depth: float  # m, of the deepest node in cells which it is not part of


def read(path):
    """Vertices before any displacement (n, 3), where they are, hexahedra (m, 8)."""
    grid = read_fields(path)
    points = array_of_points(grid).astype(float)
    moved = points + array(grid, "displacement").astype(float)
    cells = np.array([[grid.GetCell(c).GetPointId(i) for i in range(8)]
                      for c in range(grid.GetNumberOfCells())])
    # Each cell has vertices of its own; of several bodies only those that coincide before any
    # displacement are joined.
    key = np.round(points / (1e-6 * np.abs(points).max())).astype(np.int64)
    _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    return points[first], moved[first], inverse.reshape(-1)[cells]


def boundary(cells):
    """Quadrilaterals (n, 4) that only one cell has, anticlockwise from outside."""
    faces = np.concatenate([cells[:, face] for face in FACES])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True,
                                return_counts=True)
    return faces[first[count == 1]]


def triangles(x, quads):
    """Four of each around its middle: (n, 3, 3)."""
    corners = x[quads]
    middle = corners.mean(axis=1)
    return np.concatenate([np.stack((corners[:, v], corners[:, (v + 1) % 4], middle), axis=1)
                           for v in range(4)])


def times_covered(places, surface):
    """How often each place is inside of the surface: its solid angle by 4 pi (A. van Oosterom and
    J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126)."""
    total = np.empty(len(places))
    for begin in range(0, len(places), 500):
        a, b, c = (surface[:, v] - places[begin:begin + 500, None] for v in range(3))
        la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
        volume = (a * np.cross(b, c)).sum(axis=2)
        rest = (la * lb * lc + (a * b).sum(axis=2) * lc + (b * c).sum(axis=2) * la +
                (c * a).sum(axis=2) * lb)
        total[begin:begin + 500] = 2. * np.arctan2(volume, rest).sum(axis=1)
    return np.rint(total / (4. * np.pi)).astype(int)


def inner_points(x, cells):
    """The eight Gauss points of each cell and their weights (m^3)."""
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                        (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
    places, weights = [], []
    for point in .5 + (corners - .5) / np.sqrt(3.):
        factor = np.where(corners, point, 1. - point)  # (8, 3)
        shape = factor.prod(axis=1)
        sign = 2. * corners - 1.
        gradient = np.stack([sign[:, c] * np.delete(factor, c, axis=1).prod(axis=1)
                             for c in range(3)], axis=1)
        places.append(np.einsum("i,nic->nc", shape, x[cells]))
        weights.append(np.linalg.det(np.einsum("id,nic->ncd", gradient, x[cells])) / 8.)
    return np.concatenate(places), np.concatenate(weights)


def distances(places, surface):
    """From each place to each triangle (n, m)."""
    best = None
    a, b, c = (surface[:, v] for v in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    r = places[:, None] - a
    height = (r * normal).sum(axis=2)
    inside = np.ones(height.shape, bool)
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        to_place = places[:, None] - start
        inside &= (np.cross(normal, along) * to_place).sum(axis=2) >= 0.
        part = np.clip((to_place * along).sum(axis=2) / (along**2).sum(axis=1), 0., 1.)
        away = np.linalg.norm(to_place - part[..., None] * along, axis=2)
        best = away if best is None else np.minimum(best, away)
    return np.where(inside, np.abs(height), best)


def overlap_of(x, cells):
    """Overlap of hexahedra with vertices at x."""
    quads = boundary(cells)
    surface = triangles(x, quads)
    places, weights = inner_points(x, cells)
    covered = np.maximum(times_covered(places, surface), 1)
    volume = (weights * (covered - 1) / covered).sum()

    # Nodes, a little outside of their own facets.
    nodes = np.unique(quads)
    outward = np.zeros_like(x)
    diagonals = np.cross(x[quads[:, 2]] - x[quads[:, 0]], x[quads[:, 3]] - x[quads[:, 1]])
    for v in range(4):
        np.add.at(outward, quads[:, v], diagonals)
    outward /= np.maximum(np.linalg.norm(outward, axis=1), 1e-300)[:, None]
    size = 1e-5 * np.ptp(x, axis=0).max()
    deep = nodes[times_covered(x[nodes] + size * outward[nodes], surface) > 0]
    depth = 0.
    of_quad = np.tile(np.arange(len(quads)), 4)
    for node in deep:
        own = np.unique(quads[(quads == node).any(axis=1)])
        other = ~np.isin(quads, own).any(axis=1)[of_quad]
        depth = max(depth, distances(x[[node]], surface[other]).min())
    return Overlap(float(volume), float(depth))


def bodies(cells):
    """The hexahedra of each body: connected by vertices."""
    body = np.arange(cells.max() + 1)
    while True:
        lowest = body.copy()
        np.minimum.at(lowest, cells, body[cells].min(axis=1)[:, None])
        if (lowest == body).all():
            return [cells[body[cells[:, 0]] == one] for one in np.unique(body[cells])]
        body = lowest


def overlap_in(path, itself=False):
    """Overlap of all bodies in a VTU file, or of each with itself alone: then the sum of the
    volumes and the deepest node."""
    _, x, cells = read(path)
    if not itself:
        return overlap_of(x, cells)
    each = []
    for own in bodies(cells):
        vertices, renumbered = np.unique(own, return_inverse=True)
        each.append(overlap_of(x[vertices], renumbered.reshape(own.shape)))
    return Overlap(sum(one.volume for one in each), max(one.depth for one in each))
