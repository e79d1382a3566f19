# SPDX-License-Identifier: LGPL-2.1-or-later
"""Overlap of a body in 2D with itself, from a picture of it alone.

The method is independent of contact, and of the search for it in the programs. The outline of a
deformed mesh goes around any point of the plane as often as the body covers it. Where that is twice
or more the body overlaps itself. The border of that region is made of pieces of the outline, cut
where its sides cross; the depth of a point of such a piece is its distance from the other pieces.
"""

from dataclasses import dataclass

import numpy as np

from . import meshes


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


@dataclass(frozen=True)
class Overlap:
    depth: float  # m, of the deepest point of the outline
    area: float  # m^2; what is covered three times counts twice
    pieces: np.ndarray  # (n, 2, 2): the border of the overlap, from point to point


NONE = Overlap(0.0, 0.0, np.zeros((0, 2, 2)))


def outlines(points, cells):
    """The closed lines around triangles, each a list of vertices; the body is on their left.

    The triangles may have any orientation; `points` are those at rest.
    """
    corners = points[cells]
    turned = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) < 0
    cells = np.where(turned[:, None], cells[:, ::-1], cells)
    sides = {(a, b) for one in cells.tolist() for a, b in zip(one, one[1:] + one[:1])}
    following = {a: b for a, b in sides if (b, a) not in sides}
    lines = []
    while following:
        line = [next(iter(following))]
        while (vertex := following.pop(line[-1])) != line[0]:
            line.append(vertex)
        lines.append(line)
    return lines


def crossings(start, end):
    """For each side of the outline, sorted, where others cross it: parts of its length.

    Sides that meet in a vertex do not cross.
    """
    low, high = np.minimum(start, end), np.maximum(start, end)
    near = (low[:, None] <= high[None]).all(axis=2)
    first, second = np.nonzero(np.triu(near & near.T, 1))
    along, other = end[first] - start[first], end[second] - start[second]
    between = start[second] - start[first]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = cross(between, other) / cross(along, other)
        t = cross(between, along) / cross(along, other)
    meet = (start[first] == end[second]).all(axis=1) | (end[first] == start[second]).all(axis=1)
    found = (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1) & ~meet
    cuts = [[] for _ in start]
    for a, b, at_a, at_b in zip(first[found], second[found], s[found], t[found]):
        cuts[a].append(at_a)
        cuts[b].append(at_b)
    return [sorted(cut) for cut in cuts]


def times_covered(places, own, start, end):
    """How often the body covers the right-hand side of these places on its outline.

    Each place is on the side `own`, whose body is on the left: that counts as half.
    """
    to_start, to_end = start - places[:, None], end - places[:, None]
    angle = np.arctan2(cross(to_start, to_end), (to_start * to_end).sum(axis=2))
    angle[np.arange(len(places)), own] = 0
    return np.rint(angle.sum(axis=1) / (2 * np.pi) - 0.5).astype(int)


def distances(places, pieces):
    """The distance of each place from each piece."""
    start, along = pieces[:, 0], pieces[:, 1] - pieces[:, 0]
    away = places[:, None] - start
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    part = np.clip((away * along).sum(axis=2) / length, 0, 1)
    return np.linalg.norm(away - part[..., None] * along, axis=2)


def overlap_of(lines):
    """The overlap of the body whose outline is made of these closed lines, with the body on
    their left: each an array (n, 2) of vertices in order."""
    start = np.concatenate(lines)
    end = np.concatenate([np.roll(line, -1, axis=0) for line in lines])
    cuts = crossings(start, end)
    if not any(cuts):
        # (A body all of which is in another one is not looked for.)
        return NONE
    # All pieces between crossings, in order.
    own, begin, stop = [], [], []
    for side, cut in enumerate(cuts):
        places = [0.0, *cut, 1.0]
        own += [side] * (len(places) - 1)
        begin += places[:-1]
        stop += places[1:]
    own, begin, stop = np.array(own), np.array(begin), np.array(stop)
    a = start[own] + begin[:, None] * (end - start)[own]
    b = start[own] + stop[:, None] * (end - start)[own]
    covered = times_covered((a + b) / 2, own, start, end) >= 1
    if not covered.any():
        return NONE

    # Chains of pieces that follow each other without a crossing between them: they belong to
    # one side of the overlap.
    first_of_line = np.concatenate(([0], np.cumsum([len(line) for line in lines])))
    chain = np.zeros(len(own), int)
    for low, high in zip(first_of_line[:-1], first_of_line[1:]):
        here = np.flatnonzero((own >= low) & (own < high))
        begins = begin[here] > 0
        chain[here] = chain.max() + 1 + np.cumsum(begins)
        # The last one goes on at the first vertex.
        if begins.any():
            chain[here[chain[here] == chain[here[0]]]] = chain[here[-1]]
    pieces, chain = np.stack((a, b), axis=1)[covered], chain[covered]
    places = np.concatenate((pieces[:, 0], pieces.mean(axis=1)))
    far = distances(places, pieces)
    far[np.concatenate((chain, chain))[:, None] == chain] = np.inf
    depth = far.min(axis=1)
    # A loop that crosses itself has no other side: then the path back to its crossing.
    alone = np.isinf(depth)
    if alone.any():
        ends = pieces[:, 0][begin[covered] > 0]
        depth[alone] = np.linalg.norm(places[alone, None] - ends, axis=2).min(axis=1)
    return Overlap(depth.max(), cross(pieces[:, 0], pieces[:, 1]).sum() / 2, pieces)


def overlap_in(path):
    """The overlap of the body in a VTU file.

    Such files have single precision: numbers below a millionth of the lengths in them are
    round-off.
    """
    points, cells, fields = meshes.read(path)
    place = points + fields["displacement"][:, :2].astype(float)
    return overlap_of([place[line] for line in outlines(points, cells)])


def regions(pieces):
    """The closed lines that are made of the pieces of an overlap, each (n, 2)."""
    left, lines = list(range(len(pieces))), []
    while left:
        line = [left.pop(0)]
        while left:
            here = pieces[line[-1], 1]
            ways = np.linalg.norm(pieces[left, 0] - here, axis=1)
            # At its beginning again?
            if np.linalg.norm(pieces[line[0], 0] - here) <= ways.min():
                break
            line.append(left.pop(ways.argmin()))
        lines.append(pieces[line, 0])
    return lines
