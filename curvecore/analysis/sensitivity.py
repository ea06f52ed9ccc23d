"""Sensitivities of a curve to its points, velocities, accelerations and parameters.

A curve is linear in its jets, so their sensitivities are the basis functions
themselves; where velocities are estimated from the points, those of the points
are their cardinal functions. Moving a parameter t_i at fixed data: e = dc/dt_i is a curve of
the same family that keeps all other conditions, e^(r)(t_j) = 0, and from
differentiating c^(r)(t_i) = d_ir with respect to t_i, e^(r)(t_i) =
-c^(r+1)(t_i). Hence

    dc/dt_i (t) = - sum over r of B_ir(t) c^(r+1)(t_i)

with the derivatives of the segment that holds t: -L_i(t) c'(t_i) for a
`LagrangeCurve`, -B_i0 v_i - B_i1 c''(t_i) for cubics, and so on.

References
----------
.. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001,
   chapter I: the interpolant as a function of its nodes (problem 8).
.. [2] G. M. Ziegler, "Lectures on Polytopes", Springer 1995, section 7.3:
   zonotopes, which are what errors of several parameters can reach.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.analysis.cardinal import CardinalBasis
from curvecore.arithmetic import cross, vector_lengths
from curvecore.arrays import FloatArray, integer, parameter_row
from curvecore.errors import CurveError
from curvecore.families.chain import joint_of_row
from curvecore.families.curve import ParametricCurve


class Band(NamedTuple):
    """Half-widths of the region that errors of the data can bring c(t) to.

    Attributes
    ----------
    distance : ndarray, shape (m,)
        The largest distance of the disturbed c(t) from c(t).
    across : ndarray, shape (m,)
        Its largest component across the curve, square to c'(t); where the
        curve rests, the distance.

    See Also
    --------
    worst_case_band : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, worst_case_band
    >>> band = worst_case_band(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), [0.5, 1], point_error=0.1)
    >>> band.distance.round(9).tolist()
    [0.125, 0.1]
    """

    distance: FloatArray
    across: FloatArray


def point_sensitivity(curve: ParametricCurve | CardinalBasis, t: ArrayLike) -> FloatArray:
    """Return dc(t)/dp_i, a factor: moving p_i by d moves c(t) by that times d.

    Parameters
    ----------
    curve : ParametricCurve or CardinalBasis
        Of a curve, velocities and accelerations stay as they are; of its cardinal basis, those that are
        estimated follow the points.
    t : float or array_like of any shape
        Finite, inside the domain or not.

    Returns
    -------
    ndarray, shape (*shape of t, n)
        B_i0(t), or C_i(t). A `Chain` has a column for every row of its jets.

    See Also
    --------
    velocity_sensitivity, acceleration_sensitivity, parameter_sensitivity : Of other data.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, point_sensitivity
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> point_sensitivity(curve, 0.5).tolist()
    [0.375, 0.75, -0.125]
    """
    return curve.basis(t) if isinstance(curve, CardinalBasis) else curve.basis(t)[..., 0]


def velocity_sensitivity(curve: ParametricCurve, t: ArrayLike) -> FloatArray:
    """Return dc(t)/dv_i = B_i1(t), in units of t.

    Parameters
    ----------
    curve : ParametricCurve
        Of a family with velocities.
    t : float or array_like of any shape
        Finite, inside the domain or not.

    Returns
    -------
    ndarray, shape (*shape of t, n)
        A `Chain` has a column for every row of its jets.

    Raises
    ------
    CurveError
        If the family has no velocities.

    See Also
    --------
    point_sensitivity, acceleration_sensitivity, parameter_sensitivity : Of other data.

    Examples
    --------
    >>> from curvecore import HermiteCurve, velocity_sensitivity
    >>> curve = HermiteCurve([[0], [1]], [[0], [0]], [0, 1])
    >>> velocity_sensitivity(curve, 0.5).tolist()
    [0.125, -0.125]
    """
    return _column(curve, t, 1, "velocities")


def acceleration_sensitivity(curve: ParametricCurve, t: ArrayLike) -> FloatArray:
    """Return dc(t)/da_i = B_i2(t), in units of t squared.

    Parameters
    ----------
    curve : ParametricCurve
        Of a family with accelerations.
    t : float or array_like of any shape
        Finite, inside the domain or not.

    Returns
    -------
    ndarray, shape (*shape of t, n)
        A `Chain` has a column for every row of its jets.

    Raises
    ------
    CurveError
        If the family has no accelerations.

    See Also
    --------
    point_sensitivity, velocity_sensitivity, parameter_sensitivity : Of other data.

    Examples
    --------
    >>> from curvecore import QuinticHermiteCurve, acceleration_sensitivity
    >>> curve = QuinticHermiteCurve([[0], [1]], [[0], [0]], [[0], [0]], [0, 1])
    >>> acceleration_sensitivity(curve, 0.5).tolist()
    [0.015625, 0.015625]
    """
    return _column(curve, t, 2, "accelerations")


def _column(curve: ParametricCurve, t: ArrayLike, r: int, name: str) -> FloatArray:
    if curve.jets.shape[1] <= r:
        raise CurveError(f"curve must be of a family with {name}")
    return curve.basis(t)[..., r]


def parameter_sensitivity(curve: ParametricCurve, t: ArrayLike) -> FloatArray:
    """Return dc(t)/dt_i at fixed t, points, velocities and accelerations.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family. Velocities that a rule estimates from the t_i count as given.
    t : float or array_like, shape (m,)
        A scalar counts as m = 1. At a joint the segment to the right counts.

    Returns
    -------
    ndarray, shape (m, n, dim)
        Per unit of t; n counts ``curve.parameters``, so a joint of a chain
        moves the ends of both its pieces.

    See Also
    --------
    point_sensitivity, velocity_sensitivity, acceleration_sensitivity : Of other data.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, parameter_sensitivity
    >>> line = LagrangeCurve([[0, 0], [1, 2]], [0, 1])
    >>> parameter_sensitivity(line, 0.5).round(9).tolist()
    [[[-0.5, -1.0], [-0.5, -1.0]]]
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        return curve.parameter_derivatives(t)


