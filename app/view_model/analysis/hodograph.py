"""The hodograph: the velocity, or the acceleration, as a curve in the plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from curvecore.arrays import FloatArray

from ..curve.curve_view import CurveView
from .plot_samples import derivatives_of, samples_over

_SAMPLES = 600


@dataclass(frozen=True, eq=False)
class Hodograph:
    """A derivative of a curve as points of the plane.

    Attributes
    ----------
    order
        1 for c', 2 for c''.
    t, points
        Ascending parameters (m,) and the derivative there (m, 2); NaN between the two sides of a jump.
    knots
        The derivative at the knots, (k, 2), after each joint; at the last knot before it.
    """

    order: int
    t: FloatArray
    points: FloatArray
    knots: FloatArray

    @property
    def reach(self) -> float:
        """The largest coordinate, 0 for none."""
        finite = self.points[np.isfinite(self.points)]
        return float(np.abs(finite).max(initial=0.0))


def hodograph_of(view: CurveView, order: int) -> Hodograph:
    """Return the hodograph of a current curve."""
    samples = samples_over(view, (float(view.parameters[0]), float(view.parameters[-1])), _SAMPLES)
    points = derivatives_of(view, samples.t, (order,))[order]
    (t, x), (_, y) = (samples.broken_at_jumps(points[:, axis], points) for axis in (0, 1))
    knots = derivatives_of(view, view.parameters, (order,))[order]
    return Hodograph(order, t, np.column_stack([x, y]), knots)


def derivative_at(view: CurveView, t: float, order: int) -> tuple[float, float]:
    """Return the derivative of a current curve at one t; at a joint, that of the segment after it."""
    x, y = derivatives_of(view, np.array([t]), (order,))[order][0].tolist()
    return x, y
