"""Lengths and cross products of vectors."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.scaling import LARGEST


def cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the cross products of plane vectors along the last axis."""
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def vector_lengths(vectors: FloatArray) -> FloatArray:
    """Return Euclidean lengths along the last axis without needless over- or underflow."""
    largest = np.abs(vectors).max(axis=-1)
    divisor = np.where(largest > 0.0, largest, 1.0)
    with np.errstate(over="ignore", under="ignore"):
        result = largest * np.sqrt(np.square(vectors / divisor[..., None]).sum(axis=-1))
    limited: FloatArray = np.minimum(result, LARGEST)
    return limited
