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
from functools import lru_cache, wraps
from typing import NamedTuple, ParamSpec, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import SMALLEST
from curvecore.arrays import FloatArray, parameter_array, point_array, read_only
from curvecore.errors import CurveError
from curvecore.families.cubic_spline import solve_dominant
from curvecore.parametrization import Spaced, relative_spacing

_Arguments = ParamSpec("_Arguments")
_FEW = 48  # segments, up to which a spline under a hand, its parameters at rest, is a matrix that is kept
_Linear: TypeAlias = Callable[[FloatArray, FloatArray], FloatArray]


def in_range(rule: Callable[_Arguments, FloatArray]) -> Callable[_Arguments, FloatArray]:
    """Make a rule refuse results that no double can hold."""

    @wraps(rule)
    def checked(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> FloatArray:
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            estimates = rule(*args, **kwargs)
        if not np.isfinite(estimates).all():
            i = int(np.argmin(np.isfinite(estimates).all(axis=1)))
            raise CurveError(
                f"points around {i} lie too far apart for such close parameters: "
                "the derivative there exceeds the largest number",
                (i,),
            )
        return estimates

    return checked


class Steps(NamedTuple):
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


def steps_of(points: ArrayLike, parameters: ArrayLike) -> Steps:
    """Check points, (n, dim), and parameters, (n,), and return their differences."""
    positions = point_array(points)
    if isinstance(parameters, Spaced):
        return differences(positions, parameters.spacing)
    return differences(positions, np.diff(parameter_array(parameters, len(positions))))


def differences(points: FloatArray, spacing: FloatArray) -> Steps:
    """Return the differences of points, (n, dim), so far apart in t, (n - 1,)."""
    h = spacing[:, None]
    return Steps(h, (points[1:] - points[:-1]) / h)


@in_range
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

    See Also
    --------
    bessel_velocities, catmull_rom_velocities, natural_spline_velocities : Other rules.

    Examples
    --------
    >>> from curvecore import finite_difference_velocities
    >>> finite_difference_velocities([[0], [1], [9]], [0, 1, 3]).tolist()
    [[1.0], [2.5], [4.0]]
    """
    slope = steps_of(points, parameters).slope
    return np.concatenate((slope[:1], 0.5 * slope[:-1] + 0.5 * slope[1:], slope[-1:]))


@in_range
def bessel_velocities(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the velocities of the parabolas through three neighbouring points.

    At the ends the parabola of the first or last three points is used.
    Exact for parabolas; see [1]_ of the module, chapter IV, (9).

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

    See Also
    --------
    catmull_rom_velocities, finite_difference_velocities, natural_spline_velocities : Other rules.

    Examples
    --------
    >>> from curvecore import bessel_velocities
    >>> bessel_velocities([[0], [1], [9]], [0, 1, 3]).round(9).tolist()
    [[0.0], [2.0], [6.0]]
    """
    steps = steps_of(points, parameters)
    return _with_ends(_parabola_velocities(steps), steps.slope)


def _parabola_velocities(steps: Steps) -> FloatArray:
    """Return the velocities of the parabolas through three points in the middle ones, (n - 2, dim)."""
    h, slope = steps
    # The nearer chord counts more.
    return slope[:-1] + h[:-1] / (h[:-1] + h[1:]) * (slope[1:] - slope[:-1])


def _with_ends(inner: FloatArray, slope: FloatArray) -> FloatArray:
    """Add the velocities at both ends, of the parabola with the end chord and the neighbour's velocity."""
    # For two points these are the only velocities, and both are the slope.
    near = inner if len(inner) else slope
    return np.concatenate((2.0 * slope[:1] - near[:1], inner, 2.0 * slope[-1:] - near[-1:]))


@in_range
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

    See Also
    --------
    bessel_velocities, finite_difference_velocities, natural_spline_velocities : Other rules.

    Examples
    --------
    >>> from curvecore import catmull_rom_velocities
    >>> catmull_rom_velocities([[0, 0], [1, 1], [4, 0]], [0, 1, 2], alpha=0).round(9).tolist()
    [[0.0, 2.0], [2.0, 0.0], [4.0, -2.0]]
    """
    positions = point_array(points)
    h, slope = steps_of(positions, parameters)
    # Distances that underflow would divide by zero; the smallest normal number stands for them.
    apart = positions if knots_of is None else point_array(knots_of)
    knots = np.maximum(relative_spacing(apart, alpha, "Catmull-Rom"), SMALLEST)
    inner = _parabola_velocities(differences(positions, knots))
    inner *= (knots[:-1] + knots[1:])[:, None] / (h[:-1] + h[1:])
    return _with_ends(inner, slope)


def catmull_rom_changes(
    points: ArrayLike, parameters: ArrayLike, moves: ArrayLike, alpha: float = 0.5
) -> FloatArray:
    """Return the effects of moves of the points on `catmull_rom_velocities` at fixed knots, exactly.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2; their distances space the knots.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    moves : array_like, shape (n, k)
        Each column moves a coordinate of every point.
    alpha : float, optional
        At least 0; 0 uniform, 1/2 centripetal, 1 chordal knots.

    Returns
    -------
    ndarray, shape (n, 1, k)
        The changes, the same for every coordinate.

    See Also
    --------
    catmull_rom_velocities : The rule.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import catmull_rom_changes
    >>> catmull_rom_changes([[0], [1], [2]], [0, 1, 2], np.eye(3))[1, 0].round(9).tolist()
    [-0.5, 0.0, 0.5]
    """
    return catmull_rom_velocities(moves, parameters, alpha, knots_of=points)[:, None]


@in_range
def natural_spline_velocities(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the velocities of the natural cubic spline.

    The twice continuously differentiable piecewise cubic through the points
    with c'' = 0 at both ends; O(n).

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

    See Also
    --------
    bessel_velocities, catmull_rom_velocities, finite_difference_velocities : Other rules.
    natural_spline_accelerations : Its accelerations.

    Examples
    --------
    >>> from curvecore import natural_spline_velocities
    >>> natural_spline_velocities([[0], [1], [0]], [0, 1, 2]).round(9).tolist()
    [[1.5], [0.0], [-1.5]]
    """
    h, slope = steps_of(points, parameters)
    return _applied(_natural_velocities, h, slope)


def _natural_velocities(h: FloatArray, slope: FloatArray) -> FloatArray:
    share, zero, half = h[:-1] / (h[:-1] + h[1:]), np.zeros((1, 1)), np.full((1, 1), 0.5)
    before = np.concatenate((zero, 0.5 * (1.0 - share), half))
    after = np.concatenate((half, 0.5 * share, zero))
    inner = 3.0 * (before[1:-1] * slope[:-1] + after[1:-1] * slope[1:])
    return solve_dominant(before, after, np.concatenate((1.5 * slope[:1], inner, 1.5 * slope[-1:])))


@in_range
def natural_spline_accelerations(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the second derivatives of the natural cubic spline at the joints.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.

    Returns
    -------
    ndarray, shape (n, dim)
        Accelerations per unit of t squared; 0 at both ends.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's.

    See Also
    --------
    natural_spline_velocities : Its velocities.
    zero_accelerations : The other rule.

    Examples
    --------
    >>> from curvecore import natural_spline_accelerations
    >>> natural_spline_accelerations([[0], [1], [0]], [0, 1, 2]).round(9).tolist()
    [[0.0], [-3.0], [0.0]]
    """
    h, slope = steps_of(points, parameters)
    return _applied(_natural_accelerations, h, slope[1:] - slope[:-1])


def _natural_accelerations(h: FloatArray, bend: FloatArray) -> FloatArray:
    length, zero = h[:-1] + h[1:], np.zeros((1, 1))
    before = np.concatenate((zero, 0.5 * (h[:-1] / length), zero))
    after = np.concatenate((zero, 0.5 * (h[1:] / length), zero))
    none = np.zeros((1, bend.shape[1]))
    return solve_dominant(before, after, np.concatenate((none, 3.0 * (bend / length), none)))


def _applied(rule: _Linear, h: FloatArray, given: FloatArray) -> FloatArray:
    """Return ``rule(h, given)``; for few segments by a matrix that is kept for those lengths h."""
    if len(h) > _FEW:
        return rule(h, given)
    return _matrix_of(rule, len(given), h.tobytes()) @ given


@lru_cache(maxsize=16)
def _matrix_of(rule: _Linear, count: int, lengths: bytes) -> FloatArray:
    return read_only(rule(np.frombuffer(lengths)[:, None], np.eye(count)))


@in_range
def natural_spline_jerks(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return the third derivatives of the natural cubic spline at the joints.

    Where that jumps, at all joints but the ends, the derivative of the parabola through three neighbouring
    accelerations: of the two sides the one with the shorter segment counts more.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.

    Returns
    -------
    ndarray, shape (n, dim)
        Jerks per unit of t cubed.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's.

    See Also
    --------
    natural_spline_accelerations : The second derivatives of the same spline.

    Examples
    --------
    >>> from curvecore import natural_spline_jerks
    >>> natural_spline_jerks([[0], [1], [0]], [0, 1, 2]).round(9).tolist()
    [[-3.0], [0.0], [3.0]]
    """
    steps = steps_of(natural_spline_accelerations(points, parameters), parameters)
    return np.concatenate((steps.slope[:1], _parabola_velocities(steps), steps.slope[-1:]))


def zero_accelerations(points: ArrayLike) -> FloatArray:
    """Return accelerations of 0.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.

    Returns
    -------
    ndarray, shape (n, dim)
        Zeros.

    See Also
    --------
    natural_spline_accelerations : The other rule.

    Examples
    --------
    >>> from curvecore import zero_accelerations
    >>> zero_accelerations([[0, 0], [1, 2]]).tolist()
    [[0.0, 0.0], [0.0, 0.0]]
    """
    return np.zeros_like(point_array(points))
