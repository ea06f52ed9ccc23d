"""A curve of which nothing is known but its basis functions."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, jet_array, number_array, read_only
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.lagrange import LagrangeCurve
from curvecore.families.setting import SettingValue

_STENCIL = np.arange(-3.0, 4.0)
_PROBES, _MOST_PROBES = 16, 320
_FINENESS = (400.0, 400.0, 120.0)
"""Stencil steps in the distance of neighbouring parameters, for derivatives of order 1, 2 and above.

At a break the stencil lies to one side: its polynomial is off by the 7th derivative times a power of the
step, and values by their rounding over one.
"""
_DIGITS = (9, 8, 6)
"""Digits of the first derivatives that are left of functions as smooth as their parameters are spaced."""

MEASURED = 1e-9
"""Difference up to which a function's value at a parameter counts as the 1 or 0 that it should be."""


class Scheme(NamedTuple):
    """Basis functions as somebody writes them down.

    Attributes
    ----------
    name : str
        Of the family, for messages.
    basis : callable
        ``basis(t, parameters)``, with t (m,) and parameters (n,) ascending, returns B of shape (m, n), or
        ``basis(t, parameters, order)`` where `has_orders`; the values of `ParametricCurve.settings` of the
        class follow as keyword arguments. Where B_i(t_j) is not 1 for i = j, else 0, the curve misses its
        points.
    breaks : callable, optional
        ``breaks(parameters)``: where derivatives may jump, ascending; without it nowhere. With settings as
        `basis`.
    has_orders : bool, optional
        Whether `basis` takes the order of a derivative. Without it derivatives are taken from the polynomial
        of degree 6 through values of the functions on a fine stencil, which keeps some 9 digits of the first,
        8 of the second and 6 of the third derivative of functions as smooth as their parameters are spaced.

    See Also
    --------
    BasisCurve : Its curve.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import BasisCurve, Scheme
    >>> def hats(t, parameters):
    ...     return np.stack([np.interp(t, parameters, each) for each in np.eye(len(parameters))], axis=1)
    >>> polygon = Scheme("polygon", hats, breaks=lambda parameters: parameters)
    >>> BasisCurve([[0, 0], [2, 4], [3, 0]], [0, 1, 2], polygon)(0.5).tolist()
    [1.0, 2.0]
    """

    name: str
    basis: Callable[..., ArrayLike]
    breaks: Callable[..., ArrayLike] | None = None
    has_orders: bool = False


