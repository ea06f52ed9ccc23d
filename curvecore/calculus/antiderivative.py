"""The antiderivative of a curve."""

from __future__ import annotations

import numpy as np

from curvecore.arithmetic import made_finite
from curvecore.arrays import FloatArray, integer
from curvecore.calculus.integrals import Integral, integral_of
from curvecore.calculus.of_a_curve import OfCurve
from curvecore.families.curve import ParametricCurve


class Antiderivative(OfCurve):
    """The integral of a curve from the beginning of its domain, as a curve: 0 there, with derivative c(t).

    It is linear in the data of the curve, and does not pass through its points.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family.

    See Also
    --------
    ParametricCurve.antiderivative : The usual way to it.
    ParametricCurve.integrate : Between two parameters.

    Notes
    -----
    Polynomials up to degree 40 are integrated by a Gauss-Legendre rule that is exact for their degree, others
    and what is no polynomial to some 13 digits of the integral of the absolute values.

    Examples
    --------
    >>> from curvecore import Antiderivative, LagrangeCurve
    >>> area = Antiderivative(LagrangeCurve([[0], [1], [4]], [0, 1, 2]))
    >>> area([0, 3]).round(12).tolist()
    [[0.0], [9.0]]
    """

    __slots__ = ("_of_basis", "_of_curve")
    _caches = ("_of_basis", "_of_curve")

    title = "Antiderivative"

    _of_basis: Integral | None
    _of_curve: Integral | None

    @property
    def name(self) -> str:  # type: ignore[override]
        """That of the curve, behind an integral sign."""
        return "∫" + self._curve.name

    @property
    def degree(self) -> int | None:
        """One more than that of the curve; None where its pieces are no polynomials."""
        return None if self._curve.degree is None else self._curve.degree + 1

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        if order:
            return self._curve.evaluate(t, order - 1)
        if self._of_curve is None:
            self._of_curve = integral_of(self._curve.evaluate, self._curve, self._curve.degree)
        return made_finite(self._of_curve.at(self._curve.evaluate, t))

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        if order:
            return self._curve.basis(t, order - 1)
        if self._of_basis is None:
            self._of_basis = integral_of(self._functions, self._curve, self._curve.degree)
        return self._of_basis.at(self._functions, t).reshape(len(t), *self._jets.shape[:2])

    def _functions(self, t: FloatArray) -> FloatArray:
        """Return the basis functions of the curve as columns, (m, n R)."""
        return self._curve.basis(t).reshape(len(t), self._jets[:, :, 0].size)

    def _pieces_from(self, controls: FloatArray) -> FloatArray:
        """Return sums of the curve's control points, times the lengths."""
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            steps = controls * (np.diff(self.breaks)[:, None, None] / controls.shape[1])
            result = np.zeros((len(steps), steps.shape[1] + 1, steps.shape[2]))
            np.cumsum(steps, axis=1, out=result[:, 1:])
            result[1:] += np.cumsum(result[:-1, -1], axis=0)[:, None]
        return np.nan_to_num(result)

    def derivative(self, order: int = 1) -> ParametricCurve:
        """Return the curve, or its derivative of an order less by one."""
        rank = integer(order, "order", 0)
        return self._curve.derivative(rank - 1) if rank else self


def antiderivative_of(curve: ParametricCurve, order: int) -> ParametricCurve:
    """Return the antiderivative, taken so many times."""
    for _ in range(integer(order, "order", 0)):
        curve = Antiderivative(curve)
    return curve
