"""Cost of the methods of `rounding`, counted and not measured.

References
----------
.. [1] G. H. Golub and C. F. Van Loan, "Matrix Computations", 4th ed., Johns
   Hopkins 2013, sections 3.2 and 4.6: elimination and Vandermonde systems.
"""

from __future__ import annotations

from typing import NamedTuple

from curvecore.arrays import integer
from curvecore.errors import CurveError


class OperationCounts(NamedTuple):
    """Numbers of rounded operations, each addition, multiplication and division counting one.

    Attributes
    ----------
    setup : int
        Once for given data.
    per_point : int
        For every t.

    See Also
    --------
    operation_counts : The function that returns it.

    Examples
    --------
    >>> from curvecore import OperationCounts
    >>> OperationCounts(setup=10, per_point=4).total(100)
    410
    """

    setup: int
    per_point: int

    def total(self, count: int) -> int:
        """Return the number for many parameters.

        Parameters
        ----------
        count : int
            How many t.

        Returns
        -------
        int
            With what is done once.
        """
        return self.setup + count * self.per_point


_OF_FUNCTIONS = {2: 6, 3: 18, 4: 34}
"""Operations for the functions of one end of a segment, by the number of data there."""


def operation_counts(method: str, n: int, dim: int = 2, derivatives: int = 0) -> OperationCounts:
    """Return the number of operations of `evaluate_rounded`.

    Parameters
    ----------
    method : Method or str
        As there.
    n : int
        Number of points, at least 2.
    dim : int, optional
        At least 1.
    derivatives : int, optional
        0 for one polynomial through all points, 1 for cubic, 2 for quintic and 3
        for septic Hermite curves, all n - 1 segments of which count as used.

    Returns
    -------
    OperationCounts
        Exact, away from the t_i. To leading order ``"monomial"`` takes
        2 n**3 / 3 + 2 dim n**2 at first, ``"newton"`` 3 dim n**2 / 2 and the
        others 2 n**2; each t costs 2 dim n, 3 dim n, 2 n**2 for
        ``"lagrange"`` and 2 (dim + 1) n for ``"barycentric"``.

    Raises
    ------
    CurveError
        If the method does not apply to data with so many derivatives.

    See Also
    --------
    OperationCounts : What it returns.
    evaluate_rounded : The computation.

    Examples
    --------
    >>> from curvecore import operation_counts
    >>> counts = operation_counts("barycentric", 10)
    >>> counts.setup, counts.per_point, counts.total(1000)
    (180, 69, 69180)
    """
    count, space = integer(n, "n", 2), integer(dim, "dim", 1)
    width = integer(derivatives, "derivatives", 0) + 1
    name = str(method)
    polynomial = _polynomial_counts(count, space)
    if width == 1 and name in polynomial:
        return polynomial[name]
    if width > 1 and name == "monomial":
        size = 2 * width
        entries = 2 * (size - 2) + sum(2 * (size - order) for order in range(1, width))
        return OperationCounts((count - 1) * (entries + _elimination(size, space)), 2 * space * (size - 1))
    if width in _OF_FUNCTIONS and name == "basis":
        return OperationCounts(0, 6 + 2 * _OF_FUNCTIONS[width] + space * (4 * width - 1))
    raise CurveError(f"method {name!r} does not apply to data with {width - 1} derivatives")


def _elimination(n: int, dim: int) -> int:
    below = n * (n - 1) // 2
    inner = (n - 1) * n * (2 * n - 1) // 6
    return below + 2 * inner + 2 * dim * below + dim * (2 * below + n)


def _polynomial_counts(n: int, dim: int) -> dict[str, OperationCounts]:
    """Return the numbers of each method for one polynomial."""
    # The product of n - 1 differences.
    product = 2 * (n - 1) - 1
    return {
        "monomial": OperationCounts(n * (n - 2) + _elimination(n, dim), 2 * dim * (n - 1)),
        "newton": OperationCounts(3 * dim * n * (n - 1) // 2, 3 * dim * (n - 1)),
        "lagrange": OperationCounts(n * product, n * (product + 1) + dim * (2 * n - 1)),
        "barycentric": OperationCounts(n * (product + 1), 2 * n + (n - 1) + 2 * dim * n),
    }
