"""Barycentric rational interpolation: quotients without poles, and without swings at uniform parameters."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import Scaled, ScaledRows, normalise, scale_by_power
from curvecore.arrays import FloatArray
from curvecore.families.curve import ParametricCurve
from curvecore.families.lagrange import LagrangeCurve
from curvecore.families.rational_form import RationalForm
from curvecore.families.records import Interpolant
from curvecore.families.setting import FamilySetting

_NO_EXPONENT = np.zeros(1, dtype=np.int64)


class FloaterHormannCurve(ParametricCurve):
    """A smooth blend of the polynomials through neighbouring points; it stays calm at even parameters.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.
    degree : int, optional
        d, from 0 to 10: the degree of the polynomials that are blended, each through d + 1 neighbouring
        points. Where there are fewer points, n <= d, it counts as n - 1.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    LagrangeCurve : The polynomial through the points.
    CubicSplineCurve : Cubic pieces through them.

    Notes
    -----
    c(t) is a quotient of polynomials whose denominator has no real zero, so that the curve is infinitely
    smooth [1]_; it reproduces polynomials of degree d. Of n <= d + 2 points it is the polynomial through
    them: blending two is Neville's formula. Under uniform parameters the Lebesgue constant grows like
    2**(d - 1) (2 + log n), where that of the polynomial grows like 2**n [2]_.

    With u = 2**-53, values and derivatives differ from the exact ones by at most c u sum |B_i^(order)(t)|
    |p_i|, with c at most about 10: of values for any distinct parameters, of derivatives up to the third
    where the longest distance between parameters is at most 1e15 times the shortest. Values of every single
    function are that accurate.

    The first evaluation takes O(n d**2) operations, the later ones O(n d) per t; memory beyond the result is
    bounded. Results beyond the floating point range become the largest finite number of their sign.

    References
    ----------
    .. [1] M. S. Floater and K. Hormann, "Barycentric rational interpolation with no poles and high rates of
       approximation", Numerische Mathematik 107 (2007) 315-331.
    .. [2] L. Bos, S. De Marchi, K. Hormann and G. Klein, "On the Lebesgue constant of barycentric rational
       interpolation at equidistant nodes", Numerische Mathematik 121 (2012) 461-471.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import FloaterHormannCurve, LagrangeCurve
    >>> t, x = np.linspace(-1, 1, 21), np.linspace(-1, 1, 201)
    >>> points = np.stack([t, 1 / (1 + 25 * t**2)], axis=1)
    >>> for family in (LagrangeCurve, FloaterHormannCurve):
    ...     print(round(float(np.abs(family(points, t)(x)[:, 1] - 1 / (1 + 25 * x**2)).max()), 3))
    58.585
    0.003
    """

    __slots__ = ("_form",)
    _caches = ("_form",)

    name = "floater_hormann"
    title = "barycentric rational"
    short_title = "rational"
    place = 60
    is_calm = True
    settings = (
        FamilySetting(
            "degree",
            "blended degree",
            3,
            "Degree of the polynomials through neighbouring points that are blended",
            limits=(0, 10),
        ),
    )

    _form: RationalForm | None

    @property
    def _rational_form(self) -> RationalForm:
        if self._form is None:
            self._form = RationalForm.of(self._parameters, int(self.chosen["degree"]))
        return self._form

    @property
    def degree(self) -> int | None:
        """The degree n - 1 of the polynomial that the curve is where n <= d + 2; None of more points."""
        degree = len(self._parameters) - 1
        return degree if degree <= int(self.chosen["degree"]) + 1 else None

    @property
    def kind(self) -> str:
        """The words for a quotient of polynomials; see `PolynomialFacts`."""
        return f"rational, blended degree {self.chosen['degree']}" if self.degree is None else ""

    def _vanishes(self, order: int) -> bool:
        """Whether the derivatives of an order are 0 everywhere."""
        return self.degree is not None and order > self.degree

    @property
    def _polynomial(self) -> LagrangeCurve | None:
        """The same curve as one polynomial, where it is one."""
        return None if self.degree is None else LagrangeCurve(self.points, self._parameters)

    def exact_pieces(self) -> FloatArray | None:
        """Return the control points of the one polynomial; None of a quotient."""
        return None if (polynomial := self._polynomial) is None else polynomial.exact_pieces()

    def interpolants(self) -> list[Interpolant] | None:
        """Return the one polynomial, all points; None of a quotient."""
        return None if (polynomial := self._polynomial) is None else polynomial.interpolants()

    def derivatives_at(self, t: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
        """Return derivatives of several orders at many places, all of them in one pass.

        Where the Lebesgue function stays below 1e3, and parameters are not too uneven, by sums in double
        precision: the errors are then up to 1e4 times larger than those of `evaluate`.
        """
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            found = self._rational_form.quick_derivatives(self.points, t, max(orders)) if len(t) else None
        if found is None or not all(np.isfinite(each).all() for each in found):
            return super().derivatives_at(t, orders)
        return [found[order] for order in orders]

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, n, dim), by differences; points about their mean lose no digits."""
        centred = self.with_jets(self.jets - self.points.mean(axis=0))
        return super(FloaterHormannCurve, centred).parameter_derivatives(t)

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        result = np.zeros((len(self._parameters), t.size))
        if self._vanishes(order):
            return result.T[:, :, None]
        with np.errstate(over="ignore", under="ignore"):
            for where, values, exponent in self._rational_form.parts(t, order):
                result[:, where] = values if exponent is None else scale_by_power(values, exponent)
        return result.T[:, :, None]

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        if self._vanishes(order):
            return np.zeros((t.size, self.points.shape[1]))
        # As in `LagrangeCurve.evaluate`: points near 1 keep a sum of large terms that cancel in range.
        _, exponent = np.frexp(np.abs(self.points).max(axis=0))
        result = np.empty((self.points.shape[1], t.size))
        with np.errstate(over="ignore", under="ignore"):
            points = np.ldexp(self.points, -exponent)
            for where, values, own in self._rational_form.parts(t, order):
                rows = normalise(Scaled(values, own)) if own is not None else ScaledRows(values, _NO_EXPONENT)
                result[:, where] = scale_by_power(points.T @ rows.values, exponent[:, None] + rows.exponent)
        curve = np.ascontiguousarray(result.T)
        if order == 0:
            self._put_points(curve, t)
        return curve
