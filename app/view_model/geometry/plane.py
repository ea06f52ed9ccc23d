"""Points and vectors of the plane, (k, 2): sizes, directions, boxes, and the point that closes a polygon."""

from __future__ import annotations

import numpy as np

from curvecore.arithmetic import vector_lengths
from curvecore.arrays import FloatArray


def size_of(points: FloatArray) -> float:
    """Return the larger side of the box around points, at least one."""
    return float(np.ptp(points, axis=0).max())


def polygon_length(points: FloatArray) -> float:
    """Return the length of the polygon through points (n, 2)."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def at_knots(points: FloatArray, *, closed: bool) -> FloatArray:
    """Return what points (n, …) have at the knots of their curve: where it is closed, the first once more."""
    return np.vstack([points, points[:1]]) if closed else points


def unit_tangents(velocities: FloatArray) -> FloatArray:
    """Return vectors (m, 2) of length 1 in the same directions, zero for zero."""
    lengths = vector_lengths(velocities)
    result: FloatArray = velocities / np.where(lengths > 0, lengths, 1.0)[:, None]
    return result


def to_the_left(vectors: FloatArray) -> FloatArray:
    """Return vectors (m, 2) turned to the left by a right angle."""
    return np.column_stack([-vectors[:, 1], vectors[:, 0]])


def usual_length(vectors: FloatArray, longest: float) -> float:
    """Return the length that nine tenths of the vectors keep, or the longest if that is not far above.

    One endless vector, at a cusp for instance, shall not make all others invisible.
    """
    with np.errstate(over="ignore"):
        lengths = np.hypot(vectors[:, 0], vectors[:, 1])
    lengths = lengths[np.isfinite(lengths)]
    if not len(lengths):
        return 0.0
    usual = float(np.quantile(lengths, 0.9, method="lower"))
    return min(float(lengths.max()), longest * usual) if usual > 0 else float(lengths.max())
