"""Arc length of a curve of the document, to a relative accuracy.

The core's arc length takes an absolute tolerance. Here the tolerance is a share of the length itself, so that
a curve small against its distance from the origin, or one whose points all coincide, is measured as well as
any other.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from curvecore import ParametricCurve
from curvecore.analysis.lengths import ArcLength, Length, arc_lengths
from curvecore.arithmetic import LARGEST, scale_by_power
from curvecore.arrays import FloatArray
from curvecore.bezier.bernstein import weights
from curvecore.bezier.pieces import BezierPieces, alike

from .geometry import all_along, polygon_length

_PARTS = 4
_LEAST = 1e-300
"""A tolerance for curves at rest; the next power of ten down is subnormal under the core's own factors."""


def arc_lengths_of(core: ParametricCurve, accuracy: float) -> ArcLength:
    """Return the arc length of a curve as a function of t, and back.

    Parameters
    ----------
    core
        A curve in the plane.
    accuracy
        Target error, against the length. `ArcLength.total` has the error that was reached: rounding, at
        points far from the origin for example, may not allow as little.
    """
    return ArcLength(core, max(accuracy * _least_length(core), _LEAST))


def lengths_of(parts: Sequence[BezierPieces], accuracy: float) -> list[Length]:
    """Return the whole lengths of many curves, whose pieces are at hand, to the same accuracy."""
    if not parts:
        return []
    least = np.empty(len(parts))
    for same in alike(parts):
        least[same] = _least_lengths([parts[index] for index in same])
    return arc_lengths(parts, np.maximum(accuracy * least, _LEAST))


def _least_lengths(parts: Sequence[BezierPieces]) -> FloatArray:
    """Return the lengths of polylines through curves whose pieces have one degree."""
    controls = np.concatenate([part.controls for part in parts])
    counts = np.array([len(part.starts) for part in parts])
    with np.errstate(all="ignore"):
        points = weights(np.linspace(0.0, 1.0, _PARTS + 1), controls.shape[1] - 1) @ controls
        chords = np.hypot(*np.diff(points, axis=1).transpose(2, 0, 1)).sum(axis=1)
        sums = np.add.reduceat(chords, np.cumsum(counts) - counts)
    return scale_by_power(sums, np.array([part.exponent for part in parts]))


def _least_length(core: ParametricCurve) -> float:
    """Return the length of a polyline through the curve, which is never longer than the curve."""
    with np.errstate(all="ignore"):
        points = core.evaluate(all_along(core.parameters, _PARTS))
        length = polygon_length(points)
    return length if np.isfinite(length) else LARGEST
