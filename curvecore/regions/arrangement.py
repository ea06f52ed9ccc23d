"""Nodes where pieces of contours meet, and the edges between them.

What lies nearer together than a tolerance is one node. Edges between the
same two nodes that are together halfway are one edge, which several regions
share. What is to the left and to the right of an edge follows from a ray to
its left (`rays`): beyond lies what counts for its left side, near it the
edge itself, and what else is found there makes another place of it better.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from curvecore.analysis.clusters import connected_labels, near_pairs
from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.bezier.bernstein_algebra import derivative, values, weights
from curvecore.regions.meetings import Meetings, meetings
from curvecore.regions.outlines import Outlines, is_small, stretches
from curvecore.regions.rays import Rays, crossed
from curvecore.scaling import SMALLEST
from curvecore.vectors import vector_lengths

_NODE, _BESIDE = 16.0, 4.0
"""How large a node is, and how near an edge what is part of it, in tolerances."""

_LOOKED_AT = (0.5, 0.41, 0.59, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9)
"""Where on an edge a ray may begin; the first one that meets nothing else nearby is taken."""

_PLACES = 33
_STEPS = 8


class Edges(NamedTuple):
    """Stretches of pieces between nodes.

    Attributes
    ----------
    piece : ndarray of int, shape (k,)
    start, end : ndarray, shape (k,)
        Where on that piece each begins and ends, in [0, 1].
    node : ndarray of int, shape (k, 2)
        Its first and its last node.
    controls : ndarray, shape (k, 4, 2)
        Its control points.
    """

    piece: IntArray
    start: FloatArray
    end: FloatArray
    node: IntArray
    controls: FloatArray

    def taken(self, chosen: BoolArray | IntArray) -> Edges:
        """Return some of the edges."""
        return Edges._make(each[chosen] for each in self)


class Arrangement(NamedTuple):
    """Edges of which no two meet but in nodes, with what is beside them.

    Attributes
    ----------
    edges : Edges
        One of each that coincide.
    left, right : ndarray of int, shape (k, regions)
        The winding numbers of the regions on either side.
    """

    edges: Edges
    left: IntArray
    right: IntArray


def arranged(
    outlines: Outlines,
    regions: int,
    tolerance: float,
    progress: Callable[[float], object] = lambda _share: None,
) -> Arrangement:
    """Return the edges of the contours of regions; the tolerance is in units of `outlines.controls`."""
    found = meetings(outlines.controls, tolerance, lambda share: progress(0.5 * share))
    edges = _edges(outlines, found, _NODE * tolerance)
    first, sense = _alike(edges, _BESIDE * tolerance)
    through = np.zeros((len(edges.piece), regions), dtype=np.intp)
    np.add.at(through, (first, outlines.region[edges.piece]), sense)
    distinct = first == np.arange(len(first))
    edges, through = edges.taken(distinct), through[distinct]
    left = _left_windings(
        outlines, edges, through, _BESIDE * tolerance, lambda share: progress(0.5 + 0.5 * share)
    )
    return Arrangement(edges, left, left - through)


# Nodes and edges


def _edges(outlines: Outlines, met: Meetings, reach: float) -> Edges:
    """Return the edges of pieces that are cut where they meet; none shorter than what a node takes up."""
    count = len(outlines.controls)
    piece = np.concatenate([np.arange(count), met.piece.ravel()])
    place = np.concatenate([np.zeros(count), met.place.ravel()])
    spots = values(outlines.controls[piece], place)
    # The two places of a meeting are one, however far apart roundings have left them.
    meeting = count + 2 * np.arange(len(met.piece))
    node = _nodes(spots, np.stack((meeting, meeting + 1)), reach)
    # Each piece ends in the node where the next begins.
    piece, place = np.append(piece, np.arange(count)), np.append(place, np.ones(count))
    node = np.append(node, node[outlines.following])
    order = np.lexsort((place, piece))
    piece, place, node = _cuts(outlines.controls, piece[order], place[order], node[order], reach)
    same = np.flatnonzero(piece[1:] == piece[:-1])
    piece, start, end = piece[same], place[same], place[same + 1]
    both = np.stack((node[same], node[same + 1]), axis=1)
    return Edges(piece, start, end, both, stretches(outlines.controls[piece], start, end))


def _cuts(
    controls: FloatArray, piece: IntArray, place: FloatArray, node: IntArray, reach: float
) -> tuple[IntArray, FloatArray, IntArray]:
    """Return places on pieces, in order, those of one node as one: the end of the piece if it is among them.

    Not those between which the piece leaves the node.
    """
    near = (piece[1:] == piece[:-1]) & (node[1:] == node[:-1])
    which = np.flatnonzero(near)
    between = stretches(controls[piece[which]], place[which], place[which + 1])
    near[which] = is_small(between, 4.0 * reach)
    first = np.flatnonzero(np.append(True, ~near))
    last = np.append(first[1:], len(piece)) - 1
    return piece[first], np.where(place[last] == 1.0, 1.0, place[first]), node[first]


def _nodes(spots: FloatArray, known: IntArray, reach: float) -> IntArray:
    """Return the node of each place (m, 2); pairs (2, k) are known to be one."""
    order = np.lexsort((spots[:, 1], spots[:, 0]))
    one, other = near_pairs(spots[order], np.full(spots.shape, reach))
    pairs = np.concatenate([known, np.stack((order[one], order[other]))], axis=1)
    return connected_labels(len(spots), pairs[0], pairs[1])


def _alike(edges: Edges, reach: float) -> tuple[IntArray, IntArray]:
    """Return for each edge the first that coincides with it, and whether it runs as that does, 1 or -1."""
    count = len(edges.piece)
    first, sense = np.arange(count), np.ones(count, dtype=np.intp)
    ends = np.sort(edges.node, axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    ends = ends[order]
    # Of so many that have both ends in common, each is compared with all before it.
    for step in range(1, count):
        same = np.flatnonzero((ends[step:] == ends[:-step]).all(axis=1))
        if not len(same):
            break
        one, other = order[same], order[same + step]
        place, away = _nearest(edges.controls[one], values(edges.controls[other], np.full(len(other), 0.5)))
        together = away <= reach
        one, other, place = one[together], other[together], place[together]
        runs = values(derivative(edges.controls[one]), place)
        way = values(derivative(edges.controls[other]), np.full(len(other), 0.5))
        turned = np.where((runs * way).sum(axis=1) < 0.0, -1, 1)
        earlier = first[one] < first[other]
        first[other] = np.where(earlier, first[one], first[other])
        sense[other] = np.where(earlier, sense[one] * turned, sense[other])
    return first, sense


def _nearest(controls: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return where pieces (k, 4, 2) are nearest to points (k, 2), and how far away."""
    offset = controls - points[:, None]
    tried = np.linspace(0.0, 1.0, _PLACES)
    every = np.hypot(*np.moveaxis(weights(tried, 3) @ offset, 2, 0))
    place, away = tried[every.argmin(axis=1)], every.min(axis=1)
    slopes = derivative(offset)
    for _ in range(_STEPS):
        at, slope = values(offset, place), values(slopes, place)
        step = (at * slope).sum(axis=1) / np.maximum(np.square(slope).sum(axis=1), SMALLEST)
        moved = np.clip(place - step, 0.0, 1.0)
        distance = np.hypot(*values(offset, moved).T)
        better = distance < away
        place, away = np.where(better, moved, place), np.where(better, distance, away)
    return place, away


# What is beside them


def _left_windings(
    outlines: Outlines,
    edges: Edges,
    through: IntArray,
    reach: float,
    progress: Callable[[float], object],
) -> IntArray:
    """Return the winding numbers to the left of edges through which regions pass so often, (k, regions)."""
    pieces, region, count = outlines.controls, outlines.region, through.shape[1]
    left = np.zeros_like(through)
    waiting = np.arange(len(through))
    for place in _LOOKED_AT:
        rays = _rays(edges.controls[waiting], place)
        found = crossed(pieces, region, count, rays, reach, progress)
        left[waiting] = -found.beyond
        waiting = waiting[(found.near != through[waiting]).any(axis=1)]
        if not len(waiting):
            break
    return left


def _rays(controls: FloatArray, place: float) -> Rays:
    at = np.full(len(controls), place)
    slope = values(derivative(controls), at)
    size = vector_lengths(slope)
    # At rest: the chord says where it goes.
    slope = np.where(size[:, None] > 0.0, slope, controls[:, -1] - controls[:, 0])
    return Rays(values(controls, at), slope / np.maximum(vector_lengths(slope), SMALLEST)[:, None])
