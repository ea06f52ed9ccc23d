"""Edits of many data of a curve at once: positions and derivatives, each at its point and side."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
from msgspec.structs import replace

from app.document.edits import checked
from app.document.model import Curve, Vector

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
        what = f"the {_NAMES[each.order]} of point {each.index}"
        x, y = checked(each.value[0], f"The x of {what}"), checked(each.value[1], f"The y of {what}")
        point = points[each.index]
        if each.order == 0:
            points[each.index] = replace(point, x=x, y=y)
        else:
            side = "_after" if point.corner and each.ahead else ""
            points[each.index] = replace(point, **{f"{_NAMES[each.order]}{side}": (x, y)})
    return replace(curve, points=tuple(points))
