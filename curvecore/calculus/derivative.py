"""Derivative and antiderivative of a curve: curves that are linear in the data of the curve."""

from __future__ import annotations

from abc import abstractmethod
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import made_finite
from curvecore.arrays import FloatArray, integer
from curvecore.bezier import bernstein
from curvecore.calculus.integrals import Integral, integral_of
from curvecore.families.chain import Chain, exact_pieces
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import LocalBasis


class OfCurve(ParametricCurve):
    """Base of curves that follow from another one; they do not pass through its points.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family.
    """

    __slots__ = ("_curve",)

    interpolates = False
    most_points = None

    _curve: ParametricCurve

    def __init__(self, curve: ParametricCurve) -> None:
        self._curve = curve
        self._jets, self._parameters = curve.jets, curve.parameters
        self._chosen = tuple(curve.chosen.items())
        for name in self._caches:
            setattr(self, name, None)

    def __repr__(self) -> str:
        """Return a short description, with that of the curve."""
        return f"{type(self).__name__}({self._curve!r})"

    @property
    def breaks(self) -> FloatArray:
        """The breaks of the curve."""
        return self._curve.breaks

    @abstractmethod
    def _pieces_from(self, controls: FloatArray) -> FloatArray:
        """Return the Bezier control points of the pieces from those of the curve."""

    def bezier_pieces(self) -> FloatArray | None:
        """Return the Bezier control points of the pieces, where the curve has some."""
        controls = self._curve.bezier_pieces()
        return None if controls is None else self._pieces_from(controls)

    def exact_pieces(self) -> FloatArray | None:
        """Return the Bezier control points of pieces also of high degree, where the curve has some."""
        controls = exact_pieces(self._curve)
        return None if controls is None else self._pieces_from(controls)

    def _like(self, curve: ParametricCurve) -> Self:
        """Return the same of another curve: its derivative or antiderivative."""
        return type(self)(curve)

    def with_jets(self, jets: ArrayLike) -> Self:
        """Return the same of the curve with other data, (n, R, dim)."""
        return self._like(self._curve.with_jets(jets))

    def with_data(self, jets: ArrayLike, parameters: ArrayLike) -> Self:
        """Return the same of the curve with other data, (n, R, dim), and parameters, (n,)."""
        return self._like(self._curve.with_data(jets, parameters))


class Derivative(OfCurve):
    """The derivative of a curve with respect to t, as a curve: c'(t) = sum over i, r of B_ir'(t) d_ir.

    It is linear in the data of the curve and does not pass through its points. Values are those that
    `ParametricCurve.evaluate` gives of this order, and as accurate.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family.
    order : int, optional
        Order of the derivative, at least 1.

    Raises
    ------
    CurveError
        If order is less than 1.

    See Also
    --------
    ParametricCurve.derivative : The usual way to it.
    Antiderivative : The way back.

    Examples
    --------
    >>> from curvecore import Derivative, LagrangeCurve
    >>> velocity = Derivative(LagrangeCurve([[1, 0], [2, 2], [5, 1]], [0, 1, 2]))
    >>> velocity([0.5, 1]).round(9).tolist()
    [[1.0, 2.0], [2.0, 0.5]]
    """

    __slots__ = ("_order",)

    title = "Derivative"
    is_continuous = False

    _order: int

    def __init__(self, curve: ParametricCurve, order: int = 1) -> None:
        super().__init__(curve)
        self._order = integer(order, "order", 1)

    def __repr__(self) -> str:
        """Return a short description, with that of the curve."""
        return f"Derivative({self._curve!r}, order={self._order})"

    @property
    def name(self) -> str:  # type: ignore[override]
        """The name of the curve, with a prime for each derivative."""
        return self._curve.name + "'" * self._order

    @property
    def degree(self) -> int | None:
        """The degree of the curve less the order, at least 0; None where its pieces are no polynomials."""
        return None if self._curve.degree is None else max(self._curve.degree - self._order, 0)

    @property
    def is_local(self) -> bool:  # type: ignore[override]
        """Whether the curve is of a local family."""
        return self._curve.is_local

    @property
    def pieces(self) -> tuple[ParametricCurve, ...]:
        """The derivatives of the curve's pieces."""
        if len(self._curve.pieces) == 1:
            return (self,)
        return tuple(Derivative(piece, self._order) for piece in self._curve.pieces)

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        return self._curve.evaluate(t, order + self._order)

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        return self._curve.basis(t, order + self._order)

    def derivatives_at(self, t: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
        """Return derivatives of several orders at many parameters, as the curve gives them."""
        return self._curve.derivatives_at(t, tuple(order + self._order for order in orders))

    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis:
        """Return the derivatives of the functions that live on each t's segment, where `is_local`."""
        return self._curve.local_basis(t, order + self._order)

    def _pieces_from(self, controls: FloatArray) -> FloatArray:
        """Return differences of the curve's control points, over the lengths."""
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            for _ in range(self._order):
                controls = bernstein.derivative(controls) / np.diff(self.breaks)[:, None, None]
        return np.nan_to_num(controls)

    def derivative(self, order: int = 1) -> ParametricCurve:
        """Return the derivative of a higher order; see `ParametricCurve.derivative`."""
        return self._curve.derivative(self._order + integer(order, "order", 0))

    def _like(self, curve: ParametricCurve) -> Self:
        return type(self)(curve, self._order)


def derivative_of(curve: ParametricCurve, order: int) -> ParametricCurve:
    """Return the derivative of a curve; of a chain, the chain of its pieces' derivatives."""
    if integer(order, "order", 0) == 0:
        return curve
    if len(curve.pieces) > 1:
        return Chain([piece.derivative(order) for piece in curve.pieces])
    return Derivative(curve, order)


# The antiderivative


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
        """The name of the curve, behind an integral sign."""
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
