"""Lagrange curves and basis functions after a few parameters moved, from those before.

Curves (`LeftOut`) come from the curve through the points that stay. With q through those and
l(t) = prod (t - t_j) over their parameters,

    c(t) = q(t) + l(t) sum_k (p_k - q(t_k)) / l(t_k) prod_(m != k) (t - t_m) / (t_k - t_m)

with k and m over the others, wherever their t_k are: what Newton's form says of the points added last [1]_. q
and l at m parameters are computed once; each move after that is an update of rank one for every k, in
O(m + n) operations.

Basis functions take more. L_i is a product over all parameters. Where one of them, t_k, moves to t'_k, one
factor of its numerator and one of its denominator become others:

    L'_i(t) = L_i(t) (t - t'_k) / (t - t_k) (t_i - t_k) / (t_i - t'_k)    i != k
    L'_k(t) = L_k(t) prod_(j != k) (t_k - t_j) / (t'_k - t_j)

so that known values at m parameters become those for the new ones in O(n m) multiplications. Every factor is
a quotient of differences of given numbers: k moved parameters add about 7 k + 2 n / 1000 roundings, relative
to the value itself.

References
----------
.. [1] J. Stoer and R. Bulirsch, "Introduction to Numerical Analysis",
   3rd ed., Springer 2002, section 2.1.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import LIMIT, SMALLEST, UNIT_ROUNDOFF
from curvecore.arrays import FloatArray, IntArray, parameter_row
from curvecore.families.curve import ParametricCurve
from curvecore.families.lagrange import LagrangeCurve

_NEAR = 32  # parameters on either side of a left out parameter where roundings are estimated


class KeptSamples(NamedTuple):
    """A curve at given parameters.

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
    """A curve at fixed parameters while some of its points are left out and put back elsewhere.

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
        """Return a curve that this `serves` at the parameters."""
        t = curve.parameters[self._moving]
        growth = 1.0
        with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
            missing = curve.points[self._moving] - self._rest.evaluate(t)
            result = self._values.copy()
            for k, parameter in enumerate(t.tolist()):
                quotients = (self._reference - self._rest.parameters) / (parameter - self._rest.parameters)
                function = self._shape * quotients.prod()
                for other in np.delete(t, k).tolist():
                    function *= (self._t - other) / (parameter - other)
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


# Basis functions

_MOST_MOVED = 4  # parameters, above which the saving is gone


class MovedParameters:
    """The basis of one curve at fixed parameters, and of others whose parameters are nearly the same.

    Parameters
    ----------
    curve : ParametricCurve
        The interpolating polynomial of its points, before any parameter moves.
    t : array_like, shape (m,)
        Finite. The values there are kept: n m numbers.
    """

    def __init__(self, curve: ParametricCurve, t: FloatArray) -> None:
        self._curve, self._parameters = LagrangeCurve(curve.points, curve.parameters), curve.parameters
        self._t = parameter_row(t)
        self._basis = curve.basis(self._t)[:, :, 0]
        sizes = np.abs(self._basis)
        # At a parameter all functions but one are 0 in truth; elsewhere what is 0 has underflowed.
        sizes[np.isin(self._t, self._parameters)] = 1.0
        self._least, self._greatest = float(sizes.min(initial=1.0)), float(sizes.max(initial=1.0))

    def basis(self, curve: ParametricCurve) -> FloatArray | None:
        """Return the basis functions of `curve`, shape (m, n, 1), as `LagrangeCurve.basis` does.

        Returns None where `curve` has another number of parameters, or too many that moved, and where values
        are too large or too small to be made use of.
        """
        moved = self._moved(curve)
        if moved is None:
            return None
        if not len(moved):
            return self._basis[:, :, None]
        with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
            weights, of_moved = self._weights(curve, moved), self._moved_factors(curve, moved)
            # l'(t) / l(t); without meaning where some t is one of the moved parameters.
            ratio = np.reciprocal(of_moved).prod(axis=1)
            if not self._serves(weights):
                return None
            values = self._basis * weights
            values *= ratio[:, None]
            values[:, moved] *= of_moved
            columns, rows = self._rows_at_moved(curve, moved, weights)
            values[columns] = rows
            # Looking at every value is dear; mostly the factors tell that none can be too large.
            growth = max(np.abs(of_moved).max(), 1.0)
            bound = self._greatest * np.abs(weights).max() * np.abs(ratio).max() * growth
            if bound < LIMIT or np.abs(values).max() < LIMIT:
                return values[:, :, None]
        return None

    def _serves(self, weights: FloatArray) -> bool:
        """Tell whether the values before were all in range, and stay so when they are weighed."""
        return bool(self._greatest < LIMIT and self._least * np.abs(weights).min() >= SMALLEST)

    def _moved(self, curve: ParametricCurve) -> IntArray | None:
        if len(curve.parameters) != len(self._parameters):
            return None
        moved = np.flatnonzero(curve.parameters != self._parameters)
        return moved if len(moved) <= _MOST_MOVED else None

    def _moved_factors(self, curve: ParametricCurve, moved: IntArray) -> FloatArray:
        """Return the factor that the functions of moved parameters lack in l, (m, k)."""
        t = self._t[:, None]
        return (t - self._parameters[moved]) / (t - curve.parameters[moved])

    def _weights(self, curve: ParametricCurve, moved: IntArray) -> FloatArray:
        """Return w'_i / w_i, (n,)."""
        old, new = self._parameters, curve.parameters
        factors = (old[:, None] - old[moved]) / (new[:, None] - new[moved])
        factors[moved, np.arange(len(moved))] = 1.0
        ratios: FloatArray = factors.prod(axis=1)
        for k in moved.tolist():
            others = np.arange(len(old)) != k
            ratios[k] = ((old[k] - old[others]) / (new[k] - new[others])).prod()
        return ratios

    def _rows_at_moved(
        self, curve: ParametricCurve, moved: IntArray, weights: FloatArray
    ) -> tuple[IntArray, FloatArray]:
        """Return the rows t that are moved parameters, old or new, and the functions there, (k, n).

        The quotients above are 0 / 0 there. At the old t_k, L_i(t) / (t - t_k) tends to
        (w_i / w_k) / (t_k - t_i).
        """
        old, new = self._parameters, curve.parameters
        rows_of_t, rows = [], []
        for k in moved.tolist():
            for row_of_t in np.flatnonzero(self._t == new[k]).tolist():
                rows_of_t.append(row_of_t)
                rows.append(np.eye(1, len(new), k)[0])
            for row_of_t in np.flatnonzero((self._t == old[k]) & ~np.isin(self._t, new)).tolist():
                row = self._curve.weight_ratios(k) * weights / (old[k] - old) * (old[k] - new[k])
                row[k] = weights[k]
                for m in moved[moved != k].tolist():
                    row *= (old[k] - new[m]) / (old[k] - old[m])
                    row[m] *= (old[k] - old[m]) / (old[k] - new[m])
                rows_of_t.append(row_of_t)
                rows.append(row)
        return np.array(rows_of_t, dtype=np.intp), np.array(rows).reshape(-1, len(new))
