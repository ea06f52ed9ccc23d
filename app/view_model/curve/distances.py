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
    """Finds nearest points of one curve; divides it once."""

    def __init__(self, view: CurveView) -> None:
        self._curve = view.curve if view.is_current else None

    def within(self, place: Vector, reach: float) -> Nearest | None:
        """Return the nearest point if it is at most `reach` away: the nearest of all, wherever it lies."""
        is_found = self._curve is not None and np.isfinite(place).all()
        return self._search.to(place, reach) if is_found else None

    @cached_property
    def _search(self) -> NearestWithin:
        assert self._curve is not None
        # Looked up when it is needed: at the start nothing snaps.
        return curvecore.NearestWithin(self._curve)


_SAMPLES = 32
_MOST_SAMPLES = 20_000

_KEPT = 1e-8
"""Change, relative to the size of a curve, up to which its shape counts as kept: nobody sees it."""

_ROUNDING = 1e-12
"""Share of the domain up to which parameters are the same."""


def is_kept(residual: float, curves: Sequence[Curve]) -> bool:
    """Tell whether the shape of these curves is the same but for roundings, `residual` being what changed."""
    points = np.array([point.position for curve in curves for point in curve.points])
    return residual <= _KEPT * size_of(points)


def outcome(residual: float, curves: Sequence[Curve]) -> str:
    """Return in words whether the shape of these curves was kept, and how much changed."""
    kept = "shape kept" if is_kept(residual, curves) else "the shape is another"
    return f"{kept}, largest change {number(residual, 2)}."


def dense(knots: FloatArray) -> FloatArray:
    """Return parameters all along a curve with these knots, the knots included; as many on every segment."""
    per_segment = int(np.clip(_MOST_SAMPLES // len(knots), 5, _SAMPLES))
    return all_along(knots, per_segment)


def largest_distance(first: CurveView, at: FloatArray, second: CurveView, at_second: FloatArray) -> float:
    """Return the largest distance between `first` at the parameters `at` and `second` at `at_second`."""
    assert first.curve is not None
    assert second.curve is not None
    away = first.curve.evaluate(at) - second.curve.evaluate(at_second)
    return float(np.hypot(away[:, 0], away[:, 1]).max())


def coincide(first: CurveView, second: CurveView) -> bool:
    """Whether two curves are at the same places for the same t, but for roundings."""
    if first is second:
        return True
    if not (first.is_current and second.is_current):
        return False
    t = first.parameters
    if t.shape != second.parameters.shape or np.abs(t - second.parameters).max() > _ROUNDING * np.ptp(t):
        return False
    away = first.samples - second.samples
    return is_kept(float(np.hypot(away[:, 0], away[:, 1]).max()), (first.source,))