def worst_case_band(
    curve: ParametricCurve,
    t: ArrayLike,
    point_error: ArrayLike = 0.0,
    parameter_error: ArrayLike = 0.0,
    velocity_error: ArrayLike = 0.0,
    acceleration_error: ArrayLike = 0.0,
    jerk_error: ArrayLike = 0.0,
    *,
    cardinal: CardinalBasis | None = None,
    sensitivity: ArrayLike | None = None,
) -> Band:
    """Return bounds of the displacement of the curve by errors of the data.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family; of any dim, but see below.
    t : float or array_like, shape (m,)
        A scalar counts as m = 1.
    point_error : float or array_like, shape (n,), optional
        Largest length of the error of every point, at least 0.
    parameter_error : float or array_like, shape (n,), optional
        Largest size of the error of every t_i, at least 0.
    velocity_error, acceleration_error, jerk_error : float or array_like, shape (n,), optional
        The same for velocities, accelerations and third derivatives, per unit of t, as far as the family has
        them; derivatives of higher order have no errors.
    cardinal : CardinalBasis, optional
        The cardinal functions of the points, where velocities or accelerations are estimated from them; of
        the whole curve, where `curve` is a piece of it. ``point_error`` counts its points then. With
        ``one_sided`` effects the errors count, to first order, that displace one coordinate most.
    sensitivity : array_like, shape (m, n, dim), optional
        dc/dt_i, where it is not that of `parameter_sensitivity`: where a rule estimates velocities from the
        parameters, too. ``parameter_error`` counts its n then.

    Returns
    -------
    Band
        Reached by some errors, hence as narrow as can be.

    Raises
    ------
    CurveError
        If an error is negative or of another shape.

    See Also
    --------
    Band : What it returns.
    ensemble : Random errors.

    Notes
    -----
    Errors of the points and of derivatives enter exactly: they add up to
    sum_i,r |B_ir(t)| eps_ir in every direction. Errors of the parameters enter
    to first order; what is left out is about (delta / gap)**2 times the
    Lebesgue function. Together they reach a sum of segments, a zonotope,
    whose farthest corner is found exactly in the plane; in space its
    distance is bounded by the sum of the lengths. `across` is exact always.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, worst_case_band
    >>> band = worst_case_band(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), [0.5, 1], point_error=0.1)
    >>> band.distance.round(9).tolist()
    [0.125, 0.1]
    """
    at = parameter_row(t)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        errors = (point_error, velocity_error, acceleration_error, jerk_error)
        ball = _ball(curve, at, errors, cardinal)
        known = None if sensitivity is None else np.asarray(sensitivity, dtype=np.float64)
        count = len(curve.parameters) if known is None else known.shape[1]
        delta = error_sizes(parameter_error, count, "parameter_error")
        if not delta.any():
            return Band(ball, ball.copy())
        moves = _moves(curve, at, delta) if known is None else known * delta[:, None]
        (velocity,) = curve.derivatives_at(at, (1,))
        farthest = _farthest(moves)
        return Band(ball + farthest, ball + _across(moves, velocity, farthest))


