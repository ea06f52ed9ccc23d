"""Base of derivative and antiderivative: curves that follow from another one, linear in its data."""

from __future__ import annotations

from abc import abstractmethod
from typing import Self

from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray
from curvecore.calculus.polynomials import exact_pieces
from curvecore.families.curve import ParametricCurve


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
        """Those of the curve."""
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
        """Return what this is of its curve, of another one."""
        return type(self)(curve)

    def with_jets(self, jets: ArrayLike) -> Self:
        """Return the same of the curve with other data, (n, R, dim)."""
        return self._like(self._curve.with_jets(jets))

    def with_data(self, jets: ArrayLike, parameters: ArrayLike) -> Self:
        """Return the same of the curve with other data, (n, R, dim), and parameters, (n,)."""
        return self._like(self._curve.with_data(jets, parameters))
