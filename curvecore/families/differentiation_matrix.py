"""Derivatives of an interpolating polynomial at many t, by those at its parameters.

The derivatives of a polynomial are polynomials of no higher degree. Known at
the parameters t_i, from the differentiation matrix, they are interpolated like
points: a tenth of the time of differentiating the basis at every t.

References
----------
.. [1] J.-P. Berrut and L. N. Trefethen, "Barycentric Lagrange
   interpolation", SIAM Review 46 (2004) 501-517; section 9.3.
.. [2] R. Baltensperger and M. R. Trummer, "Spectral differencing with a
   twist", SIAM J. Sci. Comput. 24 (2003) 1465-1487: the matrix
   whose rows sum to 0.
"""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray

_MOST = 64  # parameters
_WORST = 1e5  # Lebesgue function above which the short cut loses more digits than a picture has
_LIMIT = 1e100


def matrix_serves(parameters: FloatArray, points: FloatArray, t: FloatArray, orders: tuple[int, ...]) -> bool:
    """Whether the short cut is one, and spacing and sizes leave it its digits."""
    if 2 * len(parameters) >= t.size or len(parameters) > _MOST or max(orders) > 3:
        return False
    first, last = float(parameters[0]), float(parameters[-1])
    is_sized = first <= float(t.min()) and float(t.max()) <= last and float(np.abs(points).max()) < _LIMIT
    return is_sized and last - first > 1.0 / _LIMIT and np.diff(parameters).min() > 1e-9 * (last - first)


def derivatives_by_matrix(
    parameters: FloatArray, points: FloatArray, basis: FloatArray, orders: tuple[int, ...]
) -> list[FloatArray] | None:
    """Return derivatives where the basis functions are `basis`, (m, n); None where they grow too large."""
    if np.abs(basis).sum(axis=1).max() > _WORST:
        return None
    with np.errstate(under="ignore"):
        return [basis @ data for data in _at_parameters(parameters, points, orders)]


def _at_parameters(parameters: FloatArray, points: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
    """Return the derivatives at the parameters themselves, shape (n, dim) each."""
    first, last = float(parameters[0]), float(parameters[-1])
    half = 0.25 * (last - first)
    x = (parameters - first) / half
    difference = x[:, None] - x
    np.fill_diagonal(difference, 1.0)
    weight = 1.0 / np.prod(difference, axis=1)
    matrix = weight / weight[:, None] / difference
    np.fill_diagonal(matrix, 0.0)
    row_sum = matrix.sum(axis=1)
    results = [points]
    for _ in range(max(orders)):
        previous = results[-1]
        # The row's own entry is minus the sum of the others: constants have derivative 0.
        results.append((matrix @ previous - row_sum[:, None] * previous) / half)
    return [results[order] for order in orders]
