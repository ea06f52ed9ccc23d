"""Boxes around whole shapes, without their strokes and clips: what gradients are laid across."""

from __future__ import annotations

from collections.abc import Sequence

from ...document.gradient import Box
from ...document.model import Curve
from ...document.point_group import PointGroup
from ...document.shapes import shape_around
from ..curve.curve_view import CurveView, view_of
from .bounds import bounds_of


def box_of_shape(views: Sequence[CurveView], shape: range) -> Box:
    """Return the box around the curves at some places; around nothing it lies at the origin."""
    points = tuple((place, frozenset(range(len(views[place].points)))) for place in shape)
    bounds = bounds_of(views, PointGroup(points, is_whole=True), clipped=False)
    return ((0.0, 0.0), (0.0, 0.0)) if bounds is None else (bounds.low, bounds.high)


def box_of_first_shape(curves: Sequence[Curve]) -> Box:
    """Return the box around the first shape of some curves."""
    shape = shape_around(curves, 0)
    return box_of_shape([view_of(curve) for curve in curves[: shape.stop]], shape)
