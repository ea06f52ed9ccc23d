"""Edits of many data of a curve at once: positions and derivatives, each at its point and side."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
from msgspec.structs import replace

from .limits import checked_vector
from .model import Curve, Vector

_NAMES = ("position", "velocity", "acceleration")


class JetValue(msgspec.Struct, frozen=True):
    """A position (order 0), velocity (1) or acceleration (2) that a point is to have.

    `ahead` chooses the side at a corner; elsewhere both sides are one.
    """

    index: int
    order: int
    ahead: bool
    value: Vector


def with_jet_values(curve: Curve, values: Iterable[JetValue]) -> Curve:
    """Return `curve` with these values set; derivatives among them are explicit from then on."""
    points = list(curve.points)
    for each in values:
        name, point = _NAMES[each.order], points[each.index]
        x, y = vector = checked_vector(each.value, f"the {name} of point {each.index}")
        side = "_after" if point.corner and each.ahead else ""
        changed = {"x": x, "y": y} if each.order == 0 else {f"{name}{side}": vector}
        points[each.index] = replace(point, **changed)
    return replace(curve, points=tuple(points))
