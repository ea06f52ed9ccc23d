"""Lengths of vectors."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.scaling import LARGEST


def vector_lengths(vectors: FloatArray) -> FloatArray:
    """Return Euclidean lengths along the last axis without needless over- or underflow."""
    largest = np.abs(vectors).max(axis=-1)
    divisor = np.where(largest > 0.0, largest, 1.0)
    with np.errstate(over="ignore", under="ignore"):
        result = largest * np.sqrt(np.square(vectors / divisor[..., None]).sum(axis=-1))
    limited: FloatArray = np.minimum(result, LARGEST)
    return limited
