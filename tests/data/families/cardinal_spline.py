"""The cardinal spline: a class as small as a family can be, with a setting of real numbers."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.families.curve import ParametricCurve
from curvecore.families.hermite import hermite_functions
from curvecore.families.setting import FamilySetting


class CardinalSplineCurve(ParametricCurve):
    """Cubic pieces with velocities from the neighbours.

    v_i = (1 - tension) (p_(i+1) - p_(i-1)) / (t_(i+1) - t_(i-1)); at the ends the point itself is the
    neighbour that is not there.
    """

    name, title, degree = "cardinal_spline", "cardinal spline", 3
    settings = (
        FamilySetting(
            "tension",
            "tension",
            0.0,
            "0: Catmull-Rom; 1: rests in every point",
            limits=(-1.0, 1.0),
            step=0.05,
        ),
    )

    @property
    def breaks(self) -> FloatArray:
        """The parameters: the acceleration jumps there."""
        return self.parameters

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return B of shape (m, n): the Hermite functions times what the points do to the velocities."""
        functions = hermite_functions(t, self.parameters, order)
        return functions[:, :, 0] + functions[:, :, 1] @ self._velocities_per_point()

    def _velocities_per_point(self) -> FloatArray:
        t, n = self.parameters, len(self.parameters)
        i = np.arange(n)
        behind, ahead = np.maximum(i - 1, 0), np.minimum(i + 1, n - 1)
        share = (1.0 - float(self.chosen["tension"])) / (t[ahead] - t[behind])
        matrix = np.zeros((n, n))
        matrix[i, ahead] += share
        matrix[i, behind] -= share
        return matrix
