"""Rules that estimate velocities, accelerations and jerks from the points, and from derivatives that are set.

All results are per unit of t of the given parameters. Two points always give
the straight line at constant velocity.

What is set is given to the rule. The natural spline has one equation for each
velocity, that of continuous c'' or of a natural end, and a velocity that is set
replaces its own equation, as at a clamped end [1]_. So the spline is twice
continuously differentiable wherever nothing is set, and the estimates are linear
in the points and in what is set, d_r = E_r p + F_r s. Accelerations are the c'' of
the cubics with these velocities, at a velocity that is set the mean of both sides;
jerks are slopes of the accelerations, set or estimated, and neither has an effect on
derivatives of lower order. As no other equation depends on what is set, setting a
derivative to its estimate changes nothing. Local rules estimate from the points, and
their velocities at an end from the neighbour's velocity, set or estimated.

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
from curvecore.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    parameter_array,
    point_array,
    read_only,
    rows_or_nan,
)
from curvecore.families.cubic_spline import overflow_in, solve_dominant
from curvecore.parametrization import Spaced, relative_spacing

_Arguments = ParamSpec("_Arguments")
_FEW = 48  # segments, up to which a spline under a hand, its parameters at rest, is a matrix that is kept
_Linear: TypeAlias = Callable[[FloatArray, FloatArray, BoolArray | None], FloatArray]


def in_range(rule: Callable[_Arguments, FloatArray]) -> Callable[_Arguments, FloatArray]:
    """Make a rule refuse results that no double can hold."""

    @wraps(rule)
    def checked(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> FloatArray:
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            estimates = rule(*args, **kwargs)
        if not np.isfinite(estimates).all():
            raise overflow_in(estimates)
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
    """Check points, (n, dim), and parameters, (n,), and return their differences.

    A distance of 0, which `Spaced` parameters may have between two rows of one point, is a break: there one
    spline ends and the next one begins. Its slope is 0.
    """
    positions = point_array(points)
    if isinstance(parameters, Spaced):
        h, change = parameters.spacing[:, None], positions[1:] - positions[:-1]
        return Steps(h, np.divide(change, h, out=np.zeros_like(change), where=h > 0.0))
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
def bessel_velocities(
    points: ArrayLike, parameters: ArrayLike, *, velocities: ArrayLike | None = None
) -> FloatArray:
    """Return the velocities of the parabolas through three neighbouring points.

    At the ends the parabola with the end chord and the neighbour's velocity, that
    of the first or last three points unless that velocity is set. Exact for
    parabolas; see [1]_ of the module, chapter IV, (9).

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    velocities : array_like, shape (n, dim), optional
        Velocities that are set, per unit of t, and NaN in the rows of the others.

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
    return _with_ends(_parabola_velocities(steps), steps.slope, velocities)


def _parabola_velocities(steps: Steps) -> FloatArray:
    """Return the velocities of the parabolas through three points in the middle ones, (n - 2, dim)."""
    h, slope = steps
    # The nearer chord counts more.
    return slope[:-1] + h[:-1] / (h[:-1] + h[1:]) * (slope[1:] - slope[:-1])


def _with_ends(inner: FloatArray, slope: FloatArray, velocities: ArrayLike | None) -> FloatArray:
    """Return velocities with those set, and at free ends that of the parabola with the end chord.

    That parabola has the velocity of the end's neighbour.
    """
    # Of two points neither has another neighbour: the slope stands for an estimate of the other velocity.
    result = np.concatenate((slope[:1], inner, slope[-1:]))
    given = _given(velocities, result.shape)
    is_free = np.ones(len(result), dtype=np.bool_) if given is None else ~given.is_set
    if given is not None:
        result = np.where(is_free[:, None], result, given.rows)
    ends = 2.0 * slope[[0, -1]] - result[[1, -2]]
    for end in (0, -1):
        if is_free[end]:
            result[end] = ends[end]
    return result


