"""The cubic Hermite curve."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import stacked_jets
from curvecore.bezier.control_points import cubic_path
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.hermite_basis import CUBIC
from curvecore.families.piecewise_hermite import PiecewiseHermite

_SMOOTH = 1e-6
"""Share of the largest velocity by which those on both sides of a joint may differ, by differences."""


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

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    QuinticHermiteCurve : With accelerations too.
    bessel_velocities, natural_spline_velocities, catmull_rom_velocities : Rules for the velocities.

    Notes
    -----
    Values and derivatives have errors of at most a small multiple of
    u sum |B_ir^(order)(t) d_ir|, u = 2**-53. Results beyond the floating
    point range become the largest finite number.

    Examples
    --------
    >>> from curvecore import HermiteCurve
    >>> curve = HermiteCurve([[0, 0], [1, 0]], [[0, 3], [0, -3]], [0, 1])
    >>> curve
    HermiteCurve(n=2, dim=2, domain=(0, 1))
    >>> curve([0, 0.5, 1]).round(9).tolist()
    [[0.0, 0.0], [0.5, 0.75], [1.0, 0.0]]
    >>> curve.bezier_pieces().tolist()
    [[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]]
    """

    __slots__ = ()

    name = "hermite"
    title = "Hermite"
    full_title = "cubic Hermite"
    place = 20
    derivatives = 1
    follows = True
    _functions = CUBIC

    def __init__(self, points: ArrayLike, velocities: ArrayLike, parameters: ArrayLike) -> None:
        self._keep(stacked_jets(points, velocities=velocities), parameters)

    @classmethod
    def near(cls, curve: ParametricCurve, tolerance: float) -> ParametricCurve:
        """Return cubic pieces with a curve's points and velocities at their ends; see `ParametricCurve`."""
        if curve.has_exact_pieces:
            return cls.same_shape_as(curve)
        path = cubic_path(curve, tolerance)
        ends, spacing = path.control_points, np.diff(path.parameters)[:, None]
        ahead, behind = 3.0 * (ends[:, 1] - ends[:, 0]) / spacing, 3.0 * (ends[:, 3] - ends[:, 2]) / spacing
        turns = np.abs(behind[:-1] - ahead[1:])
        if (turns > _SMOOTH * np.abs(ahead).max()).any():
            raise CurveError(
                f"its direction jumps at t = {path.parameters[1:-1][turns.max(axis=1).argmax()]:g}"
            )
        points = np.concatenate((ends[:, 0], ends[-1:, 3]))
        return cls(points, np.concatenate((ahead, behind[-1:])), path.parameters)
