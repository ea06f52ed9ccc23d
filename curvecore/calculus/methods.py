"""The methods of curves by which they are differentiated, integrated and solved, and brought to SciPy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Self, cast

from curvecore import calculus
from curvecore.arrays import FloatArray

if TYPE_CHECKING:
    from scipy.interpolate import BPoly, PPoly

    from curvecore.families.curve import Extrapolate, ParametricCurve
    from curvecore.families.setting import SettingValue


class Calculus:
    """The part of `ParametricCurve` that any function has: derivatives, integrals, solutions, SciPy."""

    __slots__ = ()

    def derivative(self, order: int = 1) -> ParametricCurve:
        """Return the derivative with respect to t, as a curve.

        Parameters
        ----------
        order : int, optional
            Order of the derivative; 0 is the curve itself.

        Returns
        -------
        ParametricCurve
            Linear in the data of this curve: a `Derivative`, or the curve of which this one is the
            antiderivative; of a `Chain`, a chain.

        Raises
        ------
        CurveError
            If order is no integer, or negative.

        See Also
        --------
        evaluate : Values of derivatives, by its argument order.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> velocity = LagrangeCurve([[0, 0], [1, 2], [4, 1]], [0, 1, 2]).derivative()
        >>> velocity(1).round(9).tolist()
        [2.0, 0.5]
        >>> velocity.degree
        1
        """
        return calculus.derivative_of(_curve(self), order)

    def antiderivative(self, order: int = 1) -> ParametricCurve:
        """Return the integral from the beginning of the domain, as a curve.

        Parameters
        ----------
        order : int, optional
            How many times; 0 is the curve itself.

        Returns
        -------
        ParametricCurve
            Linear in the data of this curve, and 0 at the beginning of the domain.

        Raises
        ------
        CurveError
            If order is no integer, or negative.

        See Also
        --------
        integrate : Between two parameters.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> area = LagrangeCurve([[0], [1], [4]], [0, 1, 2]).antiderivative()
        >>> area([0, 3]).round(12).tolist()
        [[0.0], [9.0]]
        """
        return calculus.antiderivative_of(_curve(self), order)

    def integrate(self, a: float, b: float, extrapolate: Extrapolate = True) -> FloatArray:
        """Return the integral over t from a to b.

        Parameters
        ----------
        a, b : float
            Finite; a may exceed b.
        extrapolate : bool or "periodic", optional
            Where a or b lie outside the domain: True, the first or the last piece goes on; False, the
            integral is NaN; "periodic", the curve repeats itself.

        Returns
        -------
        ndarray, shape (dim,)
            Of polynomial pieces up to degree 40 but for rounding; of others to some 13 digits of the integral
            of the absolute values. NaN where the curve is not to be continued.

        Raises
        ------
        CurveError
            If a or b is not a finite number, or extrapolate is none of the three.

        See Also
        --------
        antiderivative : The integral from the beginning to any t.
        arc_length : The integral of the speed.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> LagrangeCurve([[0, 1], [1, 1], [4, 1]], [0, 1, 2]).integrate(0, 3).round(12).tolist()
        [9.0, 3.0]
        """
        return calculus.integral(_curve(self), a, b, extrapolate)

    def solve(self, value: float = 0.0, axis: int = 0, discontinuity: bool = True) -> FloatArray:
        """Return all t of the domain at which a coordinate has a value.

        Parameters
        ----------
        value : float, optional
            Finite.
        axis : int, optional
            Which coordinate, from 0 to dim - 1.
        discontinuity : bool, optional
            Whether a break at which the coordinate jumps across the value counts.

        Returns
        -------
        ndarray, shape (k,)
            Ascending. Where the coordinate stays at the value over a stretch, the two ends of it.

        Raises
        ------
        CurveError
            If value is not finite, or there is no such axis.

        See Also
        --------
        roots : Where a coordinate is 0.
        nearest : The nearest point of the curve.

        Notes
        -----
        Between neighbouring extrema, which the Bernstein coefficients of the derivative enclose, the
        coordinate is monotone and takes each value at most once [1]_; Newton's method, kept inside, finds the
        parameter to the last digits. The value counts as reached where the coordinate differs from it by what
        rounding may have left: at an extremum, too. What has no Bezier pieces is followed by polynomials of
        degree 8 within 2**-44 of the size of the curve; extrema flatter than that may be missed, and two
        solutions with them.

        References
        ----------
        .. [1] R. T. Farouki, "The Bernstein polynomial basis: a centennial retrospective", Computer Aided
           Geometric Design 29 (2012) 379-419, section 3.2.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
        >>> curve.solve(1.0).round(9).tolist()
        [1.0]
        >>> curve.solve(1.5, axis=1).round(9).tolist()
        [0.5, 1.5]
        """
        return calculus.solutions(_curve(self), value, axis, discontinuity)

    def roots(self, axis: int = 0, discontinuity: bool = True) -> FloatArray:
        """Return all t of the domain at which a coordinate is 0.

        Parameters
        ----------
        axis : int, optional
            Which coordinate, from 0 to dim - 1.
        discontinuity : bool, optional
            Whether a break at which the coordinate changes its sign by a jump counts.

        Returns
        -------
        ndarray, shape (k,)
            Ascending. Where the coordinate stays 0 over a stretch, the two ends of it.

        Raises
        ------
        CurveError
            If there is no such axis.

        See Also
        --------
        solve : Where a coordinate has any other value.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
        >>> curve.roots(axis=1).round(9).tolist()
        [0.0, 2.0]
        >>> curve.derivative().roots(axis=1).tolist()
        [1.0]
        """
        return calculus.solutions(_curve(self), 0.0, axis, discontinuity)

    def to_bpoly(self) -> BPoly:
        """Return the curve as a polynomial in Bernstein form of SciPy's.

        Returns
        -------
        scipy.interpolate.BPoly
            With the breaks of the curve and values of shape (dim,); it goes on outside the domain.

        Raises
        ------
        ImportError
            If SciPy is not installed.
        CurveError
            If the pieces are no polynomials, or one through more than 64 points.

        See Also
        --------
        from_bpoly : The way back.
        to_ppoly : By powers of t.
        cubic_path : Cubic pieces of any curve, within a tolerance.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
        >>> polynomial = curve.to_bpoly()
        >>> polynomial(0.5).round(9).tolist()
        [0.25, 1.5]
        """
        return calculus.to_bpoly(_curve(self))

    def to_ppoly(self) -> PPoly:
        """Return the curve as a piecewise polynomial of SciPy's, by powers of t less a piece's beginning.

        Returns
        -------
        scipy.interpolate.PPoly
            With the breaks of the curve and values of shape (dim,); it goes on outside the domain.

        Raises
        ------
        ImportError
            If SciPy is not installed.
        CurveError
            If the pieces are no polynomials, or of a degree above 63.

        See Also
        --------
        to_bpoly : In Bernstein form, which loses fewer digits of high degrees.

        Examples
        --------
        >>> from curvecore import LagrangeCurve
        >>> curve = LagrangeCurve([[0], [1], [4]], [0, 1, 2])
        >>> curve.to_ppoly().c[:, 0, 0].tolist()
        [1.0, 0.0, 0.0]
        """
        return calculus.to_ppoly(_curve(self))

    @classmethod
    def from_bpoly(cls, polynomial: BPoly | PPoly, **settings: SettingValue) -> Self:
        """Return the curve of this family that a piecewise polynomial of SciPy's is.

        Parameters
        ----------
        polynomial : scipy.interpolate.BPoly or PPoly
            With values of shape () or (dim,). A `CubicSpline` and its kin are PPolys.
        **settings : int, float or str
            Values of the family's `settings`, by their names; the defaults where none is given.

        Returns
        -------
        ParametricCurve
            Of the class, through the values at the breaks; where it is one polynomial through its points,
            through as many Chebyshev points as determine it; where it does not pass through its points, with
            control points.

        Raises
        ------
        CurveError
            If the polynomial is no curve of this family: of a higher degree, less smooth at its breaks, with
            other ends, or with values of another shape.

        See Also
        --------
        to_bpoly : The way back.

        Examples
        --------
        >>> from curvecore import HermiteCurve
        >>> from scipy.interpolate import CubicSpline
        >>> spline = CubicSpline([0, 1, 3], [0, 2, 1])
        >>> HermiteCurve.from_bpoly(spline).points.tolist()
        [[0.0], [2.0], [1.0]]
        """
        return cast(
            "Self", calculus.curve_of_bpoly(cast("type[ParametricCurve]", cls), polynomial, **settings)
        )


def _curve(part: Calculus) -> ParametricCurve:
    """Return the part as the curve that it is, for type checkers."""
    return cast("ParametricCurve", part)
