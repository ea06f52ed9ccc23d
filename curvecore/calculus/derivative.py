"""The derivative of a curve."""

from __future__ import annotations

from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, integer
from curvecore.bezier import bernstein_algebra
from curvecore.calculus.of_a_curve import OfCurve
from curvecore.families.chain import Chain
from curvecore.families.curve import ParametricCurve
from curvecore.families.records import LocalBasis


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
        """That of the curve, with a prime for each derivative."""
        return self._curve.name + "'" * self._order

    @property
    def degree(self) -> int | None:
        """That of the curve less the order, at least 0; None where its pieces are no polynomials."""
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
        """Return derivatives of several orders at many places, as the curve gives them."""
        return self._curve.derivatives_at(t, tuple(order + self._order for order in orders))

    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis:
        """Return the derivatives of the functions that live on each t's segment, where `is_local`."""
        return self._curve.local_basis(t, order + self._order)

    def _pieces_from(self, controls: FloatArray) -> FloatArray:
        """Return differences of the curve's control points, over the lengths."""
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            for _ in range(self._order):
                controls = bernstein_algebra.derivative(controls) / np.diff(self.breaks)[:, None, None]
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
