"""Corners between straight segments made circular arcs that go on from both sides.

An arc is cubic, in one piece up to a right angle and in two beyond: within 2.8e-4 of its radius [1]_, and of
one direction with the sides where it leaves them. All Hermite families hold such pieces exactly.

References
----------
.. [1] M. Goldapp, "Approximation of circular arcs by cubic polynomials", CAGD 8 (1991) 227-238.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.curve_edits import replace_curve
from ..document.edits import EditError
from ..document.model import Curve, Document, Point, Vector
from ..document.point_group import some_points
from ..document.straight_edits import why_not_straight
from ..document.transforms import decimal_sum
from .curve_view import CurveView, view_of
from .reshape import refuse_without_curve
from .smoothness import inner_points
from .wanted import Derivatives, with_sides, with_wanted

_FLAT = 1e-9
"""Share of a segment's length up to which its control points lie on a line, and nothing is left of a side."""

_TURNS = 1e-3
"""Angle in radians by which the curve turns at a corner at least, and by which it does not turn back."""


class Rounded(msgspec.Struct, frozen=True):
    """A curve with corners made arcs.

    Attributes
    ----------
    curve
        The curve.
    new
        The points of the arcs.
    radii
        The radius of each arc: the one asked for, or the largest that fits.
    left
        How many corners beside curved segments were left.
    """

    curve: Curve
    new: frozenset[int]
    radii: tuple[float, ...]
    left: int


@dataclass(frozen=True, eq=False)
class _Corner:
    """A corner of straight sides: its place, and the directions in which they lead to it and on."""

    place: FloatArray
    towards: FloatArray
    onwards: FloatArray

    @cached_property
    def cross(self) -> float:
        """Sine of the angle by which the curve turns, above 0 to the left."""
        return float(self.towards[0] * self.onwards[1] - self.towards[1] * self.onwards[0])

    @cached_property
    def dot(self) -> float:
        """Its cosine."""
        return float(self.towards @ self.onwards)

    @cached_property
    def slope(self) -> float:
        """Tangent of half the angle: how far an arc of radius 1 reaches along the sides."""
        # Exactly 1 at a right angle, as math.tan is not.
        return abs(self.cross) / (1.0 + self.dot)

    def along(self, way: float) -> FloatArray:
        """Return the place on a side: at −`way` before the corner, at `way` behind it."""
        by = (self.towards if way < 0 else self.onwards) * way
        # In decimals, so that a corner at 0.3 that is cut by 0.1 begins at 0.2.
        return np.array([decimal_sum(*each) for each in zip(self.place.tolist(), by.tolist(), strict=True)])

    def middle(self, cut: float) -> tuple[FloatArray, FloatArray]:
        """Return the middle of the arc, and the direction there."""
        out = self.towards - self.onwards
        out /= math.hypot(*out)
        angle = math.atan2(abs(self.cross), self.dot)
        inwards = cut * math.tan(angle / 4)
        side = math.copysign(1.0, self.cross)
        return self.place - out * inwards, np.array([-out[1], out[0]]) * side

    def handle(self, cut: float) -> float:
        """Return how far the Bézier handles of its pieces reach."""
        angle = math.atan2(abs(self.cross), self.dot)
        return 4 / 3 * math.tan(angle / (8 if self.is_wide else 4)) * cut / self.slope

    @property
    def is_wide(self) -> bool:
        """Whether it turns by more than a right angle."""
        return self.dot < -_FLAT


class _Node(msgspec.Struct):
    """A point of the curve afterwards: its place, its parameter, and which point it was before, if one."""

    place: FloatArray
    t: float
    old: int | None = None


Ends = FloatArray
"""Derivatives of a segment by a parameter from 0 to 1 at its two ends, from order 1 on, (2, R − 1, 2)."""


def rounded(view: CurveView, indices: Collection[int], radius: float) -> Rounded:
    """Return the curve of a view with its corners among the points `indices` made arcs.

    Where an arc does not fit, it is the largest that does: half of a side whose other end is round, too,
    unless that one needs less.

    Raises
    ------
    EditError
        If its family has no straight segments, there is no curve, or the radius is next to nothing.
    """
    if reason := why_not_straight(view.source.family):
        raise EditError(reason)
    refuse_without_curve(view)
    corners, left = _corners(view, indices)
    if not corners:
        return Rounded(view.source, frozenset(), (), left)
    cuts = _cuts(view, corners, radius)
    made = _Made(view, corners, cuts)
    curve = made.curve()
    radii = tuple(cuts[index] / corner.slope for index, corner in corners.items())
    new = frozenset(place for place, node in enumerate(made.nodes) if node.old is None)
    return Rounded(curve, new, radii, left)


def with_rounded(document: Document, made: Mapping[int, Rounded]) -> Document:
    """Return the document with these curves in the place of its own; every number is checked.

    Raises
    ------
    EditError
        If one of them is locked, or a number is out of range.
    """
    some_points((curve, each.new) for curve, each in made.items()).refuse_locked(document)
    curves = list(document.curves)
    for place, each in made.items():
        # One by one: to replace one of thousands takes long.
        curves[place] = replace_curve(Document((curves[place],)), 0, each.curve).curves[0]
    return replace(document, curves=tuple(curves))


