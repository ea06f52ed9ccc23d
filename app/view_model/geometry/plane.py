"""Points and vectors of the plane, (k, 2): sizes, directions, boxes, and the point that closes a polygon."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.vectors import vector_lengths


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
    lengths = np.hypot(vectors[:, 0], vectors[:, 1])
    lengths = lengths[np.isfinite(lengths)]
    if not len(lengths):
        return 0.0
    usual = float(np.quantile(lengths, 0.9, method="lower"))
    return min(float(lengths.max()), longest * usual) if usual > 0 else float(lengths.max())


def crosses_box(polyline: FloatArray, low: FloatArray, high: FloatArray) -> bool:
    """Whether a polyline (k, 2) has a point within a box.

    Each segment is cut by the box's slabs (Liang & Barsky, ACM Transactions on Graphics 3 (1984) 1–22).
    """
    start, way = polyline[:-1], np.diff(polyline, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = np.stack([(low - start) / way, (high - start) / way])
    is_level = way == 0.0
    is_within = (start >= low) & (start <= high)
    entry = np.where(is_level, np.where(is_within, -np.inf, np.inf), shares.min(axis=0))
    leave = np.where(is_level, np.where(is_within, np.inf, -np.inf), shares.max(axis=0))
    crossing = np.maximum(entry.max(axis=1), 0.0) <= np.minimum(leave.min(axis=1), 1.0)
    return bool(crossing.any())
