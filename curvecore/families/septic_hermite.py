"""The septic Hermite curve."""

from __future__ import annotations

from numpy.typing import ArrayLike

from curvecore.arrays import stacked_jets
from curvecore.families.hermite_forms import left_functions
from curvecore.families.piecewise_hermite import PiecewiseHermite


class SepticHermiteCurve(PiecewiseHermite):
    """Septic pieces with given velocities, accelerations and jerks.

    Three times continuously differentiable; the fourth derivative, the snap, may jump at the joints. Of all
    motions with these data at both ends of a segment its integral of |c''''|**2 is the least [1]_.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    velocities : array_like, shape (n, dim)
        v_i = c'(t_i), per unit of t. Copied.
    accelerations : array_like, shape (n, dim)
        a_i = c''(t_i), per unit of t squared. Copied.
    jerks : array_like, shape (n, dim)
        j_i = c'''(t_i), per unit of t cubed. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    QuinticHermiteCurve : Without the jerks.
    natural_spline_jerks : A rule for the jerks.

    Notes
    -----
    Accuracy and limits are those of `HermiteCurve`.

    References
    ----------
    .. [1] D. Mellinger and V. Kumar, "Minimum snap trajectory generation and control for quadrotors", IEEE
       International Conference on Robotics and Automation 2011, 2520-2525.

    Examples
    --------
    >>> from curvecore import SepticHermiteCurve
    >>> rest = [[0], [0]]
    >>> curve = SepticHermiteCurve([[0], [1]], rest, rest, rest, [0, 1])
    >>> curve
    SepticHermiteCurve(n=2, dim=1, domain=(0, 1))
    >>> curve(0.5, order=1).tolist()
    [2.1875]
    """

    __slots__ = ()

    name = "septic_hermite"
    title = "septic Hermite"
    place = 50
    derivatives = 3
    _functions = left_functions(4)

    def __init__(
        self,
        points: ArrayLike,
        velocities: ArrayLike,
        accelerations: ArrayLike,
        jerks: ArrayLike,
        parameters: ArrayLike,
    ) -> None:
        jets = stacked_jets(points, velocities=velocities, accelerations=accelerations, jerks=jerks)
        self._keep(jets, parameters)
