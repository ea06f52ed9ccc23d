"""The quintic Hermite curve."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import data_array, point_array
from curvecore.families.curve import JointDerivatives
from curvecore.families.hermite_basis import QUINTIC
from curvecore.families.piecewise_hermite import PiecewiseHermite
from curvecore.vectors import vector_lengths


class QuinticHermiteCurve(PiecewiseHermite):
    """Quintic pieces with given velocities and accelerations.

    Twice continuously differentiable; c'''(t) may jump at the joints.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    velocities : array_like, shape (n, dim)
        v_i = c'(t_i), per unit of t. Copied.
    accelerations : array_like, shape (n, dim)
        a_i = c''(t_i), per unit of t squared. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Attributes
    ----------
    points : ndarray, shape (n, dim)
        Read-only.
    parameters : ndarray, shape (n,)
        Read-only.
    jets : ndarray, shape (n, 3, dim)
        Points, velocities and accelerations; read-only.
    domain : (float, float)
        t_0 and t_(n-1).
    degree : int
        5.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    Notes
    -----
    Accuracy and limits are those of `HermiteCurve`.
    """

    __slots__ = ()

    name = "quintic_hermite"
    title = "quintic Hermite"
    derivatives = 2
    _functions = QUINTIC

    def __init__(
        self,
        points: ArrayLike,
        velocities: ArrayLike,
        accelerations: ArrayLike,
        parameters: ArrayLike,
    ) -> None:
        position = point_array(points)
        velocity = data_array(velocities, "velocities", position.shape)
        acceleration = data_array(accelerations, "accelerations", position.shape)
        self._set(np.stack((position, velocity, acceleration), axis=1), parameters)

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c, c', c'' at the ends of all segments: what is given."""
        here = self._jets[1:] if before else self._jets[:-1]
        return JointDerivatives(here, vector_lengths(here))
