"""The point of a curve nearest to a place."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import msgspec
import numpy as np

import curvecore
from app.document.model import Vector
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from curvecore import NearestWithin


class NearestCurvePoint(msgspec.Struct, frozen=True):
    """A point of a curve, its parameter and its distance."""

    t: float
    position: Vector
    distance: float


class NearestPoint:
    """Finds nearest points of one curve; divides it once."""

    def __init__(self, view: CurveView) -> None:
        self._curve = view.curve if view.is_current else None

    def within(self, place: Vector, reach: float) -> NearestCurvePoint | None:
        """Return the nearest point if it is at most `reach` away: the nearest of all, wherever it lies."""
        if self._curve is None or not np.isfinite(place).all():
            return None
        found = self._search.to(place, reach)
        if found is None:
            return None
        x, y = found.point.tolist()
        return NearestCurvePoint(found.parameter, (x, y), found.distance)

    @cached_property
    def _search(self) -> NearestWithin:
        assert self._curve is not None
        # Looked up when it is needed: at the start nothing snaps.
        return curvecore.NearestWithin(self._curve)
