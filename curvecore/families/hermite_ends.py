"""What the jets at its two ends say of a Hermite segment."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.families.curve import Slopes

_UNIT = 2.0**-53


def next_derivative(jets: FloatArray, parameters: FloatArray, end: int) -> FloatArray:
    """Return the first derivative that is not given, at the beginnings (0) or ends (1) of segments."""
    h = np.diff(parameters)[:, None]
    near, far = (jets[1:], jets[:-1]) if end else (jets[:-1], jets[1:])
    # Seen from an end, the other one lies at the signed distance h.
    h = -h if end else h
    chord = (far[:, 0] - near[:, 0]) / h
    if jets.shape[1] == 2:
        return (6.0 * chord - 4.0 * near[:, 1] - 2.0 * far[:, 1]) / h
    slope = (60.0 * chord - 36.0 * near[:, 1] - 24.0 * far[:, 1]) / h
    return (slope - 9.0 * near[:, 2] + 3.0 * far[:, 2]) / h


def slopes_of(jets: FloatArray, h: FloatArray) -> Slopes | None:
    """Return control points of derivatives by the local s, of jets (n, R, dim); None out of range."""
    step, before, after = np.diff(jets[:, 0], axis=0), h * jets[:-1, 1], h * jets[1:, 1]
    if jets.shape[1] == 2:
        rows = [before, 3.0 * step - before - after, after]
    else:
        # Half of the second derivatives twice: squares of h may be out of range where the products are not.
        bends = [0.25 * h * (h * each) for each in (jets[:-1, 2], jets[1:, 2])]
        inner = 5.0 * step - 2.0 * (before + after) + (bends[1] - bends[0])
        rows = [before, before + bends[0], inner, after - bends[1], after]
    slopes = np.stack(rows, axis=1)
    size = sum((np.abs(each) for each in (5.0 * step, 2.0 * before, 2.0 * after)), np.zeros_like(step))
    if jets.shape[1] > 2:
        size += np.abs(bends[0]) + np.abs(bends[1])
    error = 8.0 * _UNIT * np.linalg.norm(size, axis=1)
    return Slopes(slopes, error) if np.isfinite(slopes).all() else None
