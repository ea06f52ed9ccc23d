"""Rules that estimate derivatives, as linear maps of the points."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, parameter_row

Rule = Callable[[FloatArray, FloatArray], FloatArray]
"""Points (n, dim) and parameters (n,) to derivatives (n, dim), linear in the points."""

Follow = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Moves of the points (n, k) to what they do to the derivatives before and after each joint, each
(joints, R - 1, k); the two differ at corners, and rows of derivatives that were set by hand are 0."""


def estimation_matrix(rule: Rule, parameters: ArrayLike) -> FloatArray:
    """Return the matrix E of a rule: derivatives = E @ points, for all points with these parameters.

    Parameters
    ----------
    rule : callable
        Such as `natural_spline_velocities`; linear in the points. Of `catmull_rom_velocities` the knots
        must be given.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.

    Returns
    -------
    ndarray, shape (n, n)
        ``[j, i]`` is what point i adds to the derivative at joint j.

    See Also
    --------
    follow_rules : The same for `CardinalBasis`.

    Examples
    --------
    >>> from curvecore import bessel_velocities, estimation_matrix
    >>> estimation_matrix(bessel_velocities, [0, 1, 2]).tolist()
    [[-1.5, 2.0, -0.5], [-0.5, 0.0, 0.5], [0.5, -2.0, 1.5]]
    """
    t = parameter_row(parameters)
    return rule(np.eye(len(t)), t)


def follow_rules(parameters: ArrayLike, *rules: Rule) -> Follow:
    """Return the `Follow` of an open curve without corners.

    Parameters
    ----------
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    *rules : callable
        One for each kind of derivative: ``rule(points, parameters)``, linear in the points.

    Returns
    -------
    callable
        What `CardinalBasis` takes.

    See Also
    --------
    CardinalBasis : What takes it.
    estimation_matrix : What a rule does.

    Examples
    --------
    >>> from curvecore import CardinalBasis, HermiteCurve, bessel_velocities, follow_rules
    >>> curve = HermiteCurve([[0], [1], [9]], [[0], [0], [0]], [0, 1, 2])
    >>> CardinalBasis(curve, follow_rules(curve.parameters, bessel_velocities)).follows
    True
    """
    t = parameter_row(parameters)

    def follow(moves: FloatArray) -> tuple[FloatArray, FloatArray]:
        derivatives = np.stack([rule(moves, t) for rule in rules], axis=1)
        return derivatives, derivatives

    return follow
