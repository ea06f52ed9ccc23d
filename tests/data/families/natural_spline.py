"""The natural cubic spline through points: a class of the core's kind, as it would stand there."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.families.curve import ParametricCurve


class NaturalSplineCurve(ParametricCurve):
    """Cubic pieces that bend as little as can be.

    Twice continuously differentiable, with c'' = 0 at both ends.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.
    """

    __slots__ = ("_bends",)
    _caches = ("_bends",)

    name = "tests_natural_spline"
    title = "natural spline"

    _bends: FloatArray | None

    @property
    def degree(self) -> int:
        """3."""
        return 3

    @property
    def breaks(self) -> FloatArray:
        """The parameters: c''' jumps there."""
        return self._parameters

    @property
    def _second(self) -> FloatArray:
        """c'' at the parameters as a combination of the points, (n, n)."""
        if self._bends is None:
            h, n = np.diff(self._parameters), len(self._parameters)
            system, right = np.eye(n), np.zeros((n, n))
            for i in range(1, n - 1):
                system[i, i - 1 : i + 2] = h[i - 1], 2 * (h[i - 1] + h[i]), h[i]
                right[i, i - 1 : i + 2] = 6 / h[i - 1], -6 / h[i - 1] - 6 / h[i], 6 / h[i]
            self._bends = np.linalg.solve(system, right)
        return self._bends

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return all basis functions, or their derivatives with respect to t; see `ParametricCurve`."""
        x, n = self._parameters, len(self._parameters)
        i = np.clip(np.searchsorted(x, t, side="right") - 1, 0, n - 2)
        h, s, r = np.diff(x)[i], t - x[i], x[i + 1] - t
        value, bend = np.zeros((len(t), 2)), np.zeros((len(t), 2))
        if order == 0:
            value = np.column_stack([r / h, s / h])
            bend = np.column_stack([r**3 / (6 * h) - h * r / 6, s**3 / (6 * h) - h * s / 6])
        elif order == 1:
            value = np.column_stack([-1 / h, 1 / h])
            bend = np.column_stack([h / 6 - r**2 / (2 * h), s**2 / (2 * h) - h / 6])
        elif order == 2:
            bend = np.column_stack([r / h, s / h])
        elif order == 3:
            bend = np.column_stack([-1 / h, 1 / h])
        result = bend[:, :1] * self._second[i] + bend[:, 1:] * self._second[i + 1]
        rows = np.arange(len(t))
        result[rows, i] += value[:, 0]
        result[rows, i + 1] += value[:, 1]
        return result[:, :, None]
