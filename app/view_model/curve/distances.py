"""The point of a curve nearest to a position, and the distance of two curves on dense samples."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

import curvecore
from curvecore.arrays import FloatArray

from ...document.model import Curve, Vector
from ...document.words import number
from ..geometry import all_along, size_of
from .curve_view import CurveView

if TYPE_CHECKING:
    from curvecore import NearestWithin
    from curvecore.analysis.nearest_point import Nearest


class NearestPoint:
    """Search for nearest points of one curve, which is divided once."""

    def __init__(self, view: CurveView) -> None:
        self._curve = view.curve if view.is_current else None

    def within(self, position: Vector, reach: float) -> Nearest | None:
        """Return the nearest point of the whole curve if it is at most `reach` away."""
        is_searched = self._curve is not None and np.isfinite(position).all()
        return self._search.to(position, reach) if is_searched else None

    @cached_property
    def _search(self) -> NearestWithin:
        assert self._curve is not None
        # Imported when it is needed: at the start nothing snaps.
        return curvecore.NearestWithin(self._curve)


_SAMPLES = 32
_MOST_SAMPLES = 20_000

_NEGLIGIBLE = 1e-8
"""Change, relative to the size of a curve, up to which its shape counts as kept: it is not visible."""

_ROUNDING = 1e-12
"""Share of the domain up to which parameters are the same."""


def keeps_shape(residual: float, curves: Sequence[Curve]) -> bool:
    """Return whether the shape of these curves is the same but for roundings, given the largest change."""
    points = np.array([point.position for curve in curves for point in curve.points])
    return residual <= _NEGLIGIBLE * size_of(points)


def outcome(residual: float, curves: Sequence[Curve]) -> str:
    """Return words about the shape of these curves: kept or not, and the largest change."""
    words = "shape kept, largest change" if keeps_shape(residual, curves) else "shape changed by up to"
    return f"{words} {number(residual, 2)}."


def dense(knots: FloatArray) -> FloatArray:
    """Return parameters all along a curve with these knots, the knots included, as many on every segment."""
    per_segment = int(np.clip(_MOST_SAMPLES // len(knots), 5, _SAMPLES))
    return all_along(knots, per_segment)


def largest_distance(first: CurveView, at: FloatArray, second: CurveView, at_second: FloatArray) -> float:
    """Return the largest distance between `first` at the parameters `at` and `second` at `at_second`."""
    away = first.present_curve.evaluate(at) - second.present_curve.evaluate(at_second)
    return float(np.hypot(away[:, 0], away[:, 1]).max())


def coincide(first: CurveView, second: CurveView) -> bool:
    """Return whether two curves have the same positions at the same t, but for roundings."""
    if first is second:
        return True
    if not (first.is_current and second.is_current):
        return False
    t = first.parameters
    if t.shape != second.parameters.shape or np.abs(t - second.parameters).max() > _ROUNDING * np.ptp(t):
        return False
    away = first.samples - second.samples
    return keeps_shape(float(np.hypot(away[:, 0], away[:, 1]).max()), (first.source,))
