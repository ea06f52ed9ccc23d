"""The public side of evaluation: checks of t, shapes of results, parameters outside the domain."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Literal, NamedTuple, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import BoolArray, FloatArray, integer, parameter_values
from curvecore.errors import CurveError

Extrapolate: TypeAlias = bool | Literal["periodic"]
_DOUBLE = np.dtype(np.float64)


class Evaluation(ABC):
    """Curve and basis functions for any t, from what a class computes for rows of checked t."""

    __slots__ = ()

    @abstractmethod
    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return B_ir^(order) at finite t (m,), inside the domain or not, as (m, n, R); order >= 0.

        At a break the piece to the right counts.
        """

    @abstractmethod
    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        """Return the order-th derivative of the curve at finite t (m,), as (m, dim)."""

    def _evaluate_at_once(self, t: FloatArray, order: object) -> FloatArray | None:
        """Return the same of arguments that are not checked, where that is all that takes time; else None.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Any doubles.
        order : object
            An int, or something else.
        """
        return None

    @property
    @abstractmethod
    def domain(self) -> tuple[float, float]:
        """The first and the last parameter."""

    @property
    def difference_digits(self) -> tuple[int, ...]:
        """Digits that the first, second and third derivatives keep where they are differences of values.

        Of functions as smooth as their parameters are spaced. Empty where derivatives are no differences.
        """
        return ()

    @final
    def basis(self, t: ArrayLike, order: int = 0) -> FloatArray:
        """Return all basis functions, or their derivatives with respect to t.

        Parameters
        ----------
        t : float or array_like of any shape
            Finite, inside the domain or not. At a break the piece to the right counts.
        order : int, optional
            Order of the derivative, at least 0.

        Returns
        -------
        ndarray, shape (*shape of t, n, R)
            ``[..., i, r]`` is B_ir; of a single t of the shape (n, R).

        Raises
        ------
        CurveError
            If t is not finite, or order is negative.

        See Also
        --------
        evaluate : The sum of the functions times the data.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
        >>> curve.basis(0.5)[:, 0].round(9).tolist()
        [0.375, 0.75, -0.125]
        """
        at = parameter_values(t)
        return at.shaped(self._basis(at.values, integer(order, "order", 0)))

    @final
    def evaluate(self, t: ArrayLike, order: int = 0, extrapolate: Extrapolate = True) -> FloatArray:
        """Return the curve, or a derivative with respect to t.

        Parameters
        ----------
        t : float or array_like of any shape
            Finite, inside the domain or not.
        order : int, optional
            Order of the derivative, at least 0.
        extrapolate : bool or "periodic", optional
            Outside the domain: True, the first or the last piece goes on; False, NaN; "periodic", the curve
            repeats itself, so that the end of the domain counts as its beginning.

        Returns
        -------
        ndarray, shape (*shape of t, dim)
            At a parameter t_i and order 0 exactly p_i, if the family interpolates.

        Raises
        ------
        CurveError
            If t is not finite, order is negative, or extrapolate something else.

        See Also
        --------
        derivative : The derivative as a curve.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
        >>> curve.evaluate([0.5, 1]).round(9).tolist()
        [[0.25, 1.5], [1.0, 2.0]]
        >>> curve.evaluate(0.5, order=1).round(9).tolist()
        [1.0, 2.0]
        >>> curve.evaluate([-1, 3], extrapolate="periodic").round(9).tolist()
        [[1.0, 2.0], [1.0, 2.0]]
        """
        if extrapolate is True:
            if type(t) is np.ndarray and t.dtype is _DOUBLE and t.ndim == 1:
                if (found := self._evaluate_at_once(t, order)) is not None:
                    return found
            elif type(t) is float and (found := self._evaluate_at_once(np.array([t]), order)) is not None:
                return found[0]
        at = parameter_values(t)
        rank = integer(order, "order", 0)
        if extrapolate is True:
            return at.shaped(self._evaluate(at.values, rank))
        within = _within_domain(at.values, self.domain, extrapolate)
        curve = self._evaluate(within.t, rank)
        curve[within.outside] = np.nan
        return at.shaped(curve)

    @final
    def __call__(self, t: ArrayLike, order: int = 0, extrapolate: Extrapolate = True) -> FloatArray:
        """Return the curve, or a derivative with respect to t: `evaluate`."""
        return self.evaluate(t, order, extrapolate)


class _WithinDomain(NamedTuple):
    """Parameters at which a curve is to be evaluated in place of those asked for.

    Attributes
    ----------
    t : ndarray, shape (m,)
        Inside the domain where `extrapolate` is not True.
    outside : ndarray of bool, shape (m,)
        Where the curve has no value.
    """

    t: FloatArray
    outside: BoolArray


def _within_domain(t: FloatArray, domain: tuple[float, float], extrapolate: Extrapolate) -> _WithinDomain:
    """Return parameters inside [a, b] that stand for t, (m,).

    "periodic" takes a + (t - a) mod (b - a), as SciPy does: the period is half open.
    """
    first, last = domain
    nowhere = np.zeros(t.shape, dtype=np.bool_)
    way = checked_extrapolate(extrapolate)
    if way == "periodic":
        # The sum may exceed b by rounding.
        return _WithinDomain(np.minimum(first + np.remainder(t - first, last - first), last), nowhere)
    if way:
        return _WithinDomain(t, nowhere)
    return _WithinDomain(np.clip(t, first, last), (t < first) | (t > last))


def checked_extrapolate(extrapolate: object) -> Extrapolate:
    """Return it, as one of the three."""
    if isinstance(extrapolate, (bool, np.bool_)):
        return bool(extrapolate)
    if isinstance(extrapolate, str) and extrapolate == "periodic":
        return "periodic"
    raise CurveError(f"extrapolate must be True, False or 'periodic', not {extrapolate!r}")
