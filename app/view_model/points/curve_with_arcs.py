"""A curve with arcs in place of corners: its points, and its segments by their derivatives at both ends.

All Hermite families hold the cubic pieces of arcs exactly, and what arcs leave of segments of their own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.edits import EditError
from ...document.model import Curve, Point, Vector
from ..curve.curve_view import CurveView, view_of
from .corner_arc import FLAT, Arc
from .touching_arc import Side
from .wanted import Derivatives, with_sides, with_wanted

_SLIVER = 1e-5
"""Share of a curved side of which nothing is left between two arcs: a thirtieth of what an arc is off."""


class _Node(msgspec.Struct):
    """A point of the curve afterwards: its place, its parameter, and which point it was before, if one."""

    place: FloatArray
    t: float
    old: int | None = None


Ends = FloatArray
"""Derivatives of a segment by a parameter from 0 to 1 at its two ends, from order 1 on, (2, R − 1, 2)."""


class CurveWithArcs:
    """The points and segments of a curve with arcs in place of corners."""

    def __init__(
        self, view: CurveView, arcs: Mapping[int, Arc], pieces: FloatArray, straight: list[bool]
    ) -> None:
        """Put arcs at points; `pieces` are the control points of all segments, some of them `straight`."""
        self._view, self._arcs, self._pieces, self._straight = view, arcs, pieces, straight
        self.nodes: list[_Node] = []
        self._segments: list[tuple[Ends, bool]] = []
        for index in range(len(view.source.points)):
            self._add_point(index)
            if index < len(view.parameters) - 1:
                self._add_side(index)
        if view.source.is_closed and len(self.nodes) > len(self._segments):
            self._close()

    def _close(self) -> None:
        """Let the first point and the last be one: nothing is left of the side that leads back."""
        if self.nodes[-1].old is None:
            self.nodes.pop()
            return
        # A point that stays keeps its place in the order.
        del self.nodes[0]
        self._segments.append(self._segments.pop(0))

    def _add_point(self, index: int) -> None:
        """Add a point that stays, or the arc in its place."""
        t = self._view.parameters
        if index not in self._arcs:
            self._meet(_Node(self._view.points[index], float(t[index]), index))
            return
        arc, at = self._arcs[index], float(t[index])
        behind = (index - 1) % len(self._view.source.points)
        spans = (float(t[each + 1] - t[each]) for each in (behind, index))
        before, after = (span * share for span, share in zip(spans, arc.shares, strict=True))
        self._meet(_Node(arc.start, at - before))
        count = len(arc.pieces)
        for number, piece in enumerate(arc.pieces, start=1):
            # The middle of two at the corner's own parameter.
            way = 2 * number / count - 1
            self._add_piece(_Node(piece.end, at + way * (after if way > 0 else before)), *piece[1:])

    def _meet(self, node: _Node) -> None:
        """Add a point behind a side, or let it be the last one, where nothing was left of that."""
        if len(self.nodes) == len(self._segments):
            self.nodes.append(node)
        elif node.old is not None:
            self.nodes[-1] = node

    def _add_piece(self, end: _Node, leaving: FloatArray, arriving: FloatArray) -> None:
        """Add a cubic piece from the last point, given by its handles."""
        chord = end.place - self.nodes[-1].place
        bend = [6 * (chord - 2 * leaving - arriving), 6 * (2 * arriving + leaving - chord)]
        jerk = 6 * (3 * leaving + 3 * arriving - 2 * chord)
        self._add(np.array([[3 * leaving, bend[0], jerk], [3 * arriving, bend[1], jerk]]), is_side=False)
        self.nodes.append(end)

    def _add_side(self, index: int) -> None:
        """Add the segment behind a point as it was, or what arcs leave of it."""
        following = (index + 1) % len(self._view.source.points)
        first = self._arcs[index].shares[1] if index in self._arcs else 0.0
        last = self._arcs[following].shares[0] if following in self._arcs else 0.0
        if not first and not last:
            self._add(self._as_it_was(index), is_side=False)
        elif first + last >= 1 - (FLAT if self._straight[index] else _SLIVER):
            return
        elif self._straight[index]:
            end = self._arcs[following].start if following in self._arcs else self._view.points[following]
            line = np.zeros((2, 3, 2))
            line[:, 0] = end - self.nodes[-1].place
            self._add(line, is_side=True)
        else:
            side, width = Side(self._pieces[index]), 1.0 - first - last
            ends = [[side.at(u, order) * width**order for order in (1, 2, 3)] for u in (first, 1.0 - last)]
            self._add(np.array(ends), is_side=True)

    def _add(self, ends: Ends, *, is_side: bool) -> None:
        self._segments.append((ends[:, : self._view.source.family.derivatives], is_side))

    def _as_it_was(self, segment: int) -> Ends:
        view = self._view
        assert view.sides is not None
        h = float(view.parameters[segment + 1] - view.parameters[segment])
        following = (segment + 1) % len(view.source.points)
        jets = np.array([view.sides.after[segment, 1:], view.sides.before[following, 1:]])
        return jets * h ** np.arange(1.0, jets.shape[1] + 1)[:, None]

    # The curve

    def curve(self) -> Curve:
        """Return the curve."""
        source = self._view.source
        shift = float(self._view.parameters[0]) - self.nodes[0].t if source.is_manual else 0.0
        bare = [self._bare(at, node, shift) for at, node in enumerate(self.nodes)]
        after = view_of(replace(source, points=tuple(bare)))
        if not after.is_current:
            raise EditError("The radius is too small for a curve of this size.")
        wanted = dict(self._wanted(np.diff(after.parameters)))
        points = [
            point if node.old is not None else _of_arc(point, wanted[at, False], wanted[at, True])
            for at, (point, node) in enumerate(zip(bare, self.nodes, strict=True))
        ]
        stays = {side: wanted[side] for side in wanted if self.nodes[side[0]].old is not None}
        return with_wanted(replace(source, points=tuple(points)), stays)

    def _bare(self, at: int, node: _Node, shift: float) -> Point:
        """Return a point as it was; one of an arc without derivatives, a corner where it ends a side."""
        source = self._view.source
        if node.old is not None:
            point = source.points[node.old]
            return replace(point, t=node.t + shift) if shift else point
        is_end = self._segments[at - 1][1] or self._segments[at][1]
        t = node.t + shift if source.is_manual else None
        x, y = _vector(node.place)
        return Point(x, y, t=t, corner=is_end)

    def _wanted(self, spacings: FloatArray) -> Iterator[tuple[tuple[int, bool], Derivatives]]:
        """Yield the derivatives of the points on each side, in segments of these lengths in t."""
        for at, ((ends, _), h) in enumerate(zip(self._segments, spacings.tolist(), strict=True)):
            scaled = ends * h ** -np.arange(1.0, ends.shape[1] + 1)[:, None]
            for ahead, point, derivatives in ((True, at, scaled[0]), (False, at + 1, scaled[1])):
                yield (point % len(self.nodes), ahead), [_vector(each) for each in derivatives]


def _of_arc(point: Point, before: Derivatives, after: Derivatives) -> Point:
    """Return a point with its derivatives: smooth, and tied to a side that it ends."""
    return with_sides(replace(point, tied=point.corner), before, after)


def _vector(values: FloatArray) -> Vector:
    # No −0.0, which would be shown.
    return (float(values[0]) + 0.0, float(values[1]) + 0.0)
