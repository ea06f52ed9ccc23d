"""Curves as SciPy's piecewise polynomials, and the way back: the one module that imports SciPy.

It does so in its functions: the core itself needs NumPy alone.
"""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from curvecore.arrays import FloatArray, number_array, parameter_array
from curvecore.bezier import bernstein_algebra
from curvecore.calculus.polynomials import polynomial_pieces
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.parametrization import chebyshev

if TYPE_CHECKING:
    from scipy.interpolate import BPoly, PPoly

_AS_GOOD_AS_EQUAL = 2.0**-36
"""Of the largest coefficient: what a polynomial and a curve may differ and count as the same."""


def to_bpoly(curve: ParametricCurve) -> BPoly:
    """Return a curve as a ``BPoly``; see `ParametricCurve.to_bpoly`."""
    interpolate = _scipy_interpolate()
    return interpolate.BPoly(polynomial_pieces(curve).swapaxes(0, 1), curve.breaks)


def to_ppoly(curve: ParametricCurve) -> PPoly:
    """Return a curve as a ``PPoly``; see `ParametricCurve.to_ppoly`."""
    return _scipy_interpolate().PPoly.from_bernstein_basis(to_bpoly(curve))


def curve_of_bpoly(family: type[ParametricCurve], polynomial: BPoly | PPoly) -> ParametricCurve:
    """Return the curve of a family that a ``BPoly`` or ``PPoly`` is; see `ParametricCurve.from_bpoly`."""
    interpolate = _scipy_interpolate()
    if isinstance(polynomial, interpolate.PPoly):
        polynomial = interpolate.BPoly.from_power_basis(polynomial)
    if not isinstance(polynomial, interpolate.BPoly):
        raise CurveError(f"polynomial must be a BPoly or PPoly of SciPy's, not {type(polynomial).__name__}")
    coefficients = number_array(polynomial.c, "the coefficients of polynomial")
    if coefficients.ndim > 3:
        raise CurveError(
            f"values of polynomial must have the shape () or (dim,), not {coefficients.shape[2:]}"
        )
    controls = coefficients.reshape(*coefficients.shape[:2], -1).swapaxes(0, 1)
    breaks = parameter_array(polynomial.x, len(controls) + 1)
    curve = _through(family, controls, breaks)
    _check_equal(curve, controls, breaks)
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


def _through(family: type[ParametricCurve], controls: FloatArray, breaks: FloatArray) -> ParametricCurve:
    """Return the curve of a family with the values that it needs of a piecewise polynomial."""
    if family.is_one_polynomial:
        count = max(controls.shape[1], 2)
        at = breaks[0] + chebyshev(count) * (breaks[-1] - breaks[0])
        at[-1] = breaks[-1]
        return family.from_jets(_values(controls, breaks, at)[:, None], at)
    jets = []
    for _ in range(family.derivatives + 1):
        jets.append(np.concatenate((controls[:, 0], controls[-1:, -1])))
        controls = bernstein_algebra.derivative(controls) / np.diff(breaks)[:, None, None]
    return family.from_jets(np.stack(jets, axis=1), breaks)


def _values(controls: FloatArray, breaks: FloatArray, t: FloatArray) -> FloatArray:
    """Return a piecewise polynomial inside its domain, (m, dim)."""
    piece = np.clip(np.searchsorted(breaks, t, side="right") - 1, 0, len(controls) - 1)
    places = (t - breaks[piece]) / np.diff(breaks)[piece]
    return bernstein_algebra.values(controls[piece], places)


def _check_equal(curve: ParametricCurve, controls: FloatArray, breaks: FloatArray) -> None:
    """Compare at more places of each piece than a polynomial of the larger degree can have roots."""
    count = max(controls.shape[1], (curve.degree or 0) + 1) + 1
    places = np.sin((np.arange(count) + 0.5) * (np.pi / (2 * count))) ** 2
    t = (breaks[:-1, None] + places * np.diff(breaks)[:, None]).ravel()
    off = np.abs(curve.evaluate(t) - _values(controls, breaks, t)).max(axis=1)
    worst = int(off.argmax())
    if off[worst] > _AS_GOOD_AS_EQUAL * np.abs(controls).max():
        raise CurveError(
            f"polynomial must be a curve of {curve.name}, which through its values differs from it "
            f"by {off[worst]:.3g} at t = {t[worst]:.6g}"
        )