@in_range
def catmull_rom_velocities(
    points: ArrayLike,
    parameters: ArrayLike,
    alpha: float = 0.5,
    *,
    knots_of: ArrayLike | None = None,
    velocities: ArrayLike | None = None,
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
    velocities : array_like, shape (n, dim), optional
        Velocities that are set, per unit of t, and NaN in the rows of the others.

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
    return _with_ends(inner, slope, velocities)


def catmull_rom_changes(
    points: ArrayLike,
    parameters: ArrayLike,
    moves: ArrayLike,
    alpha: float = 0.5,
    *,
    velocities: ArrayLike | None = None,
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
    velocities : array_like, shape (n, k), optional
        Changes of the velocities that are set, and NaN in the rows of the others.

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
    changes = catmull_rom_velocities(moves, parameters, alpha, knots_of=points, velocities=velocities)
    return changes[:, None]


@in_range
def natural_spline_velocities(
    points: ArrayLike, parameters: ArrayLike, *, velocities: ArrayLike | None = None
) -> FloatArray:
    """Return the velocities of the natural cubic spline, or of the one with the velocities that are set.

    The piecewise cubic through the points that is twice continuously
    differentiable at every joint where no velocity is set, with c'' = 0 at ends
    without one; O(n).

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    velocities : array_like, shape (n, dim), optional
        Velocities that are set, per unit of t, and NaN in the rows of the others.

    Returns
    -------
    ndarray, shape (n, dim)
        Velocities per unit of t; those set are as given.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's, or a row of `velocities` that is partly NaN.

    See Also
    --------
    bessel_velocities, catmull_rom_velocities, finite_difference_velocities : Other rules.
    natural_spline_accelerations : Its accelerations.

    Notes
    -----
    With velocities set at both ends alone this is SciPy's ``CubicSpline`` with first derivatives for its
    ``bc_type``. Setting a velocity to what it is estimated as changes no other one.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import natural_spline_velocities
    >>> natural_spline_velocities([[0], [1], [0]], [0, 1, 2]).round(9).tolist()
    [[1.5], [0.0], [-1.5]]
    >>> clamped = [[0], [np.nan], [np.nan]]
    >>> natural_spline_velocities([[0], [1], [0]], [0, 1, 2], velocities=clamped).round(9).tolist()
    [[0.0], [0.428571429], [-1.714285714]]
    """
    h, slope = steps_of(points, parameters)
    given = _given(velocities, (len(h) + 1, slope.shape[1]))
    if given is None:
        return _applied(_natural_velocities, h, slope, None)
    return _applied(_natural_velocities, h, np.concatenate((slope, given.rows)), given.is_set)


def _natural_velocities(h: FloatArray, data: FloatArray, is_set: BoolArray | None) -> FloatArray:
    """Solve for the velocities; `data` are the slopes, and behind them the velocities that are set."""
    left, right = _beside(h)
    slope_before, slope_after = _beside(data[: len(h)])
    # At an end, also at a break, all of the weight is on the only segment.
    share = np.where((left > 0.0) & (right > 0.0), left / (left + right), left == 0.0)
    before, after = 0.5 * (1.0 - share), 0.5 * share
    right_side = 3.0 * (before * slope_before + after * slope_after)
    if is_set is not None:
        before[is_set] = after[is_set] = 0.0
        right_side[is_set] = data[len(h) :][is_set]
    return solve_dominant(before, after, right_side)


@in_range
def natural_spline_accelerations(
    points: ArrayLike, parameters: ArrayLike, *, velocities: ArrayLike | None = None
) -> FloatArray:
    """Return the second derivatives at the joints of the cubic spline of `natural_spline_velocities`.

    Where a velocity is set c'' jumps: the mean of both sides, of which the one with the shorter segment
    counts more.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    velocities : array_like, shape (n, dim), optional
        Velocities that are set, per unit of t, and NaN in the rows of the others.

    Returns
    -------
    ndarray, shape (n, dim)
        Accelerations per unit of t squared; 0 at ends without a velocity that is set.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's, or a row of `velocities` that is partly NaN.

    See Also
    --------
    natural_spline_velocities : Its velocities.
    zero_accelerations : The other rule.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import natural_spline_accelerations
    >>> natural_spline_accelerations([[0], [1], [0]], [0, 1, 2]).round(9).tolist()
    [[0.0], [-3.0], [0.0]]
    >>> clamped = [[0], [np.nan], [np.nan]]
    >>> natural_spline_accelerations([[0], [1], [0]], [0, 1, 2], velocities=clamped).round(9).tolist()
    [[5.142857143], [-4.285714286], [0.0]]
    """
    h, slope = steps_of(points, parameters)
    given = _given(velocities, (len(h) + 1, slope.shape[1]))
    if given is None:
        before, after = _beside(slope)
        return _applied(_natural_accelerations, h, after - before, None)
    split = _split(h.tobytes(), given.is_set.tobytes())
    first, inner = split.first, split.inner
    # Beyond an end the velocity is the slope, and between the two rows of a joint.
    before, after = _beside(slope)
    for slopes, ends in zip((before, after), split.ends, strict=True):
        slopes[ends] = given.rows[ends]
    jumps = (after - before)[split.joints]
    jumps[first[inner]] = given.rows[inner] - before[inner]
    jumps[first[inner] + 1] = after[inner] - given.rows[inner]
    rows = _applied(_natural_accelerations, split.lengths, jumps, split.is_set)
    bends: FloatArray = rows[first]
    bends[inner] += split.share * (rows[first[inner] + 1] - bends[inner])
    return bends


class _Split(NamedTuple):
    """Joints of which those with a velocity that is set, between two segments, have two rows.

    Attributes
    ----------
    lengths : ndarray, shape (m - 1, 1)
        The segment lengths; 0 between the rows of one joint.
    is_set : ndarray of bool, shape (m,)
        Whether a velocity is set.
    joints : ndarray of int, shape (m,)
        The joint of each row.
    first : ndarray of int, shape (n,)
        The first row of each joint.
    inner : ndarray of int
        The joints with two rows.
    ends : tuple of ndarray of int
        The joints with no segment before them, and with none after them.
    share : ndarray, shape (len(inner), 1)
        What the segment after a joint counts in the mean: that of the shorter one is the larger.
    """

    lengths: FloatArray
    is_set: BoolArray
    joints: IntArray
    first: IntArray
    inner: IntArray
    ends: tuple[IntArray, IntArray]
    share: FloatArray


@lru_cache(maxsize=8)
def _split(lengths: bytes, is_set: bytes) -> _Split:
    h, mask = np.frombuffer(lengths)[:, None], np.frombuffer(is_set, dtype=np.bool_)
    left, right = _beside(h)
    is_twice = mask & (left > 0.0)[:, 0] & (right > 0.0)[:, 0]
    joints, inner = np.repeat(np.arange(len(mask)), 1 + is_twice), np.flatnonzero(is_twice)
    # The segments lie behind the last row of each joint but the last one.
    longer = np.zeros((len(joints) - 1, 1))
    longer[np.cumsum(1 + is_twice)[:-1] - 1] = h
    ends = np.flatnonzero(left == 0.0), np.flatnonzero(right == 0.0)
    share = left[inner] / (left[inner] + right[inner])
    return _Split(longer, mask[joints], joints, np.cumsum(1 + is_twice) - 1 - is_twice, inner, ends, share)


def _natural_accelerations(h: FloatArray, jumps: FloatArray, is_set: BoolArray | None) -> FloatArray:
    """Solve for the accelerations; beyond an end whose velocity is set lies a segment of length 0."""
    left, right = _beside(h)
    length = left + right
    is_natural = ((left == 0.0) | (right == 0.0))[:, 0]
    if is_set is not None:
        is_natural &= ~is_set
    before, after, right_side = 0.5 * (left / length), 0.5 * (right / length), 3.0 * (jumps / length)
    before[is_natural] = after[is_natural] = right_side[is_natural] = 0.0
    return solve_dominant(before, after, right_side)


class _Given(NamedTuple):
    """Derivatives that are set.

    Attributes
    ----------
    is_set : ndarray of bool, shape (n,)
    rows : ndarray, shape (n, dim)
        0 where nothing is set.
    """

    is_set: BoolArray
    rows: FloatArray


def _given(values: ArrayLike | None, shape: tuple[int, ...], name: str = "velocities") -> _Given | None:
    """Return the derivatives that are set, of shape (n, dim); None where none is."""
    if values is None:
        return None
    rows = rows_or_nan(values, name, shape)
    is_set = ~np.isnan(rows[:, 0])
    return _Given(is_set, np.where(is_set[:, None], rows, 0.0)) if is_set.any() else None


def _beside(segments: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the values of the segments before and after each joint; 0 beyond the ends."""
    none = np.zeros((1, segments.shape[1]))
    return np.concatenate((none, segments)), np.concatenate((segments, none))


def _applied(rule: _Linear, h: FloatArray, given: FloatArray, is_set: BoolArray | None) -> FloatArray:
    """Return ``rule(h, given, is_set)``; for few segments by a matrix that is kept for those lengths h."""
    if len(h) > _FEW:
        return rule(h, given, is_set)
    return _matrix_of(rule, len(given), h.tobytes(), b"" if is_set is None else is_set.tobytes()) @ given


@lru_cache(maxsize=16)
def _matrix_of(rule: _Linear, count: int, lengths: bytes, is_set: bytes) -> FloatArray:
    mask = np.frombuffer(is_set, dtype=np.bool_) if is_set else None
    return read_only(rule(np.frombuffer(lengths)[:, None], np.eye(count), mask))


@in_range
def natural_spline_jerks(
    points: ArrayLike,
    parameters: ArrayLike,
    *,
    velocities: ArrayLike | None = None,
    accelerations: ArrayLike | None = None,
) -> FloatArray:
    """Return the third derivatives at the joints of the cubic spline of `natural_spline_velocities`.

    Where that jumps, at all joints but the ends, the derivative of the parabola through three neighbouring
    accelerations: of the two sides the one with the shorter segment counts more.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    velocities : array_like, shape (n, dim), optional
        Velocities that are set, per unit of t, and NaN in the rows of the others.
    accelerations : array_like, shape (n, dim), optional
        Accelerations that are set, and NaN in the rows of those of the spline.

    Returns
    -------
    ndarray, shape (n, dim)
        Jerks per unit of t cubed.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's, or a row of what is set that is partly NaN.

    See Also
    --------
    natural_spline_accelerations : The second derivatives of the same spline.

    Examples
    --------
    >>> from curvecore import natural_spline_jerks
    >>> natural_spline_jerks([[0], [1], [0]], [0, 1, 2]).round(9).tolist()
    [[-3.0], [0.0], [3.0]]
    """
    bends = natural_spline_accelerations(points, parameters, velocities=velocities)
    given = _given(accelerations, bends.shape, "accelerations")
    if given is not None:
        bends = np.where(given.is_set[:, None], given.rows, bends)
    h, slope = steps_of(bends, parameters)
    (left, right), (before, after) = _beside(h), _beside(slope)
    inner = before + left / (left + right) * (after - before)
    return np.where(left == 0.0, after, np.where(right == 0.0, before, inner))


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
