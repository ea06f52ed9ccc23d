"""Derivatives of Hermite segments from the jets at both ends."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.bezier.bernstein import controls_between
from curvecore.bezier.bernstein_algebra import derivative
from curvecore.families.curve import Slopes
from curvecore.scaling import UNIT_ROUNDOFF


def next_derivative_terms(jets: FloatArray, parameters: FloatArray, end: int) -> FloatArray:
    """Return the terms of the first derivative that is not given, at one end of every segment.

    Parameters
    ----------
    jets : ndarray, shape (n, R, dim)
        R = 2 or 3.
    parameters : ndarray, shape (n,)
        Strictly increasing.
    end : int
        0 for the beginnings, 1 for the ends.

    Returns
    -------
    ndarray, shape (k, n - 1, dim)
        Their sum is the derivative, and its rounding is relative to their sizes.
    """
    h = np.diff(parameters)[:, None]
    near, far = (jets[1:], jets[:-1]) if end else (jets[:-1], jets[1:])
    # Seen from an end, the other one lies at the signed distance h.
    h = -h if end else h
    chord = (far[:, 0] - near[:, 0]) / h
    if jets.shape[1] == 2:
        return np.stack((6.0 * chord, -4.0 * near[:, 1], -2.0 * far[:, 1])) / h
    slopes = np.stack((60.0 * chord, -36.0 * near[:, 1], -24.0 * far[:, 1])) / h
    return np.stack((*slopes, -9.0 * near[:, 2], 3.0 * far[:, 2])) / h


def slopes_of(jets: FloatArray, parameters: FloatArray) -> Slopes | None:
    """Return control points of derivatives by the local s, of jets (n, R, dim); None out of range."""
    starts, ends = jets[:-1].copy(), jets[1:].copy()
    # Seen from the beginning of each segment, so that the origin counts for nothing.
    ends[:, 0] -= starts[:, 0]
    starts[:, 0] = 0.0
    controls = controls_between(starts, ends, np.diff(parameters)[:, None])
    slopes = derivative(controls)
    size = slopes.shape[1] * np.abs(controls).sum(axis=1)
    error = 8.0 * UNIT_ROUNDOFF * np.linalg.norm(size, axis=1)
    return Slopes(slopes, error) if np.isfinite(slopes).all() else None
