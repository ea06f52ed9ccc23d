"""Extents of cubic Bézier pieces, imported where drawings are read and written."""

from __future__ import annotations

import itertools

import numpy as np

from curvecore.arrays import FloatArray


def extent_of(control_points: FloatArray) -> FloatArray:
    """Return the lower left and the upper right corner, (2, 2), of cubic Bézier pieces (k, 4, 2).

    Exact up to rounding: the extremes lie at the ends of the pieces and where a coordinate's derivative,
    a quadratic, is zero.
    """
    pieces = control_points.transpose(0, 2, 1).reshape(-1, 4)
    extremes = _cubic_values(pieces, _turning_points(pieces))
    extremes = extremes.reshape(-1, 2, 2).transpose(0, 2, 1).reshape(-1, 2)
    points = np.vstack([control_points[:, 0], control_points[:, 3], extremes])
    return np.array([points.min(axis=0), points.max(axis=0)])


def turns_within(control_points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the extreme values of x, and of y, within pieces."""
    pieces = control_points.transpose(0, 2, 1).reshape(-1, 4)
    parameters = _turning_points(pieces)
    values = np.where(parameters > 0.0, _cubic_values(pieces, parameters), np.nan).reshape(-1, 2, 2)
    xs, ys = values[:, 0].ravel(), values[:, 1].ravel()
    return xs[~np.isnan(xs)], ys[~np.isnan(ys)]


def _turning_points(pieces: FloatArray) -> FloatArray:
    """Return the parameters in [0, 1] of extremes of the cubics (k, 4), (k, 2); zero stands for none.

    The roots of a s² − 2 b s + c are taken as c / q and q / a with q = b ± √(b² − a c), the sign chosen
    so that nothing cancels.
    """
    first, second, third = np.diff(pieces, axis=1).T
    a, b, c = first - 2 * second + third, first - second, first
    with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
        q = b + np.copysign(np.sqrt(b * b - a * c), b)
        roots = np.stack([c / q, q / a], axis=1)
    inside = (roots > 0) & (roots < 1)
    return np.where(inside, roots, 0.0)


def _cubic_values(pieces: FloatArray, s: FloatArray) -> FloatArray:
    """Return the values (k, m) of the cubics (k, 4) at s (k, m), by de Casteljau's scheme."""
    level = [pieces[:, [i]] for i in range(4)]
    while len(level) > 1:
        level = [(1 - s) * low + s * high for low, high in itertools.pairwise(level)]
    return level[0]
