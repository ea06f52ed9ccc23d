"""Polylines of curves one after the other, as in a drag: what was computed for the last one is used again."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from curvecore import FrozenFlattening, FrozenSegments, ParametricCurve, Pieces, flatten_pieces

Box = tuple[float, float, float, float]
FlatteningKey = tuple[float, Box | None]
"""Tolerance, and the box in which it matters."""

_PAUSE = 30
"""Curves after one that not even samples of its own could follow, for which none are taken."""


Polyline: TypeAlias = Pieces
"""A curve as drawn: the parameters of its vertices (k,), the vertices (k, 2), and how far it is off."""

_NOTHING = Polyline(np.empty(0), np.empty((0, 2)), np.empty(0))


class Flattener:
    """Flattens one curve after the other; views of a curve that changes hand it on from one to the next.

    A curve that is drawn again at the same scale gets samples, or places on its segments, that follow it.
    What is drawn of it, and the whole of it for its extent, are asked for in turn: each has its own.
    """

    __slots__ = ("_drawn", "_whole")

    def __init__(self) -> None:
        self._drawn, self._whole = _Follower(), _Follower()

    def polyline(self, curve: ParametricCurve | None, key: FlatteningKey) -> Polyline:
        """Return the polyline of `curve` for the tolerance and the box `key`."""
        follower = self._whole if key[1] is None else self._drawn
        return follower.polyline(curve, key)


class _Follower:
    """Samples, or places on segments, that follow a curve as long as it is asked for with the same key."""

    __slots__ = ("_frozen", "_last", "_pause")

    def __init__(self) -> None:
        self._last: FlatteningKey | None = None
        self._frozen: FrozenFlattening | FrozenSegments | None = None
        self._pause = 0

    def polyline(self, curve: ParametricCurve | None, key: FlatteningKey) -> Polyline:
        """Return the polyline of `curve` for the tolerance and the box `key`."""
        if curve is None:
            return _NOTHING
        if len(curve.pieces) > 1:
            return flatten_pieces(curve, *key)
        if key != self._last:
            # The first at this scale: there may never be another one.
            self._last, self._frozen, self._pause = key, None, 0
            return flatten_pieces(curve, *key)
        pieces = None if self._frozen is None else self._frozen.follow(curve)
        if pieces is None and self._pause == 0:
            self._frozen = _frozen(curve, key)
            pieces = self._frozen.follow(curve)
            if pieces is None:
                # Too wild to be followed; it may calm down.
                self._frozen, self._pause = None, _PAUSE
        elif pieces is None:
            self._pause -= 1
        return flatten_pieces(curve, *key) if pieces is None else pieces


def _frozen(curve: ParametricCurve, key: FlatteningKey) -> FrozenFlattening | FrozenSegments:
    return FrozenFlattening(curve, *key) if curve.bezier_pieces() is None else FrozenSegments(curve, *key)
