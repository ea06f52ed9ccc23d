"""Segments made straight: from one point to the next along a line, at constant speed."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from msgspec.structs import replace

from ..families import Family, titles_with_derivatives
from .constraints import ends_of, is_straight, untie
from .limits import EditError
from .model import Curve, Document, Point
from .point_edits import JetValue, with_jet_values


def straight_refusal(family: Family) -> str:
    """Return the message that curves of a family have no straight segments; empty if they can have some."""
    if family.derivatives:
        return ""
    reason = (
        "is one polynomial and has no segments"
        if family.curve_class.is_one_polynomial
        else "has no velocities at its points, which a straight segment needs"
    )
    return f"{family.subject} {reason}. Choose {titles_with_derivatives()}."


def straighten(
    document: Document, curve: int, segments: Collection[int], parameters: Sequence[float]
) -> Document:
    """Make segments exactly straight.

    Segment i leads from point i to the next one; in a closed curve the last leads back to point 0. The points
    at its ends become corners, unless they are ends of an open curve: the sides within the segment get its
    mean velocity and higher derivatives of 0, the other sides stay as they are. A tied point stays smooth,
    and its other handle is turned along the line; between two lines of different directions the tie ends.

    Parameters
    ----------
    document, curve
        The curve to change.
    segments
        Their indices.
    parameters
        The present ones; a closed curve has one more, where it returns to its start.

    Raises
    ------
    EditError
        If curves of the family have no segments, a segment does not exist, or a velocity is out of range.
    """
    old = document.curves[curve]
    if reason := straight_refusal(old.family):
        raise EditError(reason)
    if any(not 0 <= segment < len(parameters) - 1 for segment in segments):
        raise EditError("This segment no longer exists.")
    points = list(old.points)
    for index in corners_of(old, segments):
        points[index] = _as_corner(old, index, segments)
    values = [value for segment in segments for value in _along_chord(old, segment, parameters)]
    return document.with_curve(curve, with_jet_values(replace(old, points=tuple(points)), values))


def corners_of(curve: Curve, segments: Collection[int]) -> list[int]:
    """Return the ends of segments at which the curve can have a corner, in order."""
    ends = {index for segment in segments for index in ends_of(curve, segment)}
    return sorted(index for index in ends if curve.is_closed or 0 < index < len(curve.points) - 1)


def _as_corner(curve: Curve, index: int, segments: Collection[int]) -> Point:
    # The handle on the other side keeps its length.
    point, behind = replace(curve.points[index], even=False), (index - 1) % len(curve.points)
    if all(segment in segments or is_straight(curve, segment) for segment in (behind, index)):
        point = untie(point)
    return point.as_corner()


def _along_chord(curve: Curve, segment: int, parameters: Sequence[float]) -> list[JetValue]:
    """Return the derivatives within a segment that runs along its chord."""
    start, end = ends_of(curve, segment)
    h = parameters[segment + 1] - parameters[segment]
    p, q = curve.points[start], curve.points[end]
    mean = ((q.x - p.x) / h, (q.y - p.y) / h)
    derivatives = [mean if order == 1 else (0.0, 0.0) for order in range(1, curve.family.derivatives + 1)]
    return [
        JetValue(index, order, ahead, value)
        for index, ahead in ((start, True), (end, False))
        for order, value in enumerate(derivatives, start=1)
    ]