def _corners(view: CurveView, indices: Collection[int]) -> tuple[dict[int, _Corner], int]:
    """Return the corners between straight segments among some points, and the number of others."""
    pieces = _pieces(view)
    straight = _are_straight(pieces)
    found, left = dict[int, _Corner](), 0
    for index in inner_points(view.source, indices):
        behind = (index - 1) % len(view.source.points)
        corner = _Corner(view.points[index], -_direction(pieces[behind][::-1]), _direction(pieces[index]))
        if not _TURNS < math.atan2(abs(corner.cross), corner.dot) < math.pi - _TURNS:
            continue
        if straight[behind] and straight[index]:
            found[index] = corner
        else:
            left += 1
    return found, left


def _pieces(view: CurveView) -> FloatArray:
    """Return the Bézier control points of all segments, (k, 2 R, 2)."""
    pieces = [piece.bezier_pieces() for piece in view.pieces]
    return np.concatenate([each for each in pieces if each is not None])


def _are_straight(pieces: FloatArray) -> list[bool]:
    """Return which pieces run along their chords, from one end to the other."""
    chords = pieces[:, -1] - pieces[:, 0]
    squares = np.einsum("kd,kd->k", chords, chords)[:, None]
    ways = pieces - pieces[:, :1]
    with np.errstate(all="ignore"):
        across = np.abs(chords[:, None, 0] * ways[..., 1] - chords[:, None, 1] * ways[..., 0]) / squares
        along = np.einsum("kd,kjd->kj", chords, ways) / squares
        fits = (across <= _FLAT) & (along >= -_FLAT) & (along <= 1 + _FLAT)
    result: list[bool] = fits.all(axis=1).tolist()
    return result


def _direction(controls: FloatArray) -> FloatArray:
    """Return the direction in which a piece leaves its first control point; zero where it has no length."""
    for way in controls[1:] - controls[0]:
        if length := math.hypot(*way):
            return np.asarray(way / length)
    return np.zeros(2)


def _cuts(view: CurveView, corners: Mapping[int, _Corner], radius: float) -> dict[int, float]:
    """Return how far the arc at each corner reaches along its sides."""
    count = len(view.source.points)
    wanted = {index: radius * corner.slope for index, corner in corners.items()}
    cuts = dict(wanted)
    for index in corners:
        for other in ((index - 1) % count, (index + 1) % count):
            side = math.dist(view.points[index], view.points[other])
            room = side if other not in wanted else max(side / 2, side - wanted[other])
            cuts[index] = min(cuts[index], room)
    return cuts


class _Made:
    """The points and segments of a curve with arcs in place of corners."""

    def __init__(self, view: CurveView, corners: Mapping[int, _Corner], cuts: Mapping[int, float]) -> None:
        self._view, self._corners, self._cuts = view, corners, cuts
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
        t, count = self._view.parameters, len(self._view.source.points)
        if index not in self._corners:
            self._meet(_Node(self._view.points[index], float(t[index]), index))
            return
        corner, cut, at = self._corners[index], self._cuts[index], float(t[index])
        behind = (index - 1) % count
        before, after = (float(t[each + 1] - t[each]) * cut / self._length(each) for each in (behind, index))
        self._meet(_Node(corner.along(-cut), at - before))
        end, handle = _Node(corner.along(cut), at + after), corner.handle(cut)
        way = corner.towards
        if corner.is_wide:
            place, half_way = corner.middle(cut)
            self._add_piece(_Node(place, at), way * handle, half_way * handle)
            way = half_way
        self._add_piece(end, way * handle, corner.onwards * handle)

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
        self._add(np.array([[3 * leaving, bend[0], jerk], [3 * arriving, bend[1], jerk]]), is_line=False)
        self.nodes.append(end)

    def _add_side(self, index: int) -> None:
        """Add the segment behind a point as it was, or what arcs leave of it."""
        following = (index + 1) % len(self._view.source.points)
        ends = [self._cuts.get(each, 0.0) for each in (index, following)]
        if not any(ends):
            self._add(self._as_it_was(index), is_line=False)
            return
        length = self._length(index)
        if sum(ends) >= length * (1 - _FLAT):
            return
        start = self.nodes[-1].place
        end = self._view.points[following]
        if following in self._corners:
            end = self._corners[following].along(-ends[1])
        line = np.zeros((2, 3, 2))
        line[:, 0] = end - start
        self._add(line, is_line=True)

    def _add(self, ends: Ends, *, is_line: bool) -> None:
        self._segments.append((ends[:, : self._view.source.family.derivatives], is_line))

    def _length(self, segment: int) -> float:
        count = len(self._view.source.points)
        return math.dist(self._view.points[segment], self._view.points[(segment + 1) % count])

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
