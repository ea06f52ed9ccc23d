"""Chebyshev coefficients of polynomials over [0, 1], many at a time.

References
----------
.. [1] L. N. Trefethen, "Approximation Theory and Approximation Practice",
   SIAM 2013, chapters 3 and 4.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from curvecore.arrays import FloatArray, read_only
from curvecore.bezier.bernstein_algebra import weights


@cache
def to_chebyshev(degree: int) -> FloatArray:
    """Return the matrix from values at the degree + 1 points of `chebyshev` to coefficients; degree >= 1."""
    k = np.arange(degree + 1)
    matrix = (2.0 / degree) * np.cos(np.pi * np.outer(k, k) / degree) * (-1.0) ** k[:, None]
    matrix[:, [0, degree]] *= 0.5
    matrix[[0, degree]] *= 0.5
    return read_only(matrix)


@cache
def to_bernstein(degree: int) -> FloatArray:
    """Return the matrix from Chebyshev to Bernstein coefficients, shape (degree + 1, degree + 1)."""
    s = np.linspace(0.0, 1.0, degree + 1)
    chebyshev = np.cos(np.arange(degree + 1) * np.arccos(np.clip(2.0 * s - 1.0, -1.0, 1.0))[:, None])
    return read_only(np.asarray(np.linalg.solve(weights(s, degree), chebyshev), dtype=np.float64))
