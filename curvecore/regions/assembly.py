"""Closed contours of chosen edges, as pieces that keep their control points where they were not cut."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.bezier.bernstein_algebra import weights
from curvecore.regions.arrangement import Edges
from curvecore.regions.outlines import Outlines, stretches, with_whole_lines

_BESIDE = 1 / 8
"""Of the shortest edge at a node: how far from it the order of the edges is read."""

_SAMPLED = weights(np.linspace(0.0, 1.0, 257), 3)


class Run(NamedTuple):
    """A stretch of a piece in a contour, from a place on it to another; backwards where that is less."""

    piece: int
    start: float
    end: float


def contours_of(outlines: Outlines, edges: Edges, forwards: BoolArray) -> list[FloatArray] | None:
    """Return closed contours (k, 4, 2) of edges, each forwards or backwards; None where they do not close.

    None passes a node twice.
    """
    node = np.where(forwards[:, None], edges.node, edges.node[:, ::-1])
    balance = np.zeros(int(node.max(initial=0)) + 1, dtype=np.intp)
    np.add.at(balance, node[:, 0], 1)
    np.add.at(balance, node[:, 1], -1)
    if balance.any():
        return None
    following = _following(edges, node, forwards)
    places = zip(edges.piece.tolist(), edges.start.tolist(), edges.end.tolist(), strict=True)
    runs = [
        Run(piece, start, end) if ahead else Run(piece, end, start)
        for (piece, start, end), ahead in zip(places, forwards.tolist(), strict=True)
    ]
    starts = node[:, 0].tolist()
    return [
        _pieces(outlines, _joined([runs[edge] for edge in ring]))
        for cycle in _cycles(following)
        for ring in _simple(cycle, starts)
    ]


def _following(edges: Edges, node: IntArray, forwards: BoolArray) -> list[int]:
    """Return for each edge the one that goes on where it ends, so that contours do not cross there."""
    leaving, coming = defaultdict[int, list[int]](list), defaultdict[int, list[int]](list)
    for edge, (start, end) in enumerate(node.tolist()):
        leaving[start].append(edge)
        coming[end].append(edge)
    following = [-1] * len(node)
    for place, out in leaving.items():
        if len(out) == 1:
            following[coming[place][0]] = out[0]
        else:
            for edge, following_one in _paired(edges, forwards, coming[place], out):
                following[edge] = following_one
    return following


def _paired(
    edges: Edges, forwards: BoolArray, coming: Sequence[int], leaving: Sequence[int]
) -> Iterator[tuple[int, int]]:
    """Yield the edges that come to a node with those that go on: the inside, to their left, lies between."""
    every = np.array([*coming, *leaving])
    # As they leave the node, each of them.
    turned = forwards[every] ^ (np.arange(len(every)) >= len(coming))
    angles = _angles(np.where(turned[:, None, None], edges.controls[every, ::-1], edges.controls[every]))
    around, waiting, left = np.argsort(-angles, kind="stable").tolist(), list[int](), set(leaving)
    # Clockwise from the way back; once more around, for those that began behind the last one.
    for turn, each in [(turn, each) for turn in (0, 1) for each in around]:
        edge = int(every[each])
        if each < len(coming):
            if not turn:
                waiting.append(edge)
        elif waiting and edge in left:
            left.remove(edge)
            yield waiting.pop(), edge


def _angles(controls: FloatArray) -> FloatArray:
    """Return the angles at which pieces (k, 4, 2) are seen from the node where they begin, near it."""
    way = _SAMPLED @ (controls - controls[:, :1])
    away = np.hypot(way[..., 0], way[..., 1])
    first = (away >= _BESIDE * away.max(axis=1).min()).argmax(axis=1)
    x, y = way[np.arange(len(way)), first].T
    angles: FloatArray = np.arctan2(y, x)
    return angles


def _cycles(following: Sequence[int]) -> Iterator[list[int]]:
    """Yield the edges of each way around, in order."""
    seen = [False] * len(following)
    for first in range(len(following)):
        cycle = []
        edge = first
        while not seen[edge]:
            seen[edge] = True
            cycle.append(edge)
            edge = following[edge]
        if cycle:
            yield cycle


def _simple(cycle: Sequence[int], starts: Sequence[int]) -> Iterator[list[int]]:
    """Yield the parts of a way around that pass no node twice."""
    way, at = list[int](), dict[int, int]()
    for edge in (*cycle, None):
        node = starts[cycle[0] if edge is None else edge]
        if node in at:
            place = at[node]
            yield way[place:]
            for each in way[place + 1 :]:
                del at[starts[each]]
            del way[place:]
        at[node] = len(way)
        if edge is not None:
            way.append(edge)


def _joined(runs: Sequence[Run]) -> list[Run]:
    """Return runs around a contour, those that go on in the same piece as one."""
    found = list[Run]()
    for run in runs:
        if found and _goes_on(found[-1], run):
            found[-1] = found[-1]._replace(end=run.end)
        else:
            found.append(run)
    if len(found) > 1 and _goes_on(found[-1], found[0]):
        found[0] = found.pop()._replace(end=found[0].end)
    return found


def _goes_on(run: Run, other: Run) -> bool:
    return (
        run.piece == other.piece
        and run.end == other.start
        and (run.start < run.end) == (other.start < other.end)
    )


def _pieces(outlines: Outlines, runs: Sequence[Run]) -> FloatArray:
    """Return the pieces of runs, each ending exactly where the next begins: in an own end, if it has one."""
    piece = np.array([run.piece for run in runs])
    ends = np.array([(run.start, run.end) for run in runs])
    low, high = ends.min(axis=1), ends.max(axis=1)
    controls: FloatArray = outlines.exact[piece]
    cut = (low > 0.0) | (high < 1.0)
    controls[cut] = stretches(controls[cut], low[cut], high[cut])
    back = ends[:, 0] > ends[:, 1]
    controls[back] = controls[back, ::-1]
    is_own = (ends == 0.0) | (ends == 1.0)
    after = np.roll(controls[:, 0], -1, axis=0)
    by_next = ~is_own[:, 1] & np.roll(is_own[:, 0], -1)
    joint = np.where(by_next[:, None], after, controls[:, 3])
    controls[:, 3], controls[:, 0] = joint, np.roll(joint, 1, axis=0)
    return with_whole_lines(controls, _are_own_joints(outlines, piece, ends))


def _are_own_joints(outlines: Outlines, piece: IntArray, ends: FloatArray) -> BoolArray:
    """Tell which runs end where two pieces of one contour met before, so that the joint was meant."""
    after, start = np.roll(piece, -1), np.roll(ends[:, 0], -1)
    ahead = (ends[:, 1] == 1.0) & (start == 0.0) & (outlines.following[piece] == after)
    back = (ends[:, 1] == 0.0) & (start == 1.0) & (outlines.following[after] == piece)
    are_own: BoolArray = ahead | back
    return are_own
