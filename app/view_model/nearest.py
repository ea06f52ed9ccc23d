"""The point of a curve nearest to a place."""

from __future__ import annotations

import msgspec
import numpy as np

from app.document.model import Vector
from app.view_model.curve_view import CurveView, Floats
from curvecore import flatten_parameters

_NEWTON_STEPS = 4


class Nearest(msgspec.Struct, frozen=True):
    """A point of a curve, its parameter and its distance."""

    t: float
    position: Vector
    distance: float


class NearestPoint:
    """Finds nearest points of one curve; samples it once."""

    def __init__(self, view: CurveView) -> None:
        self._curve = view.curve
        self._t, self._points = np.empty(0), np.empty((0, 2))
        self._low = self._high = np.zeros(2)
        if self._curve is not None and view.is_current:
            size = max(float(np.ptp(view.points, axis=0).max()), 1e-300)
            self._t = flatten_parameters(self._curve, 1e-3 * size, None)
            self._points = self._curve.evaluate(self._t)
            low, high = self._points.min(axis=0), self._points.max(axis=0)
            # The curve may bulge out of its polyline by a thousandth of its size.
            margin = 2e-3 * float((high - low).max())
            self._low, self._high = low - margin, high + margin

    def within(self, place: Vector, reach: float) -> Nearest | None:
        """Return the nearest point if it is at most `reach` away.

        The polyline, a thousandth of the size off at most, tells the segment; Newton's method on
        (c(t) − p)·c'(t) = 0 gives the point there.
        """
        if self._curve is None or len(self._t) < 2 or not self._is_near(place, reach):
            return None
        index, share = _nearest_segment(self._points, np.array(place))
        low, high = float(self._t[index]), float(self._t[index + 1])
        t = low + share * (high - low)
        for _ in range(_NEWTON_STEPS):
            t = min(max(self._newton(t, place), low), high)
        x, y = self._curve.evaluate(t)
        distance = float(np.hypot(x - place[0], y - place[1]))
        return Nearest(t, (float(x), float(y)), distance) if distance <= reach else None

    def _newton(self, t: float, place: Vector) -> float:
        assert self._curve is not None
        away = self._curve.evaluate(t) - place
        first, second = self._curve.evaluate(t, 1), self._curve.evaluate(t, 2)
        slope = float(first @ first + away @ second)
        return t - float(away @ first) / slope if slope > 0 else t

    def _is_near(self, place: Vector, reach: float) -> bool:
        return bool(np.all(self._low - reach <= place) and np.all(self._high + reach >= place))


def _nearest_segment(points: Floats, place: Floats) -> tuple[int, float]:
    points = np.clip(points, -1e12, 1e12)
    start, along = points[:-1], np.diff(points, axis=0)
    away = place - start
    squared = (along**2).sum(axis=1)
    shares = np.clip((away * along).sum(axis=1) / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    gaps = away - shares[:, None] * along
    best = int(np.argmin((gaps**2).sum(axis=1)))
    return best, float(shares[best])
