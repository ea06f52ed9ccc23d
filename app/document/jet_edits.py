"""Edits of many data of a curve at once: positions and derivatives, each at its point and side."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
from msgspec.structs import replace

from .derivatives import DERIVATIVES
from .limits import checked_vector
from .model import Curve, Point, Vector
from .ties import with_derivative


class JetValue(msgspec.Struct, frozen=True):
    """A position (order 0) or a derivative of some order that a point is to have.

    `ahead` chooses the side at a corner; elsewhere both sides are one.
    """

    index: int
    order: int
    ahead: bool
    value: Vector


def with_jet_values(curve: Curve, values: Iterable[JetValue]) -> Curve:
    """Return `curve` with these values set; derivatives among them are explicit from then on.

    Of a tied point the velocity on the other side turns along.
    """
    points = list(curve.points)
    for each in values:
        points[each.index] = _with_value(curve, points[each.index], each)
    return replace(curve, points=tuple(points))


def _with_value(curve: Curve, point: Point, given: JetValue) -> Point:
    if given.order == 0:
        x, y = checked_vector(given.value, f"the position of point {given.index}")
        return replace(point, x=x, y=y)
    each = DERIVATIVES[given.order - 1]
    vector = checked_vector(given.value, f"the {each.name} of point {given.index}")
    return with_derivative(curve, given.index, given.order, vector, ahead=given.ahead, point=point)
