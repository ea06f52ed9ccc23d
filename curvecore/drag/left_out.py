"""A Lagrange curve a few of whose parameters move, from the curve through the points that stay.

With q through those and l(t) = prod (t - t_j) over their parameters,

    c(t) = q(t) + l(t) sum_k (p_k - q(t_k)) / l(t_k) prod_(m != k) (t - t_m) / (t_k - t_m)

with k and m over the others, wherever their t_k are: what Newton's form says
of the points added last [1]_. q and l at m places are computed once; each
move after that is an update of rank one for every k, in O(m + n) operations.

References
----------
.. [1] J. Stoer and R. Bulirsch, "Introduction to Numerical Analysis",
   3rd ed., Springer 2002, section 2.1.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import UNIT_ROUNDOFF
from curvecore.arrays import FloatArray, IntArray, parameter_row
from curvecore.families.curve import ParametricCurve
from curvecore.families.lagrange import LagrangeCurve

_NEAR = 32  # places on either side of a left out parameter where roundings are estimated


class KeptSamples(NamedTuple):
    """A curve at given places.

    Attributes
    ----------
    points : ndarray, shape (m, dim)
        Infinite or NaN beyond the range of floating point.
    rounding : float
        Estimate of the error that comes on top of the one of `LagrangeCurve.evaluate`. It grows with the gap
        that the points which stay have to bridge.
    """

    points: FloatArray
    rounding: float


class LeftOut:
    """A curve at fixed places while some of its points are left out and put back elsewhere.

    Parameters
    ----------
    curve : ParametricCurve
        The interpolating polynomial of its points, before any of them moves.
    moving : ndarray of int, shape (k,)
        Ascending indices of the points left out; at least two points stay.
    t : array_like, shape (m,)
        Finite, ascending.
    """

    def __init__(self, curve: ParametricCurve, moving: IntArray, t: FloatArray) -> None:
        self._t = parameter_row(t)
        stays = np.ones(len(curve.parameters), dtype=bool)
        stays[moving] = False
        self._stays, self._moving = stays, moving
        self._rest = LagrangeCurve(curve.points[stays], curve.parameters[stays])
        self._values = self._rest.evaluate(self._t)
        # l(t) / l(reference) is the function of a parameter there among those that stay.
        stays_or_first = stays.copy()
        stays_or_first[moving[0]] = True
        self._reference = float(curve.parameters[moving[0]])
        unit = np.zeros((len(stays), 1))
        unit[moving[0]] = 1.0
        full = LagrangeCurve(unit[stays_or_first], curve.parameters[stays_or_first])
        self._shape = full.evaluate(self._t)[:, 0]
        self._rounding = self._rounding_near(curve)

    def serves(self, curve: ParametricCurve) -> bool:
        """Tell whether `curve` differs from the one given first in nothing but the points left out."""
        return (
            len(curve.parameters) == len(self._stays)
            and np.array_equal(curve.parameters[self._stays], self._rest.parameters)
            and np.array_equal(curve.points[self._stays], self._rest.points)
        )

    def evaluate(self, curve: ParametricCurve) -> KeptSamples:
        """Return a curve that this `serves` at the places."""
        t = curve.parameters[self._moving]
        growth = 1.0
        with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
            missing = curve.points[self._moving] - self._rest.evaluate(t)
            result = self._values.copy()
            for k, place in enumerate(t.tolist()):
                quotients = (self._reference - self._rest.parameters) / (place - self._rest.parameters)
                function = self._shape * quotients.prod()
                for other in np.delete(t, k).tolist():
                    function *= (self._t - other) / (place - other)
                growth += float(np.abs(function).max(initial=0.0))
                result += function[:, None] * missing[k]
        # What is wrong with q at t_k is carried everywhere by the function of t_k.
        return KeptSamples(result, growth * self._rounding)

    def _rounding_near(self, curve: ParametricCurve) -> float:
        """Estimate the error of q where a point is missing, and the others must bridge the gap."""
        n = len(self._rest.parameters)
        near: set[int] = set()
        for index in np.searchsorted(self._t, curve.parameters[self._moving]).tolist():
            near.update(range(max(index - _NEAR, 0), min(index + _NEAR, len(self._t))))
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            sizes = np.abs(self._rest.basis(self._t[sorted(near)])[:, :, 0]) @ np.abs(self._rest.points)
        # Roundings of n factors average out; four times their square root has not been exceeded.
        return float(sizes.max(initial=0.0)) * UNIT_ROUNDOFF * (10.0 + 4.0 * float(np.sqrt(n)))
