"""Bending a curve: the least change of its data that puts c(t*) where it is pulled to.

The changes in proportion to the hold that the data have on the curve (`hold`) are exact at frozen parameters.
Where points change and a rule gives the parameters, or estimates derivatives from the points, the curve
answers differently: the grabbed point is then held at its share of its segment. A piecewise curve is
corrected by Broyden's method, so that only the segment's own data change; where that leads nowhere, and
where there are points alone, all of which move anyway, a shift of all points takes over what the bend cannot
do (`bend_together`). So the grabbed point always follows, however far.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from curvecore.arrays import FloatArray

from ...document.jet_edits import JetValue, with_jet_values
from ...document.kept_handles import with_handles_kept
from ...document.lines import ends_of, line_beside
from ...document.model import Curve, Vector
from ..basis.basis_view import weights_at
from ..curve.curve_view import CurveView, view_of
from ..geometry import segment_at, size_of
from .bend_together import QuadraticCost, broyden, divided, slope_at_rest
from .hold import BendWith, required_hold

_ROUNDING, _LEAST_SUM = 1e-9, 0.1
"""The most by which a sum of functions is off 1 by rounding, and the least by which a shift is divided."""

_MAX_STEPS = 8


class Bend:
    """A curve grabbed at one place; made at the press, it bends the curve at every move.

    Parameters
    ----------
    view
        A current view.
    t
        The grabbed place, inside the domain.
    using
        The data that may change.

    Raises
    ------
    EditError
        If the data that may change have no hold on the curve at `t`.
    """

    def __init__(self, view: CurveView, t: float, using: BendWith) -> None:
        assert view.curve is not None
        self._view, self._hold = view, required_hold(view, t, using)
        self._segment = segment_at(view.parameters, t)
        start, end = view.parameters[self._segment : self._segment + 2]
        self._share = (t - start) / (end - start)
        self._start = view.curve.evaluate(t)
        self._size = size_of(view.points)

    def bent(self, target: Vector, tolerance: float) -> Curve:
        """Return the curve with its grabbed point pulled to `target`.

        Parameters
        ----------
        target
            The place for that point.
        tolerance
            Largest distance to `target`, in the plane, where a rule makes the answer inexact.
        """
        pull = np.array(target) - self._start
        source = self._view.source
        moves_points = self._hold.changes[0].value.order == 0
        moves_parameters = moves_points and source.parametrization.kind.asks_where_points_are
        follow = moves_points and source.family.derivatives
        if not (moves_parameters or follow):
            if not self._is_held_by_lines:
                return self._curve(pull)  # exact
            along = self._solved(pull, tolerance)
            return self._curve(pull if along is None else along)
        alone = self._solved(pull, tolerance) if source.family.derivatives else None
        return self._curve(alone) if alone is not None else self._bent_and_shifted(pull)

    @cached_property
    def _is_held_by_lines(self) -> bool:
        """Whether a straight segment beside the grabbed one gives a handle in this its direction."""
        curve, (start, end) = self._view.source, ends_of(self._view.source, self._segment)
        return any(
            curve.points[index].tied and line_beside(curve, index, ahead=ahead)
            for index, ahead in ((start, False), (end, True))
        )

    def _bent_and_shifted(self, pull: FloatArray) -> Curve:
        of_points = sum(change.rate for change in self._hold.changes if change.value.order == 0)
        price = self._hold.price**2
        cost = QuadraticCost(1 / self._hold.strength, price * of_points, price * len(self._view.points))
        shares = divided(self._moved_by, pull, cost, self._size, self._slope)
        return self._curve(shares.bend, shares.shift / self._moved_by_all(shares.bend))

    @cached_property
    def _slope(self) -> FloatArray:
        return slope_at_rest(self._moved_by, self._size)

    def _solved(self, pull: FloatArray, tolerance: float) -> FloatArray | None:
        """Return the bend that moves the grabbed point by `pull`, None where no few steps lead to it.

        Broyden, Mathematics of Computation 19 (1965) 577–593: the Jacobian of the answer begins as the
        identity, which it is at frozen parameters, and learns from every step.
        """
        at, miss, slope, step = np.zeros(2), pull, np.eye(2), pull
        for _ in range(_MAX_STEPS):
            moved = self._moved_by(at + step)
            if moved is None or math.hypot(*(pull - moved)) > 2 * math.hypot(*miss):
                # Too far for what the Jacobian knows; a shorter step is more like it.
                step = step / 2
                continue
            left = pull - moved
            if math.hypot(*left) <= tolerance:
                return at + step
            slope = broyden(slope, step, miss - left)
            at, miss = at + step, left
            step = np.linalg.pinv(slope) @ miss
        return None

    def _after(self, bend: FloatArray) -> tuple[CurveView, float] | None:
        """Return the curve after a bend and the parameter of the grabbed point, None without a curve."""
        view = view_of(self._curve(bend), self._view)
        if not view.is_current:
            return None
        start, end = view.parameters[self._segment : self._segment + 2].tolist()
        return view, start + self._share * (end - start)

    def _moved_by(self, bend: FloatArray) -> FloatArray | None:
        """Return how far the grabbed point goes with a bend, None without a curve."""
        if (after := self._after(bend)) is None:
            return None
        view, t = after
        assert view.curve is not None
        moved: FloatArray = view.curve.evaluate(t) - self._start
        return moved

    def _moved_by_all(self, bend: FloatArray) -> float:
        """Return how far the grabbed point goes, after a bend, for every unit that all points are moved.

        1 where the functions add up to 1; not every family's do.
        """
        after = self._after(bend)
        total = float(weights_at(*after).sum()) if after is not None else 1.0
        return total if abs(total - 1.0) > _ROUNDING and total > _LEAST_SUM else 1.0

    def _curve(self, bend: FloatArray, shift: FloatArray | None = None) -> Curve:
        """Return the curve after a bend, and a shift of all points with it."""
        x, y = bend.tolist()
        changed = with_jet_values(self._view.source, [each.after(x, y) for each in self._hold.changes])
        curve = with_handles_kept(self._view.source, changed)
        if shift is None:
            return curve
        every = [
            JetValue(index, 0, True, (point.x + float(shift[0]), point.y + float(shift[1])))
            for index, point in enumerate(curve.points)
        ]
        return with_jet_values(curve, every)