def _ball(
    curve: ParametricCurve, t: FloatArray, errors: tuple[ArrayLike, ...], cardinal: CardinalBasis | None
) -> FloatArray:
    """Return the sum of |B_ir| times the sizes of the errors, for points of |C_i| where these are given."""
    rows, width = curve.jets.shape[:2]
    names = ("point_error", "velocity_error", "acceleration_error", "jerk_error")
    of_points: ArrayLike = 0.0 if cardinal is not None else errors[0]
    sizes = np.zeros((rows, width))
    for r, (error, name) in enumerate(zip((of_points, *errors[1:]), names, strict=True)):
        checked = error_sizes(error, rows, name)
        if r < width:
            sizes[:, r] = checked
    ball = np.zeros(len(t)) if cardinal is not None and not sizes.any() else sums_of_data(curve, t, sizes)
    if cardinal is not None:
        ball += cardinal.sums(t, error_sizes(errors[0], cardinal.count, names[0]))
    return ball


def sums_of_data(curve: ParametricCurve, t: FloatArray, sizes: FloatArray, order: int = 0) -> FloatArray:
    """Return the sums of |B_ir^(order)(t)| times sizes (n, R), (m,)."""
    if curve.is_local and len(curve.pieces) == 1:
        local = curve.local_basis(t, order)
        both = np.stack((sizes[local.segment], sizes[local.segment + 1]), axis=1)
        return np.asarray((np.abs(local.values) * both).sum(axis=(1, 2)))
    basis = np.abs(curve.basis(t, order))
    return basis.reshape(len(basis), -1) @ sizes.ravel()


def _moves(curve: ParametricCurve, t: FloatArray, delta: FloatArray) -> FloatArray:
    """Return the effects of parameters that change by delta, without those that have none by construction."""
    if curve.is_local:
        segment, moves = curve.local_parameter_derivatives(t)
        return moves * np.stack((delta[segment], delta[segment + 1]), axis=1)[:, :, None]
    return parameter_sensitivity(curve, t) * delta[:, None]


def error_sizes(error: ArrayLike, count: int, name: str) -> FloatArray:
    """Check sizes of errors: one for all or one each, at least 0; return shape (count,)."""
    sizes = parameter_row(error)
    if sizes.size not in (1, count):
        raise CurveError(f"{name} must be a number or have the shape ({count},), not ({sizes.size},)")
    if (sizes < 0.0).any():
        raise CurveError(f"{name} must be at least 0")
    return np.broadcast_to(sizes, (count,)).astype(np.float64)


def _across(moves: FloatArray, velocity: FloatArray, farthest: FloatArray) -> FloatArray:
    """Return the reach of sums of +-moves square to the velocities, (m, dim); at rest, `farthest`."""
    size = vector_lengths(velocity)
    rests = size == 0.0
    unit = (velocity / np.where(rests, 1.0, size)[:, None])[:, None]
    if moves.shape[2] == 2:
        normal = np.abs(cross(unit, moves)).sum(axis=1)
    else:
        normal = _farthest(moves - (moves * unit).sum(axis=2, keepdims=True) * unit)
    return np.where(rests, farthest, normal)


def _farthest(moves: FloatArray) -> FloatArray:
    """Return the largest length of a sum of +-moves, shape (m, n, dim) to (m,)."""
    if moves.shape[2] != 2:
        return np.asarray(vector_lengths(moves).sum(axis=1))
    # The corners of the zonotope: all moves turned to point up, then one after the other reversed in
    # the order of their directions.
    down = (moves[:, :, 1] < 0.0) | ((moves[:, :, 1] == 0.0) & (moves[:, :, 0] < 0.0))
    up = np.where(down[:, :, None], -moves, moves)
    order = np.argsort(np.arctan2(up[:, :, 1], up[:, :, 0]), axis=1)
    sorted_ = np.take_along_axis(up, order[:, :, None], axis=1)
    corners = sorted_.sum(axis=1, keepdims=True) - 2.0 * np.cumsum(sorted_, axis=1)
    return np.asarray(vector_lengths(corners).max(axis=1))


# Random errors

Remake = Callable[[FloatArray, FloatArray], ParametricCurve]
"""Points (n, dim) and parameters (n,) to a curve."""


