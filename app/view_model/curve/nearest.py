"""The point of a curve nearest to a place."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

import curvecore

from ...document.model import Vector
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
