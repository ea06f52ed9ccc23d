"""Derivatives of a curve with respect to its parameters, by differences of curves with moved ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from curvecore.arrays import FloatArray

if TYPE_CHECKING:
    from curvecore.families.curve import ParametricCurve

_STEP = 2.0**-13
"""Share of the distance of neighbouring parameters by which one is moved for a difference quotient."""


def parameter_difference(curve: ParametricCurve, t: FloatArray, index: int) -> FloatArray:
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
