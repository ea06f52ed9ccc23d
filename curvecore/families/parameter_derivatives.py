"""Derivatives of a curve with respect to its parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, parameter_row
from curvecore.families.part import CurvePart

if TYPE_CHECKING:
    from curvecore.families.curve import ParametricCurve

_STEP = 2.0**-13
"""Share of the distance of neighbouring parameters by which one is moved for a difference quotient."""


class ParameterDerivatives(CurvePart):
    """A part of `ParametricCurve`: derivatives by differences, unless the family has a formula."""

    __slots__ = ()

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i at fixed t and data, for all i.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            A scalar counts as m = 1.

        Returns
        -------
        ndarray, shape (m, n, dim)
            Per unit of t. Here by differences of curves with moved parameters, to some nine digits; the
            ends are moved outwards only, for a basis may end where they are.
        """
        at = parameter_row(t)
        moves = [_difference(self._this, at, index) for index in range(len(self._this.parameters))]
        return np.stack(moves, axis=1)

    def parameter_derivative(self, index: int, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i of one i.

        Parameters
        ----------
        index : int
            i, from 0 to n - 1.
        t : float or array_like, shape (m,)
            A scalar counts as m = 1.

        Returns
        -------
        ndarray, shape (m, dim)
            As from `parameter_derivatives`.
        """
        return self.parameter_derivatives(t)[:, index]

    def local_parameter_derivatives(self, t: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the segments of t, and dc(t)/dt_i of their two ends, where `is_local`.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Finite.

        Returns
        -------
        segment : ndarray of int, shape (m,)
            Between which joints each t lies.
        moves : ndarray, shape (m, 2, dim)
            Of the two joints.
        """
        segment = self._this.local_basis(t).segment
        moves = self.parameter_derivatives(t)
        return segment, np.take_along_axis(moves, (segment[:, None] + np.arange(2))[:, :, None], axis=1)


def _difference(curve: ParametricCurve, t: FloatArray, index: int) -> FloatArray:
    """Return dc(t)/dt_index, shape (m, dim), to some nine digits.

    An end is moved outwards only, for a basis may end where it is.
    """
    joints = curve.parameters
    gap = float(np.diff(joints[max(index - 1, 0) : index + 2]).min())
    step = gap * _STEP

    def moved(by: float) -> FloatArray:
        places = joints.copy()
        places[index] += by * step
        return curve.with_data(curve.jets, places).evaluate(t)

    if 0 < index < len(joints) - 1:
        # Of order 4: what is left out is the fifth derivative.
        return (8.0 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12.0 * step)
    outwards = -1.0 if index == 0 else 1.0
    here, one, two, three = (moved(outwards * k) for k in range(4))
    return outwards * (-11.0 * here + 18.0 * one - 9.0 * two + 2.0 * three) / (6.0 * step)
