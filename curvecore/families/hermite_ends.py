"""Derivatives of Hermite segments from the jets at both ends."""

from __future__ import annotations

import numpy as np

from curvecore.arithmetic import UNIT_ROUNDOFF
from curvecore.arrays import FloatArray
from curvecore.bezier.bernstein import controls_between
from curvecore.bezier.bernstein_algebra import derivative
from curvecore.families.hermite_forms import end_weights
from curvecore.families.records import Slopes


def end_derivative_terms(jets: FloatArray, parameters: FloatArray, end: int, order: int) -> FloatArray:
    """Return the terms of a derivative that is not given, at one end of every segment.

    Parameters
    ----------
    jets : ndarray, shape (n, R, dim)
    parameters : ndarray, shape (n,)
        Strictly increasing.
    end : int
        0 for the beginnings, 1 for the ends.
    order : int
        Of the derivative, at least R.

    Returns
    -------
    ndarray, shape (k, n - 1, dim)
        Their sum is the derivative, and its rounding is relative to their sizes.
    """
    h = np.diff(parameters)[:, None]
    near, far = (jets[1:], jets[:-1]) if end else (jets[:-1], jets[1:])
    # Seen from an end, the other one lies at the signed distance h.
    h = -h if end else h
    near_weights, far_weights = end_weights(jets.shape[1], order)
    # The weights of the points differ by their sign: their difference is what counts.
    terms = [far_weights[0] * ((far[:, 0] - near[:, 0]) / h)]
    for k in range(1, jets.shape[1]):
        for data, weight in ((near[:, k], near_weights[k]), (far[:, k], far_weights[k])):
            terms = [*terms, weight * data]
        if k < order:
            terms = [term / h for term in terms]
    return np.stack(terms) / _power(h, order - jets.shape[1])


def _power(h: FloatArray, exponent: int) -> FloatArray:
    return h**exponent


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
