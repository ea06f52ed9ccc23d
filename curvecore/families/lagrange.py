"""The interpolating polynomial and its Lagrange basis functions."""

from __future__ import annotations

from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, parameter_row
from curvecore.families.curve import ParametricCurve
from curvecore.families.differentiation_matrix import derivatives_by_matrix, matrix_serves
from curvecore.families.product_form import ProductForm
from curvecore.families.records import Interpolant
from curvecore.families.same_shape import check_one_polynomial, pieces_of
from curvecore.parametrization import chebyshev, spread

_SURELY = 1e-3
"""Share of the sum of sizes from which on the sum of some terms is no rounding of them."""


class LagrangeCurve(ParametricCurve):
    """One polynomial through all points.

    Of degree n - 1: c(t) = sum over i of L_i(t) p_i with L_i(t_j) = 1 for
    i = j, else 0.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i, finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    HermiteCurve : Cubic pieces, which follow many points calmly.
    chebyshev : Parameters at which many points do no harm.
    lebesgue_constant : How much harm they may do.

    Notes
    -----
    With u = 2**-53, values and derivatives differ from the exact ones by at
    most c u sum |L_i^(order)(t)| |p_i|, c at most about 25 for n <= 60 and of
    the size of 2 sqrt(n) above: values for any distinct parameters,
    derivatives where the longest distance between parameters is at most 1e50
    times the shortest. (Beyond, the terms of a derivative differ by more than
    the range of exponents that they share; from 1e60 on digits are lost, from
    1e90 on all of them.) That
    says nothing about the sum itself: on many uniform parameters it is huge,
    and no method can do better with points given to 53 bits.

    The first evaluation takes O(n**2) operations more than the later ones,
    which take O(n) per t; memory beyond the result is bounded. Results beyond the floating point range
    become the largest finite number of their sign.

    Examples
    --------
    >>> from curvecore import LagrangeCurve
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> curve
    LagrangeCurve(n=3, dim=2, domain=(0, 2))
    >>> curve(0.5).round(9).tolist()
    [0.25, 1.5]
    >>> curve.basis(0.5)[:, 0].round(9).tolist()
    [0.375, 0.75, -0.125]
    >>> curve.degree
    2
    """

    __slots__ = ("_form",)
    _caches = ("_form",)

    name = "lagrange"
    title = "Lagrange"
    place = 10
    is_one_polynomial = True
    most_points = None

    _form: ProductForm | None

    @property
    def _product_form(self) -> ProductForm:
        # Made when first needed: what draws a curve under a hand often knows a shorter way.
        if self._form is None:
            self._form = ProductForm.of(self._parameters)
        return self._form

    def weight_ratios(self, index: int) -> FloatArray:
        """Return w_i / w_index for all i, with w_i = 1 / prod_(j != i) (t_i - t_j).

        Parameters
        ----------
        index : int
            From 0 to n - 1.

        Returns
        -------
        ndarray, shape (n,)
            Infinite or 0 beyond the range of floating point.
        """
        weights = self._product_form.weights
        mantissa = weights.mantissa / weights.mantissa[index]
        exponent = np.clip(weights.exponent - weights.exponent[index], -5000, 5000)
        with np.errstate(over="ignore", under="ignore"):
            return np.asarray(np.ldexp(mantissa, exponent.astype(np.intc)))

    @property
    def degree(self) -> int:
        """The degree n - 1."""
        return len(self._parameters) - 1

    @property
    def is_positive(self) -> bool:
        """Whether no L_i is negative in the domain: only those of a straight line are not."""
        return len(self._parameters) == 2

    def exact_pieces(self) -> FloatArray | None:
        """Return the control points of the one polynomial; None of more than 64 points."""
        from curvecore.bezier.conversion import bezier_stretch  # noqa: PLC0415 - it imports this module

        return bezier_stretch(self, *self.domain)[None] if self.has_exact_pieces else None

    @property
    def has_exact_pieces(self) -> bool:
        """Whether there are 64 points at most: the work grows with the fourth power."""
        from curvecore.bezier.conversion import MOST  # noqa: PLC0415 - it imports this module

        return len(self._parameters) <= MOST

    def surely_exceeds(self, degree: int) -> bool:
        """Return whether the leading coefficient is far more than rounding, and of a higher degree."""
        first, last = self.domain
        if degree >= self.degree or not self.has_exact_pieces:
            return False
        # On an interval of length 4 products of that many differences keep far from the ends of the range.
        with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
            t = 4.0 * ((self._parameters - first) / (last - first))
            steps = t[:, None] - t
            np.fill_diagonal(steps, 1.0)
            terms = self.points / np.prod(steps, axis=1)[:, None]
            return bool((np.abs(terms.sum(axis=0)) > _SURELY * np.abs(terms).sum(axis=0)).any())

    @classmethod
    def check_shape(cls, curve: ParametricCurve) -> None:
        """Raise where a curve is not one polynomial."""
        check_one_polynomial(curve, cls.title)

    @classmethod
    def same_shape_as(cls, curve: ParametricCurve) -> Self:
        """Return one polynomial through Chebyshev points of another way to write it."""
        cls.check_shape(curve)
        chain = pieces_of(curve, None, cls.title)
        t = spread(chebyshev(chain.controls.shape[1]), *curve.domain)
        return cls(curve.evaluate(t), t)

    def interpolants(self) -> list[Interpolant]:
        """Return the one polynomial: all points."""
        return [Interpolant(self._parameters, self._jets)]

    def derivatives_at(self, t: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
        """Return derivatives of several orders at many places.

        Of many t by a short cut: derivatives at the t_i, and interpolation of these. The errors are then up
        to max sum |L_i(t)| <= 1e5 times larger than those of `evaluate`.
        """
        if matrix_serves(self._parameters, self.points, t, orders):
            basis = self._basis(t, 0)[:, :, 0]
            found = derivatives_by_matrix(self._parameters, self.points, basis, orders)
            if found is not None:
                return found
        return super().derivatives_at(t, orders)

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i = -L_i(t) c'(t_i), shape (m, n, dim)."""
        (velocity,) = self.derivatives_at(self._parameters, (1,))
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            moves: FloatArray = -self._basis(parameter_row(t), 0)[:, :, 0, None] * velocity
        return moves

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        return self._product_form.sums(t, order, self.points)

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return all basis functions, or their derivatives; each function lies contiguous in memory."""
        return self._product_form.functions(t, order).T[:, :, None]

    def with_jets(self, jets: ArrayLike) -> Self:
        """Return the curve with other points; it shares everything that depends on the parameters."""
        curve = super().with_jets(jets)
        curve._form = self._product_form
        return curve
