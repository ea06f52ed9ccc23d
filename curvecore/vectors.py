"""Lengths and cross products of vectors."""

from __future__ import annotations

from functools import reduce

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.scaling import LARGEST


def cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the cross products of plane vectors along the last axis."""
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def along_last(operation: np.ufunc, values: FloatArray) -> FloatArray:
    """Reduce the last axis entry by entry: where it is short, NumPy would begin a loop for every vector."""
    reduced: FloatArray = reduce(operation, np.moveaxis(values, -1, 0))
    return reduced


def vector_lengths(vectors: FloatArray) -> FloatArray:
    """Return Euclidean lengths along the last axis without needless over- or underflow."""
    largest = along_last(np.maximum, np.abs(vectors))
    divisor = np.where(largest > 0.0, largest, 1.0)
    with np.errstate(over="ignore", under="ignore"):
        shares = (each / divisor for each in np.moveaxis(vectors, -1, 0))
        result = largest * np.sqrt(sum(map(np.square, shares)))
    limited: FloatArray = np.minimum(result, LARGEST)
    return limited