class Ensemble(NamedTuple):
    """Data with random errors.

    Attributes
    ----------
    curves : tuple of ParametricCurve
        Like the given one, with disturbed data.
    jets : ndarray, shape (count, rows, R, dim)
        Their data.
    parameters : ndarray, shape (count, n)
        Their parameters.

    See Also
    --------
    ensemble : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, ensemble
    >>> disturbed = ensemble(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), point_error=0.01, count=3)
    >>> disturbed.evaluate([0.5, 1]).shape
    (3, 2, 2)
    """

    curves: tuple[ParametricCurve, ...]
    jets: FloatArray
    parameters: FloatArray

    def evaluate(self, t: ArrayLike) -> FloatArray:
        """Return all curves at t.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            A scalar counts as m = 1.

        Returns
        -------
        ndarray, shape (count, m, dim)
            Curve by curve.
        """
        at = parameter_row(t)
        if (self.parameters == self.parameters[0]).all():
            basis = self.curves[0].basis(at)
            flat = basis.reshape(len(basis), -1)
            with np.errstate(over="ignore", under="ignore"):
                return flat @ self.jets.reshape(len(self.jets), flat.shape[1], -1)
        return np.stack([curve.evaluate(at) for curve in self.curves])


def ensemble(
    curve: ParametricCurve,
    point_error: ArrayLike = 0.0,
    parameter_error: ArrayLike = 0.0,
    count: int = 50,
    seed: int = 0,
    *,
    closed: bool = False,
    remake: Remake | None = None,
) -> Ensemble:
    """Return curves with random errors of the data, the same ones for the same seed.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family; for errors of the parameters one of those of
        `parameter_sensitivity`.
    point_error : float or array_like, shape (n,), optional
        Every point is displaced by a vector, uniformly distributed in the
        ball of this radius. n counts ``curve.parameters``.
    parameter_error : float or array_like, shape (n,), optional
        Every t_i is displaced, uniformly distributed, by up to this. Less
        than half the smallest distance of two t_i.
    count : int, optional
        At least 1.
    seed : int, optional
        At least 0.
    closed : bool, optional
        Whether the last point is the first one again: both are displaced together.
    remake : Remake, optional
        Makes the curve of disturbed points and parameters where a rule estimates velocities or accelerations
        from them; without it these stay as they are.

    Returns
    -------
    Ensemble

    Raises
    ------
    CurveError
        If errors are negative, of another shape, or so large that parameters
        might change places.

    See Also
    --------
    Ensemble : What it returns.
    worst_case_band : What such errors can do at most.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, ensemble
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> disturbed = ensemble(curve, point_error=0.01, count=3, seed=7)
    >>> len(disturbed.curves), bool(abs(disturbed.evaluate(1) - curve(1)).max() <= 0.01)
    (3, True)
    """
    number = integer(count, "count", 1)
    random = np.random.default_rng(integer(seed, "seed", 0))
    t = curve.parameters
    delta = error_sizes(parameter_error, len(t), "parameter_error")
    if (t[:-1] + delta[:-1] >= t[1:] - delta[1:]).any():
        raise CurveError("parameter_error must be less than half the smallest distance of two parameters")
    radius = error_sizes(point_error, len(t), "point_error")
    shifts = radius[:, None] * _in_ball(random, (number, len(t)), curve.points.shape[1])
    if closed:
        shifts[:, -1] = shifts[:, 0]
    parameters = t + delta * random.uniform(-1.0, 1.0, (number, len(t)))
    if remake is not None:
        curves = tuple(
            remake(*data_of_curve) for data_of_curve in zip(curve.points + shifts, parameters, strict=True)
        )
        return Ensemble(curves, np.stack([data_of_curve.jets for data_of_curve in curves]), parameters)
    jets = np.broadcast_to(curve.jets, (number, *curve.jets.shape)).copy()
    with np.errstate(over="ignore", under="ignore"):
        jets[:, :, 0] += shifts[:, joint_of_row(curve)]
    if not delta.any():
        curves = tuple(curve.with_jets(data_of_curve) for data_of_curve in jets)
    else:
        curves = tuple(
            curve.with_data(*data_of_curve) for data_of_curve in zip(jets, parameters, strict=True)
        )
    return Ensemble(curves, jets, parameters)


def _in_ball(random: np.random.Generator, shape: tuple[int, int], dim: int) -> FloatArray:
    direction = random.standard_normal((*shape, dim))
    radius = random.random(shape) ** (1.0 / dim)
    return direction * (radius / vector_lengths(direction))[..., None]
