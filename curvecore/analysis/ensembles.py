"""Curves with random errors in their data, repeatable.

What most errors do, beside the worst that `sensitivity` knows.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.analysis.sensitivity import error_sizes
from curvecore.arithmetic import vector_lengths
from curvecore.arrays import FloatArray, integer, parameter_row
from curvecore.errors import CurveError
from curvecore.families.chain import joint_of_row
from curvecore.families.curve import ParametricCurve

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
        curves = tuple(remake(*each) for each in zip(curve.points + shifts, parameters, strict=True))
        return Ensemble(curves, np.stack([each.jets for each in curves]), parameters)
    jets = np.broadcast_to(curve.jets, (number, *curve.jets.shape)).copy()
    with np.errstate(over="ignore", under="ignore"):
        jets[:, :, 0] += shifts[:, joint_of_row(curve)]
    if not delta.any():
        curves = tuple(curve.with_jets(each) for each in jets)
    else:
        curves = tuple(curve.with_data(*each) for each in zip(jets, parameters, strict=True))
    return Ensemble(curves, jets, parameters)


def _in_ball(random: np.random.Generator, shape: tuple[int, int], dim: int) -> FloatArray:
    direction = random.standard_normal((*shape, dim))
    radius = random.random(shape) ** (1.0 / dim)
    return direction * (radius / vector_lengths(direction))[..., None]
