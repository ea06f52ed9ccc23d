"""Corners made circular arcs that go on from both sides, straight or curved."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.curve_edits import replace_curve
from ...document.edits import EditError
from ...document.model import Curve, Document
from ...document.point_group import PointGroup, some_points
from ...document.straight_edits import why_not_straight
from ...tasks.progress import Report, part, silent, told
from ..curve.curve_view import CurveView
from ..fitting.reshape import refuse_without_curve
from .corner_arc import FLAT, Arc, Corner, StraightCorner
from .curve_with_arcs import CurveWithArcs
from .smoothness import inner_points
from .touching_arc import CurvedCorner, Side

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
        How many corners were left, for no arc touches both of their sides.
    """

    curve: Curve
    new: frozenset[int]
    radii: tuple[float, ...]
    left: int


def rounded(view: CurveView, indices: Collection[int], radius: float, report: Report = silent) -> Rounded:
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
    pieces = _pieces(view)
    straight = _are_straight(pieces)
    corners = _corners(view, indices, pieces, straight)
    arcs = _arcs(corners, len(view.source.points), radius, report)
    left = len(corners) - len(arcs)
    if not arcs:
        return Rounded(view.source, frozenset(), (), left)
    made = CurveWithArcs(view, arcs, pieces, straight)
    curve = made.curve()
    new = frozenset(place for place, node in enumerate(made.nodes) if node.old is None)
    return Rounded(curve, new, tuple(arc.radius for arc in arcs.values()), left)


class RoundedGroup(msgspec.Struct, frozen=True):
    """A document in which corners of several curves are arcs.

    Attributes
    ----------
    document
        The document.
    made
        The curves that have arcs now, by their places.
    left
        How many corners were left, for no arc touches both of their sides.
    """

    document: Document
    made: dict[int, Rounded]
    left: int


def with_rounded(
    document: Document,
    views: Sequence[CurveView],
    group: PointGroup,
    radius: float,
    report: Report = silent,
) -> RoundedGroup:
    """Return the document with the corners among points of several curves made arcs; `views` are of all.

    Every number is checked.

    Raises
    ------
    EditError
        If none of the curves can have corners, one is locked that has, or a number is out of range.
    """
    made, reasons, curves = dict[int, Rounded](), list[str](), list(document.curves)
    seen = left = 0
    for done, (place, indices) in enumerate(group.parts):
        view, of_this = views[place], part(report, done / len(group.parts), (done + 1) / len(group.parts))
        if reason := why_not_straight(view.source.family) or view.problem:
            reasons.append(reason)
        elif view.has_curve:
            each = rounded(view, indices, radius, of_this)
            seen += 1
            left += each.left
            if each.radii:
                made[place] = each
                # One by one: to replace one of thousands takes long.
                curves[place] = replace_curve(Document((curves[place],)), 0, each.curve).curves[0]
    if reasons and not seen:
        raise EditError(reasons[0])
    some_points((place, each.new) for place, each in made.items()).refuse_locked(document)
    return RoundedGroup(replace(document, curves=tuple(curves)), made, left)


def _corners(
    view: CurveView, indices: Collection[int], pieces: FloatArray, straight: list[bool]
) -> dict[int, Corner]:
    """Return the corners among some points."""
    count, found = len(view.source.points), dict[int, Corner]()
    for index in inner_points(view.source, indices):
        behind = (index - 1) % count
        towards, onwards = -_direction(pieces[behind][::-1]), _direction(pieces[index])
        turn = math.atan2(abs(towards[0] * onwards[1] - towards[1] * onwards[0]), towards @ onwards)
        if not _TURNS < turn < math.pi - _TURNS:
            continue
        if straight[behind] and straight[index]:
            lengths = [
                math.dist(view.points[each], view.points[(each + 1) % count]) for each in (behind, index)
            ]
            found[index] = StraightCorner(view.points[index], towards, onwards, (lengths[0], lengths[1]))
        else:
            sides = [Side(pieces[at][[0, -1]] if straight[at] else pieces[at]) for at in (behind, index)]
            found[index] = CurvedCorner(sides[0], sides[1], towards, onwards)
    return found


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
        fits = (across <= FLAT) & (along >= -FLAT) & (along <= 1 + FLAT)
    result: list[bool] = fits.all(axis=1).tolist()
    return result


def _direction(controls: FloatArray) -> FloatArray:
    """Return the direction in which a piece leaves its first control point; zero where it has no length."""
    for way in controls[1:] - controls[0]:
        if length := math.hypot(*way):
            return np.asarray(way / length)
    return np.zeros(2)


def _arcs(corners: Mapping[int, Corner], count: int, radius: float, report: Report) -> dict[int, Arc]:
    """Return the arcs at corners of a curve of so many points; none where none touches both sides.

    Where both ends of a side are round, each has half of it, or what the other one leaves.
    """
    wanted = {index: corner.shares(radius) for index, corner in corners.items()}
    found = dict[int, Arc]()
    for index, corner in told(list(corners.items()), report, "Rounding corners"):
        behind, ahead = (wanted.get((index + step) % count) for step in (-1, 1))
        room = (
            1.0 if behind is None else max(0.5, 1.0 - behind[1]),
            1.0 if ahead is None else max(0.5, 1.0 - ahead[0]),
        )
        arc = corner.arc(radius, room)
        if arc is not None:
            found[index] = arc
    return found