class BasisCurve(ParametricCurve):
    """The curve sum p_i B_i(t) of any cardinal functions B_i, polynomials or not.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.
    scheme : Scheme, optional
        The functions; those of the class where it has some. Whether the curve passes its points is measured.
    **settings : int, float or str
        Values of the class's `settings`, by their names; the defaults where none is given.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above, there are more than 2000 points, or the
        functions are not of the shape (m, n), or not finite at the parameters or at one of 16 parameters in
        each segment (320 in all, of many points).

    See Also
    --------
    Scheme : Basis functions as somebody writes them down.
    ParametricCurve : The base of families that know more.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import BasisCurve, Scheme
    >>> hats = Scheme("hats", lambda t, x: np.stack([np.interp(t, x, e) for e in np.eye(len(x))], axis=1))
    >>> BasisCurve([[0, 0], [2, 4], [3, 0]], [0, 1, 2], hats).evaluate(0.5).tolist()
    [1.0, 2.0]
    """

    __slots__ = ("_breaks", "_passes_points", "_scheme")

    title = "Basis functions"

    scheme: ClassVar[Scheme | None] = None
    _breaks: FloatArray
    _passes_points: bool
    _scheme: Scheme

    def __init__(
        self,
        points: ArrayLike,
        parameters: ArrayLike,
        scheme: Scheme | None = None,
        **settings: SettingValue,
    ) -> None:
        scheme = self.scheme if scheme is None else scheme
        if scheme is None:
            raise CurveError("scheme must be given: this class has no basis functions of its own")
        super().__init__(points, parameters, **settings)
        # All functions are asked for at all parameters to be checked.
        self._check_count(len(self._jets), scheme.name)
        self._scheme = scheme
        self._breaks = self._checked_breaks()
        off = np.abs(self._functions(self._parameters, 0) - np.eye(len(self._parameters)))
        self._functions(self._probes(), 0)
        self._passes_points = self.interpolates and bool(off.max() <= MEASURED)

    def __repr__(self) -> str:
        """Return a short description, with the name of the scheme."""
        return f"{type(self).__name__}({self._shape_in_words()}, scheme={self._scheme.name!r})"

    @property
    def name(self) -> str:  # type: ignore[override]
        """The name of the scheme."""
        return self._scheme.name

    @property
    def functions_key(self) -> tuple[object, ...]:
        """The class, the settings and the scheme; see `ParametricCurve`."""
        return (*super().functions_key, self._scheme)

    @property
    def passes_points(self) -> bool:
        """Whether the family says so and it is true: no B_i(t_j) is off its 1 or 0 by more than 1e-9."""
        return self._passes_points

    @property
    def breaks(self) -> FloatArray:
        """The parameters at which derivatives may jump, ascending, the ends included; shape (k,)."""
        return self._breaks

    @property
    def difference_digits(self) -> tuple[int, ...]:
        """The digits that differences keep; empty where the scheme `has_orders`. See `FamilyDefaults`."""
        return () if self._scheme.has_orders else _DIGITS

    def with_data(self, jets: ArrayLike, parameters: ArrayLike) -> Self:
        """Return a curve of the same scheme with other data and other parameters; see `ParametricCurve`."""
        points = jet_array(jets, (*np.shape(jets)[:1], 1))[:, 0]
        return type(self)(points, parameters, self._scheme, **self.chosen)

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        if order == 0 or self._scheme.has_orders:
            return self._functions(t, order)
        return self._differences(t, order)

    def _functions(self, t: FloatArray, order: int) -> FloatArray:
        scheme = self._scheme
        arguments = (t, self._parameters, order) if scheme.has_orders else (t, self._parameters)
        functions = number_array(scheme.basis(*arguments, **self.chosen), f"the basis of {scheme.name}")
        shape = (len(t), len(self._parameters))
        if functions.shape != shape:
            raise CurveError(
                f"the basis of {scheme.name} must have the shape (m, n) = {shape}, not {functions.shape}"
            )
        wrong = np.argwhere(~np.isfinite(functions))
        if len(wrong):
            k, i = wrong[0].tolist()
            raise CurveError(
                f"the basis of {scheme.name} is {functions[k, i]} at t = {t[k]}, in function {i}"
            )
        return functions

    def _differences(self, t: FloatArray, order: int) -> FloatArray:
        """Differentiate the polynomials through the functions at seven parameters around each t."""
        parameters = self._parameters
        segment = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2)
        longest = np.diff(parameters)[segment] / _FINENESS[min(order, len(_FINENESS)) - 1]
        # Powers of two, so that samples are exact where parameters lie far from 0.
        step = np.ldexp(0.5, np.frexp(longest)[1])
        middle = self._inside_of_a_piece(t, 3.0 * step)
        samples = middle[:, None] + step[:, None] * _STENCIL
        functions = self._functions(samples.ravel(), 0).reshape(*samples.shape, len(parameters))
        stencil = LagrangeCurve(np.zeros((_STENCIL.size, 1)), _STENCIL)
        weights = stencil.basis((t - middle) / step, order)[:, :, 0]
        return np.asarray(np.einsum("mk,mkn->mn", weights, functions) / step[:, None] ** order)

    def _inside_of_a_piece(self, t: FloatArray, reach: FloatArray) -> FloatArray:
        """Return t, moved so far that all parameters within `reach` lie in the same piece."""
        piece = np.clip(np.searchsorted(self._breaks, t, side="right") - 1, 0, len(self._breaks) - 2)
        low, high = self._breaks[piece] + reach, self._breaks[piece + 1] - reach
        middle = 0.5 * (low + high)
        inside = np.clip(t, np.minimum(low, middle), np.maximum(high, middle))
        first, last = self.domain
        return np.where((t < first) | (t > last), t, inside)

    def _checked_breaks(self) -> FloatArray:
        ends = self._parameters[[0, -1]]
        if self._scheme.breaks is None:
            return read_only(ends)
        breaks = number_array(
            self._scheme.breaks(self._parameters.copy(), **self.chosen),
            f"the breaks of {self._scheme.name}",
        )
        if breaks.ndim != 1 or not (np.isfinite(breaks).all() and (np.diff(breaks) > 0.0).all()):
            raise CurveError(f"the breaks of {self._scheme.name} must be finite and strictly increasing")
        inner = breaks[(breaks > ends[0]) & (breaks < ends[1])]
        return read_only(np.concatenate((ends[:1], inner, ends[1:])))

    def _probes(self) -> FloatArray:
        """Return parameters of all segments, their middles and quarters among them where points are few."""
        t = self._parameters
        if _PROBES * (len(t) - 1) > _MOST_PROBES:
            return np.linspace(t[0], t[-1], _MOST_PROBES)
        return (t[:-1, None] + np.diff(t)[:, None] * (np.arange(1, _PROBES) / _PROBES)).ravel()
