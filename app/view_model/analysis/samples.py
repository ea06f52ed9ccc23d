"""The curve and its derivatives at parameters that suit drawing."""

from __future__ import annotations

import msgspec
import numpy as np

from app.view_model.curve_view import CurveView
from curvecore.arrays import FloatArray

MOST = 600
"""Samples of a whole curve; more are not told apart on a screen."""

LEAST_A_SEGMENT = 6

_FEW, _LONG = 3, 200
"""Samples a segment of a polynomial through more than `_LONG` points, whose derivatives cost most."""


class PieceSamples(msgspec.Struct, frozen=True, eq=False):
    """A piece of a curve without corners: parameters (m,), and c, c', c'' there, (m, 2) each."""

    parameters: FloatArray
    points: FloatArray
    velocities: FloatArray
    accelerations: FloatArray


def samples_of(view: CurveView) -> list[PieceSamples]:
    """Return samples of every piece, the joints among them, one-sided at both ends of each segment.

    A joint of a Hermite curve stands there twice: its second derivative is another one on either side.
    """
    if view.curve is None or not view.is_current:
        return []
    segments = len(view.parameters) - 1
    least = _FEW if not view.source.family.is_local and segments > _LONG else LEAST_A_SEGMENT
    return [
        PieceSamples(t, *piece.derivatives_at(t, (0, 1, 2)))
        for piece in view.pieces
        for t in [_parameters(piece.parameters, max(least, min(MOST // segments, 60)))]
    ]


def _parameters(knots: FloatArray, count: int) -> FloatArray:
    """Return `count` parameters in every segment, the last of one segment just before the knot."""
    shares = np.linspace(0.0, 1.0, count)
    t = knots[:-1, None] + np.diff(knots)[:, None] * shares
    t[:, -1] = np.nextafter(knots[1:], -np.inf)
    t[-1, -1] = knots[-1]
    return np.asarray(t.ravel())


def unit_tangents(velocities: FloatArray) -> FloatArray:
    """Return vectors (m, 2) of length 1 in the same directions, zero for zero."""
    largest = np.abs(velocities).max(axis=1, keepdims=True)
    # Divided first, so that squares of huge velocities stay finite.
    scaled = velocities / np.where(largest > 0, largest, 1.0)
    length = np.hypot(scaled[:, 0], scaled[:, 1])
    result: FloatArray = scaled / np.where(length > 0, length, 1.0)[:, None]
    return result
