"""Curves as SciPy's piecewise polynomials, and the way back: the one module that imports SciPy.

It does so in its functions: the core itself needs NumPy alone.
"""

from __future__ import annotations

from math import factorial
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from curvecore.arrays import FloatArray, number_array, parameter_array, read_only
from curvecore.bezier.bernstein import weights
from curvecore.errors import CurveError
from curvecore.families.chain import joined_pieces
from curvecore.families.curve import ParametricCurve
from curvecore.families.setting import SettingValue
from curvecore.parametrization import chebyshev

if TYPE_CHECKING:
    from scipy.interpolate import BPoly, PPoly

MOST_POWERS = 63
"""Degree up to which powers of t are of any use: the numbers in front of them grow with its factorial."""

_AS_GOOD_AS_EQUAL = 2.0**-36
"""Of the largest coefficient: what a polynomial and a curve may differ and count as the same."""


def to_bpoly(curve: ParametricCurve) -> BPoly:
    """Return a curve as a ``BPoly``; see `ParametricCurve.to_bpoly`."""
    interpolate = _scipy_interpolate()
    return interpolate.BPoly(polynomial_pieces(curve).swapaxes(0, 1), curve.breaks)


def to_ppoly(curve: ParametricCurve) -> PPoly:
    """Return a curve as a ``PPoly``; see `ParametricCurve.to_ppoly`."""
    interpolate = _scipy_interpolate()
    if curve.degree is None or curve.degree > MOST_POWERS:
        raise CurveError(
            f"curve must have pieces that are polynomials of degree {MOST_POWERS} at most; "
            "cubic_path approximates others"
        )
    # From the derivatives, which do not depend on how far away the origin is, as Bezier control points do.
    powers = [curve.evaluate(curve.breaks[:-1], k) / factorial(k) for k in range(curve.degree + 1)]
    return interpolate.PPoly(np.stack(powers[::-1]), curve.breaks)


def curve_of_bpoly(
    family: type[ParametricCurve], polynomial: BPoly | PPoly, **settings: SettingValue
) -> ParametricCurve:
    """Return the curve of a family that a ``BPoly`` or ``PPoly`` is; see `ParametricCurve.from_bpoly`."""
    interpolate = _scipy_interpolate()
    if not isinstance(polynomial, (interpolate.BPoly, interpolate.PPoly)):
        raise CurveError(f"polynomial must be a BPoly or PPoly of SciPy's, not {type(polynomial).__name__}")
    is_power = isinstance(polynomial, interpolate.PPoly)
    bernstein = interpolate.BPoly.from_power_basis(polynomial) if is_power else polynomial
    coefficients = number_array(bernstein.c, "the coefficients of polynomial")
    if coefficients.ndim > 3:
        raise CurveError(
            f"values of polynomial must have the shape () or (dim,), not {coefficients.shape[2:]}"
        )
    controls = coefficients.reshape(*coefficients.shape[:2], -1).swapaxes(0, 1)
    breaks = parameter_array(polynomial.x, len(controls) + 1)
    given = PolynomialPieces(controls.copy(), breaks)
    if family.interpolates:
        curve = _through(family, polynomial, given, settings)
    else:
        curve = family.same_shape_as(given)
    _check_equal(curve, given)
    return curve


def _scipy_interpolate() -> ModuleType:
    try:
        import scipy.interpolate  # noqa: PLC0415 - no dependency of the core
    except ImportError:
        raise ImportError(
            "to_bpoly, to_ppoly and from_bpoly need SciPy, which is not installed: pip install scipy"
        ) from None
    module: ModuleType = scipy.interpolate
    return module


def _through(
    family: type[ParametricCurve],
    polynomial: BPoly | PPoly,
    given: PolynomialPieces,
    settings: dict[str, SettingValue],
) -> ParametricCurve:
    """Return the curve of a family with the values that it needs of a piecewise polynomial."""
    at = given.breaks
    if family.is_one_polynomial:
        at = at[0] + chebyshev(max(given.degree + 1, 2)) * (at[-1] - at[0])
        at[-1] = given.breaks[-1]
    jets = [polynomial(at, order, extrapolate=True) for order in range(family.derivatives + 1)]
    return family.from_jets(np.stack(jets, axis=1).reshape(len(at), len(jets), -1), at, **settings)


def _check_equal(curve: ParametricCurve, given: PolynomialPieces) -> None:
    """Compare at more parameters of each piece than a polynomial of the larger degree can have roots."""
    count = max(given.degree, curve.degree or 0) + 2
    s = np.sin((np.arange(count) + 0.5) * (np.pi / (2 * count))) ** 2
    t = (given.breaks[:-1, None] + s * np.diff(given.breaks)[:, None]).ravel()
    off = np.abs(curve.evaluate(t) - given.evaluate(t)).max(axis=1)
    worst = int(off.argmax())
    if off[worst] > _AS_GOOD_AS_EQUAL * np.abs(given.points).max():
        raise CurveError(
            f"polynomial must be a curve of {curve.name}, which through its values differs from it "
            f"by {off[worst]:.3g} at t = {t[worst]:.6g}"
        )


# Curves as piecewise polynomials, and piecewise polynomials as curves

_MOST_SAMPLED = 24
"""Degree from which on Bernstein coefficients of sampled values have lost half their digits."""


def polynomial_pieces(curve: ParametricCurve) -> FloatArray:
    """Return the Bernstein coefficients of a curve between its breaks, (k, degree + 1, dim).

    Raises
    ------
    CurveError
        If there are no such polynomials, or their degree is too high.
    """
    if len(curve.pieces) > 1:
        return joined_pieces([polynomial_pieces(piece) for piece in curve.pieces])
    controls = curve.exact_pieces()
    if controls is not None:
        return controls
    if curve.degree is None or curve.degree > _MOST_SAMPLED:
        raise CurveError(
            "curve must have pieces that are polynomials of a moderate degree; cubic_path approximates others"
        )
    return curve._sampled_pieces(curve.degree)


class PolynomialPieces(ParametricCurve):
    """A curve of Bezier pieces of any degree that may jump where they meet: all control points are its data.

    Parameters
    ----------
    controls : ndarray, shape (k, degree + 1, dim)
    breaks : ndarray, shape (k + 1,)
        Strictly increasing.
    """

    __slots__ = ("_controls",)

    name = "polynomial_pieces"
    title = "piecewise polynomial"
    interpolates = False

    def __init__(self, controls: FloatArray, breaks: FloatArray) -> None:
        self._controls = read_only(controls)
        self._jets = read_only(controls.reshape(-1, 1, controls.shape[2]))
        self._parameters = read_only(breaks)
        self._chosen = ()

    @property
    def breaks(self) -> FloatArray:
        """The breaks as given."""
        return self._parameters

    @property
    def degree(self) -> int:
        """The degree of all pieces."""
        return int(self._controls.shape[1]) - 1

    def bezier_pieces(self) -> FloatArray:
        """Return the control points."""
        return self._controls

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        if order:
            raise CurveError("derivatives of these functions are not needed")
        piece = np.clip(np.searchsorted(self._parameters, t, side="right") - 1, 0, len(self._controls) - 1)
        s = (t - self._parameters[piece]) / np.diff(self._parameters)[piece]
        result = np.zeros((len(t), *self._controls.shape[:2]))
        result[np.arange(len(t)), piece] = weights(s, self.degree)
        return result.reshape(len(t), -1, 1)
