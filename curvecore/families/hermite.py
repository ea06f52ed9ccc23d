"""The cubic Hermite curve."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import data_array, point_array
from curvecore.families.curve import JointDerivatives
from curvecore.families.hermite_basis import CUBIC
from curvecore.families.piecewise_hermite import PiecewiseHermite
from curvecore.vectors import vector_lengths


class HermiteCurve(PiecewiseHermite):
    """Cubic pieces with given velocities.

    Continuously differentiable; c''(t) may jump at the joints.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    velocities : array_like, shape (n, dim)
        v_i = c'(t_i), per unit of t. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Attributes
    ----------
    points : ndarray, shape (n, dim)
        Read-only.
    parameters : ndarray, shape (n,)
        Read-only.
    jets : ndarray, shape (n, 2, dim)
        Points and velocities; read-only.
    domain : (float, float)
        t_0 and t_(n-1).
    degree : int
        3.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    Notes
    -----
    Values and derivatives have errors of at most a small multiple of
    u sum |B_ir^(order)(t) d_ir|, u = 2**-53. Results beyond the floating
    point range become the largest finite number.
    """

    __slots__ = ()

    name = "hermite"
    title = "Hermite"
    full_title = "cubic Hermite"
    derivatives = 1
    _functions = CUBIC

    def __init__(self, points: ArrayLike, velocities: ArrayLike, parameters: ArrayLike) -> None:
        position = point_array(points)
        velocity = data_array(velocities, "velocities", position.shape)
        self._set(np.stack((position, velocity), axis=1), parameters)

    def joint_derivatives(self, *, before: bool) -> JointDerivatives:
        """Return c, c', c'' at the ends of all segments: points and velocities exactly."""
        jets, h = self._jets, np.diff(self._parameters)[:, None]
        here = jets[1:] if before else jets[:-1]
        chord = 6.0 * (np.diff(jets[:, 0], axis=0) / h) / h
        own, other = 4.0 * here[:, 1] / h, 2.0 * (jets[:-1] if before else jets[1:])[:, 1] / h
        acceleration = own + other - chord if before else chord - own - other
        scale = vector_lengths(chord) + vector_lengths(own) + vector_lengths(other)
        values = np.stack((here[:, 0], here[:, 1], acceleration), axis=1)
        return JointDerivatives(values, np.column_stack((vector_lengths(here), scale)))
