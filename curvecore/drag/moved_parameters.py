"""Lagrange basis functions after a few parameters have moved, from those before.

L_i is a product over all parameters. Where one of them, t_k, moves to t'_k,
one factor of its numerator and one of its denominator become others:

    L'_i(t) = L_i(t) (t - t'_k) / (t - t_k) (t_i - t_k) / (t_i - t'_k)    i != k
    L'_k(t) = L_k(t) prod_(j != k) (t_k - t_j) / (t'_k - t_j)

so that known values at m places become those for the new parameters in O(n m)
multiplications. Every factor is a quotient of differences of given numbers:
k moved parameters add about 7 k + 2 n / 1000 roundings, relative to the value
itself. The curve alone takes less: see `left_out`.
"""

from __future__ import annotations

import numpy as np

from curvecore.arithmetic import LIMIT, SMALLEST
from curvecore.arrays import FloatArray, IntArray, parameter_row
from curvecore.families.curve import ParametricCurve
from curvecore.families.lagrange import LagrangeCurve

_MOST_MOVED = 4  # parameters, above which the saving is gone


class MovedParameters:
    """The basis of one curve at fixed places, and of others whose parameters are nearly the same.

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
            weights, own = self._weights(curve, moved), self._own(curve, moved)
            # l'(t) / l(t); without meaning where some t is one of the moved parameters.
            ratio = np.reciprocal(own).prod(axis=1)
            if not self._serves(weights):
                return None
            values = self._basis * weights
            values *= ratio[:, None]
            values[:, moved] *= own
            places, rows = self._rows_at_moved(curve, moved, weights)
            values[places] = rows
            # Looking at every value is dear; mostly the factors tell that none can be too large.
            bound = self._greatest * np.abs(weights).max() * np.abs(ratio).max() * max(np.abs(own).max(), 1.0)
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

    def _own(self, curve: ParametricCurve, moved: IntArray) -> FloatArray:
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
        """Return the places t that are moved parameters, old or new, and the functions there, (k, n).

        The quotients above are 0 / 0 there. At the old place of t_k, L_i(t) / (t - t_k) tends to
        (w_i / w_k) / (t_k - t_i).
        """
        old, new = self._parameters, curve.parameters
        places, rows = [], []
        for k in moved.tolist():
            for place in np.flatnonzero(self._t == new[k]).tolist():
                places.append(place)
                rows.append(np.eye(1, len(new), k)[0])
            for place in np.flatnonzero((self._t == old[k]) & ~np.isin(self._t, new)).tolist():
                row = self._curve.weight_ratios(k) * weights / (old[k] - old) * (old[k] - new[k])
                row[k] = weights[k]
                for m in moved[moved != k].tolist():
                    row *= (old[k] - new[m]) / (old[k] - old[m])
                    row[m] *= (old[k] - old[m]) / (old[k] - new[m])
                places.append(place)
                rows.append(row)
        return np.array(places, dtype=np.intp), np.array(rows).reshape(-1, len(new))
