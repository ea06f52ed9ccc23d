"""Rules that estimate velocities, accelerations and jerks from the points alone.

All results are per unit of t of the given parameters. Two points always give
the straight line at constant velocity.

References
----------
.. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001,
   chapter IV: piecewise cubic Hermite, Bessel and spline interpolation.
.. [2] P. J. Barry and R. N. Goldman, "A recursive evaluation algorithm for a
   class of Catmull-Rom splines", SIGGRAPH 1988, 199-204.
.. [3] C. Yuksel, S. Schaefer and J. Keyser, "Parameterization and
   applications of Catmull-Rom curves", Computer-Aided Design 43 (2011)
   747-755: the knots |p_(i+1) - p_i| ** alpha.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import NamedTuple, ParamSpec

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, parameter_array, point_array
from curvecore.errors import CurveError
from curvecore.parametrization import relative_spacing
from curvecore.scaling import SMALLEST
from curvecore.tridiagonal import solve_dominant

_Arguments = ParamSpec("_Arguments")


def _in_range(rule: Callable[_Arguments, FloatArray]) -> Callable[_Arguments, FloatArray]:
    """Make a rule refuse to return what no double can hold."""

    @wraps(rule)
    def checked(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> FloatArray:
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            estimates = rule(*args, **kwargs)
        if not np.isfinite(estimates).all():
            i = int(np.argmin(np.isfinite(estimates).all(axis=1)))
            raise CurveError(
                f"points around {i} lie too far apart for parameters so close: "
                "the derivative there exceeds the largest number",
                (i,),
            )
        return estimates

    return checked


class _Steps(NamedTuple):
    """Differences of checked points and parameters.

    Attributes
    ----------
    spacing : ndarray, shape (n - 1, 1)
        Segment lengths h_i in t.
    slope : ndarray, shape (n - 1, dim)
        (p_(i+1) - p_i) / h_i.
    """

    spacing: FloatArray
    slope: FloatArray


def _steps(points: ArrayLike, parameters: ArrayLike) -> _Steps:
    places = point_array(points)
    return _differences(places, np.diff(parameter_array(parameters, len(places))))


def _differences(points: FloatArray, spacing: FloatArray) -> _Steps:
    h = spacing[:, None]
    return _Steps(h, np.diff(points, axis=0) / h)


@_in_range
def finite_difference_velocities(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the mean of the slopes of the two neighbouring chords.

    The three-point difference of the cubic Hermite literature: inside
    v_i = (slope_(i-1) + slope_i) / 2, at the ends the slope of the only
    chord. Exact for straight lines; on unequal spacing `bessel_velocities`
    is one order more accurate.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.

    Returns
    -------
    ndarray, shape (n, dim)
        Velocities per unit of t.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's.
    """
    slope = _steps(points, parameters).slope
    return np.concatenate((slope[:1], 0.5 * slope[:-1] + 0.5 * slope[1:], slope[-1:]))


