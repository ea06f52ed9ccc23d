"""The quintic Hermite curve."""

from __future__ import annotations

from numpy.typing import ArrayLike

from curvecore.arrays import stacked_jets
from curvecore.families.hermite_basis import QUINTIC
from curvecore.families.piecewise_hermite import PiecewiseHermite


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

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    HermiteCurve : With velocities alone.
    natural_spline_accelerations, zero_accelerations : Rules for the accelerations.

    Notes
    -----
    Accuracy and limits are those of `HermiteCurve`.

    Examples
    --------
    >>> from curvecore import QuinticHermiteCurve
    >>> curve = QuinticHermiteCurve([[0], [1]], [[0], [0]], [[0], [0]], [0, 1])
    >>> curve
    QuinticHermiteCurve(n=2, dim=1, domain=(0, 1))
    >>> curve([0, 0.5, 1]).round(9).tolist()
    [[0.0], [0.5], [1.0]]
    >>> curve(0.5, order=1).round(9).tolist()
    [1.875]
    """

    __slots__ = ()

    name = "quintic_hermite"
    title = "quintic Hermite"
    place = 30
    derivatives = 2
    _functions = QUINTIC

    def __init__(
        self,
        points: ArrayLike,
        velocities: ArrayLike,
        accelerations: ArrayLike,
        parameters: ArrayLike,
    ) -> None:
        self._keep(stacked_jets(points, velocities=velocities, accelerations=accelerations), parameters)
