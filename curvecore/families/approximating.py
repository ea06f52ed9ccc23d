"""Points of a curve that it may pass by, and what its parameters do then."""

from __future__ import annotations

from typing import Self

import numpy as np

from curvecore.arrays import BoolArray, FloatArray
from curvecore.families.part import CurvePart


class Approximating(CurvePart):
    """A part of `ParametricCurve`: curves pass their points and need all t_i, unless a family says else."""

    __slots__ = ()

    @property
    def passes_points(self) -> bool:
        """Whether c(t_i) is p_i: what the family says by `interpolates`, measured where that may be wrong."""
        return self._this.interpolates

    @property
    def knot_points(self) -> FloatArray:
        """The points c(t_i), shape (n, dim): p_i, or beside these."""
        curve = self._this
        return curve.points if self.passes_points else curve.evaluate(curve.parameters)

    @property
    def places(self) -> FloatArray:
        """The parameters near which the points act most, shape (n,): t_i, of control points others."""
        return self._this.parameters

    @property
    def idle_parameters(self) -> BoolArray:
        """Whether the curve stays what it is when t_i alone changes, shape (n,)."""
        return np.zeros(len(self._this.parameters), dtype=bool)

    def refined(self, t: float) -> Self | None:
        """Return the same curve with one more control point, for more detail near t.

        Parameters
        ----------
        t : float
            Inside the domain.

        Returns
        -------
        ParametricCurve or None
            None where that is done by one more point on the curve, or cannot be done.
        """
        return None

    def restricted(self, start: float, end: float) -> Self | None:
        """Return the same curve on a stretch of its domain, as one of its own family.

        Parameters
        ----------
        start, end : float
            Inside the domain, start < end.

        Returns
        -------
        ParametricCurve or None
            None where that takes the data at both ends of the stretch alone, or cannot be done.
        """
        return None