@_in_range
def bessel_velocities(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the velocities of the parabolas through three neighbouring points.

    At the ends the parabola of the first or last three points is used.
    Exact for parabolas; see [1]_ of the module, chapter IV, (9).

    Parameters, result and errors are those of `finite_difference_velocities`.
    """
    steps = _steps(points, parameters)
    return _with_ends(_parabola_velocities(steps), steps.slope)


def _parabola_velocities(steps: _Steps) -> FloatArray:
    """Return the velocities of the parabolas through three points in the middle ones, (n - 2, dim)."""
    h, slope = steps
    # The nearer chord counts more.
    return slope[:-1] + h[:-1] / (h[:-1] + h[1:]) * (slope[1:] - slope[:-1])


def _with_ends(inner: FloatArray, slope: FloatArray) -> FloatArray:
    """Add the velocities at both ends, of the parabola with the end chord and the neighbour's velocity."""
    # For two points these are the only velocities, and both are the slope.
    near = inner if len(inner) else slope
    return np.concatenate((2.0 * slope[:1] - near[:1], inner, 2.0 * slope[-1:] - near[-1:]))


@_in_range
def catmull_rom_velocities(
    points: ArrayLike, parameters: ArrayLike, alpha: float = 0.5, *, knots_of: ArrayLike | None = None
) -> FloatArray:
    """Return Catmull-Rom velocities with knots spaced by distance ** alpha.

    The derivative at p_i of the Catmull-Rom curve on its own knots k_i, times
    (k_(i+1) - k_(i-1)) / (t_(i+1) - t_(i-1)). Hence alpha = 0 gives the
    classical (p_(i+1) - p_(i-1)) / (t_(i+1) - t_(i-1)), and with parameters
    of the same power rule the result is that of `bessel_velocities`.
    The literature leaves the ends open: here the parabola with the end chord
    and the neighbour's velocity.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2; consecutive points distinct unless alpha is 0.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    alpha : float, optional
        At least 0; 0 uniform, 1/2 centripetal, 1 chordal knots.
    knots_of : array_like, shape (n, any), optional
        Points whose distances space the knots; those given, if left out. With it, the velocities are
        linear in the points, as those of the other rules are.

    Returns
    -------
    ndarray, shape (n, dim)
        Velocities per unit of t.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's, coincident consecutive
        points, or a negative alpha.
    """
    places = point_array(points)
    h = np.diff(parameter_array(parameters, len(places)))
    # Distances that underflow would divide by zero; the smallest normal number stands for them.
    apart = places if knots_of is None else point_array(knots_of)
    knots = np.maximum(relative_spacing(apart, alpha, "Catmull-Rom"), SMALLEST)
    inner = _parabola_velocities(_differences(places, knots))
    inner *= ((knots[:-1] + knots[1:]) / (h[:-1] + h[1:]))[:, None]
    return _with_ends(inner, _differences(places, h).slope)


@_in_range
def natural_spline_velocities(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the velocities of the natural cubic spline.

    The twice continuously differentiable piecewise cubic through the points
    with c'' = 0 at both ends; O(n).

    Parameters, result and errors are those of `finite_difference_velocities`.
    """
    h, slope = _steps(points, parameters)
    share, zero, half = h[:-1] / (h[:-1] + h[1:]), np.zeros((1, 1)), np.full((1, 1), 0.5)
    before = np.concatenate((zero, 0.5 * (1.0 - share), half))
    after = np.concatenate((half, 0.5 * share, zero))
    inner = 3.0 * (before[1:-1] * slope[:-1] + after[1:-1] * slope[1:])
    return solve_dominant(before, after, np.concatenate((1.5 * slope[:1], inner, 1.5 * slope[-1:])))


@_in_range
def natural_spline_accelerations(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the second derivatives of the natural cubic spline at the joints.

    Per unit of t squared; 0 at both ends. Parameters and errors are those of `finite_difference_velocities`.
    """
    h, slope = _steps(points, parameters)
    length, zero = h[:-1] + h[1:], np.zeros((1, 1))
    before = np.concatenate((zero, 0.5 * (h[:-1] / length), zero))
    after = np.concatenate((zero, 0.5 * (h[1:] / length), zero))
    none = np.zeros((1, slope.shape[1]))
    right_side = np.concatenate((none, 3.0 * ((slope[1:] - slope[:-1]) / length), none))
    return solve_dominant(before, after, right_side)


def natural_spline_jerks(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the third derivatives of the natural cubic spline at the joints.

    Per unit of t cubed. Where that jumps, at all joints but the ends, the derivative of the parabola through
    three neighbouring accelerations: of the two sides the one with the shorter segment counts more.
    Parameters and errors are those of `finite_difference_velocities`.
    """
    accelerations = natural_spline_accelerations(points, parameters)
    return _jerks_between(accelerations, parameters)


@_in_range
def _jerks_between(accelerations: FloatArray, parameters: ArrayLike) -> FloatArray:
    steps = _steps(accelerations, parameters)
    return np.concatenate((steps.slope[:1], _parabola_velocities(steps), steps.slope[-1:]))


def zero_accelerations(points: ArrayLike) -> FloatArray:
    """Return zeros of the shape of the points, (n, dim)."""
    return np.zeros_like(point_array(points))
