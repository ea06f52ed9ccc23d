"""Polylines of curves one after the other, as in a drag: what was computed for the last one is used again."""

from __future__ import annotations

import msgspec
import numpy as np

from curvecore import Curve as CoreCurve
from curvecore import FrozenFlattening, FrozenSegments, Pieces, flatten_pieces
from curvecore.arrays import FloatArray

Box = tuple[float, float, float, float]
FlatteningKey = tuple[float, Box | None]
"""Tolerance, and the box in which it matters."""

_PAUSE = 30
"""Curves after one that not even samples of its own could follow, for which none are taken."""


class Polyline(msgspec.Struct, frozen=True, eq=False):
    """A curve as drawn: the parameters of its vertices (k,), the vertices (k, 2), and how far it is off.

    `deviation` is above the tolerance where the curve would need more vertices than a polyline may have.
    """

    parameters: FloatArray
    points: FloatArray
    deviation: float = 0.0


class Flattener:
    """Flattens one curve after the other; views of a curve that changes hand it on from one to the next.

    A curve that is drawn again at the same scale gets samples, or places on its segments, that follow it.
    """

    def __init__(self) -> None:
        self._last: FlatteningKey | None = None
        self._frozen: FrozenFlattening | FrozenSegments | None = None
        self._pause = 0

    def polyline(self, curve: CoreCurve | None, key: FlatteningKey) -> Polyline:
        """Return the polyline of `curve` for the tolerance and the box `key`."""
        if curve is None:
            return Polyline(np.empty(0), np.empty((0, 2)))
        if len(curve.pieces) > 1:
            return _flatten(curve, key)
        return self._following(curve, key)

    def _following(self, curve: CoreCurve, key: FlatteningKey) -> Polyline:
        if key != self._last:
            # The first at this scale: there may never be another one.
            self._last, self._frozen, self._pause = key, None, 0
            return _flatten(curve, key)
        pieces = None if self._frozen is None else self._frozen.follow(curve)
        if pieces is None and self._pause == 0:
            self._frozen = _frozen(curve, key)
            pieces = self._frozen.follow(curve)
            if pieces is None:
                # Too wild to be followed; it may calm down.
                self._frozen, self._pause = None, _PAUSE
        elif pieces is None:
            self._pause -= 1
        return _flatten(curve, key) if pieces is None else _polyline(pieces)


def _frozen(curve: CoreCurve, key: FlatteningKey) -> FrozenFlattening | FrozenSegments:
    return FrozenFlattening(curve, *key) if curve.bezier_pieces() is None else FrozenSegments(curve, *key)


def _flatten(curve: CoreCurve, key: FlatteningKey) -> Polyline:
    return _polyline(flatten_pieces(curve, *key))


def _polyline(pieces: Pieces) -> Polyline:
    return Polyline(pieces.parameters, pieces.points, pieces.reached)
