"""Bending a curve: the least change of its data that puts c(t*) where it is pulled to.

A curve is linear in its data, c(t) = Σ b_i d_i with the weights b_i = B_ir(t). Of all changes δd with
Σ b_i δd_i = Δ the one of least norm is δd = b (b·b)⁻¹ Δ. For a piecewise curve the norm is taken of what a
person drags, the Bézier control points that the data at the ends of the segment carry, also those of its
neighbours; and a way of the curve's own points counts more than one of handles: these give way where they
can, points that were placed with care move least, and a small pull here is no large swing next door.

That is exact at frozen parameters. Where points change and a rule gives the parameters, or estimates
derivatives from the points, the curve answers differently: the grabbed point is then held at its share of its
segment. A piecewise curve is corrected by Broyden's method, so that only the segment's own data change; where
that leads nowhere, and where there are points alone, all of which move anyway, a shift of all points takes
over what the bend cannot do (`bend_together`). So the grabbed point always follows, however far.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import Enum
from functools import cached_property

import msgspec
import numpy as np

from app.document.edits import EditError
from app.document.jet_edits import JetValue, with_jet_values
from app.document.kept_handles import with_handles_kept
from app.document.model import Curve, ParametrizationKind, Vector
from app.view_model.basis_view import weights_at
from app.view_model.bend_together import QuadraticCost, divided, slope_at_rest
from app.view_model.curve_view import CoreCurve, CurveView, parameters_of, view_of
from curvecore import CurveError
from curvecore.arrays import FloatArray

_LEAST_HOLD = 1e-4
"""b·b below which the data have no hold on the curve: they would change a hundred times as much as it."""

_PRICE_OF_POINTS = 5.0
"""What a way of a point on the curve costs, that of a handle being 1, where it is grabbed far from the point.

More would keep points better and swing the segments next door more: they share the velocity.
"""

_NEAR = 0.25
"""The share of a segment within which a point is the cheaper the nearer it is: handles do not swing there."""

_ROUNDING, _LEAST_SUM = 1e-9, 0.1
"""How far a sum of functions is off 1 by rounding, and the least by which a shift is divided."""

_MAX_STEPS = 8

_FIXED = (ParametrizationKind.UNIFORM, ParametrizationKind.CHEBYSHEV, ParametrizationKind.MANUAL)
"""Rules that give the same parameters wherever the points lie."""


class BendWith(Enum):
    """The data that a bend changes, in words."""

    ALL = "points and derivatives change"
    POINTS = "only points change"
    DERIVATIVES = "only derivatives change"


class _Datum(msgspec.Struct, frozen=True):
    """One datum: its value, and by how much it changes for every unit that the curve moves at t*."""

    index: int
    order: int
    ahead: bool
    value: Vector
    change: float

    def moved(self, x: float, y: float) -> JetValue:
        value = (self.value[0] + x * self.change, self.value[1] + y * self.change)
        return JetValue(self.index, self.order, self.ahead, value)


class _Hold(msgspec.Struct, frozen=True):
    """The data that may change, and the hold they have on the curve: Σ b_i² of what the norm is taken of.

    `price` is what the way of a point counts in that norm.
    """

    data: tuple[_Datum, ...]
    strength: float
    price: float = 1.0


class _Place(msgspec.Struct, frozen=True):
    """A place on a curve that outlasts a change of parameters: a segment and the share of it."""

    segment: int
    share: float

    def t(self, parameters: FloatArray) -> float:
        start, end = parameters[self.segment], parameters[self.segment + 1]
        return float(start + self.share * (end - start))


def _required_hold(view: CurveView, t: float, using: BendWith) -> _Hold:
    family = view.source.family
    if not (family.derivatives and family.is_local):
        hold = _hold_of_points(view, t, range(len(view.source.points)))
    else:
        segment = _place_of(view, t).segment
        if using is BendWith.POINTS:
            hold = _hold_of_points(view, t, (segment, segment + 1))
        else:
            hold = _hold_of_segment(view, t, segment, ends_stay=using is BendWith.DERIVATIVES)
    if hold.strength < _LEAST_HOLD:
        what = "The derivatives have" if using is BendWith.DERIVATIVES else "The points have"
        raise EditError(f"{what} no hold on the curve so close to a point; grab it farther away.")
    return hold


def _hold_of_points(view: CurveView, t: float, knots: Sequence[int]) -> _Hold:
    """Return the hold of points at `knots`; derivatives that are estimated follow them."""
    of_points = weights_at(view, t)
    weights = [of_points[view.owner(knot)] for knot in range(len(view.parameters))]
    strength = float(sum(weights[knot] ** 2 for knot in knots))
    return _Hold(
        tuple(
            _datum(view, knot, 0, float(weights[knot]) / strength if strength else 0.0, ahead=True)
            for knot in knots
        ),
        strength,
    )


def _hold_of_segment(view: CurveView, t: float, segment: int, *, ends_stay: bool) -> _Hold:
    """Return the hold of the points and derivatives at the ends of a segment, or of the derivatives alone."""
    assert view.basis_curve is not None
    basis = view.basis_curve.basis(np.array([t]))[0]
    h = float(np.diff(view.parameters)[segment])
    share = (t - float(view.parameters[segment])) / h
    ends = [
        _end(view, knot, basis[knot], h if ahead else -h, None if ends_stay else _price(way))
        for knot, ahead, way in ((segment, True, share), (segment + 1, False, 1.0 - share))
    ]
    strength = sum(end.strength for end in ends)
    data = (
        _datum(view, end.knot, order, change / strength if strength else 0.0, ahead=end.ahead)
        for end in ends
        for order, change in enumerate(end.changes, start=int(ends_stay))
    )
    return _Hold(tuple(data), strength, _PRICE_OF_POINTS)


class _End(msgspec.Struct, frozen=True):
    """One end of the segment: how its data change for every unit of force, and the hold they have."""

    knot: int
    ahead: bool
    changes: list[float]
    strength: float


def _price(share: float) -> float:
    """Return the price of the point at the end of a segment, grabbed at this share of it from there."""
    return 1.0 + (_PRICE_OF_POINTS - 1.0) * min(share / _NEAR, 1.0)


def _end(view: CurveView, knot: int, weights: FloatArray, h: float, price: float | None) -> _End:
    """Return what least change the data at `knot` answer with; h < 0 where the segment lies behind.

    Without a price the point stays.
    The change is measured by the ways of the Bézier control points that depend on them, on both sides of a
    smooth point: a handle that is short here may be a long one there.
    """
    kinds, ahead = view.source.family.derivatives + 1, h > 0
    scales = h ** np.arange(kinds)
    rows = [(price or 0.0) * np.eye(kinds)[0], *_control_rows(kinds, 1.0)]
    index = view.owner(knot)
    beyond = None if index in view.corners else view.spacing(index, ahead=not ahead)
    if beyond:
        rows += _control_rows(kinds, -beyond / abs(h))
    first = int(price is None)
    norm = np.array(rows)[:, first:]
    force = (weights / scales)[first:]
    # The data of unit h, so that nothing depends on the unit of time.
    changes = np.linalg.solve(norm.T @ norm, force)
    return _End(knot, ahead, (changes / scales[first:]).tolist(), float(force @ changes))


def _control_rows(kinds: int, h: float) -> list[FloatArray]:
    """Return the control points behind the first as combinations of the data at the start of a segment."""
    degree = 2 * kinds - 1
    return [
        np.array([math.comb(j, order) * h**order / math.perm(degree, order) for order in range(kinds)])
        for j in range(1, kinds)
    ]


def _place_of(view: CurveView, t: float) -> _Place:
    parameters = view.parameters
    segment = int(np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2))
    start, end = parameters[segment : segment + 2]
    return _Place(segment, float((t - start) / (end - start)))


def _datum(view: CurveView, knot: int, order: int, change: float, *, ahead: bool) -> _Datum:
    index = view.owner(knot)
    value = (
        view.source.points[index].position,
        view.velocity_of(index, ahead=ahead),
        view.acceleration_of(index, ahead=ahead),
    )[order]
    assert value is not None
    return _Datum(index, order, ahead, value, change)


class Bend:
    """A curve grabbed at one place; made at the press, it bends the curve at every move.

    Parameters
    ----------
    view
        A current view.
    t
        Where it is grabbed, inside the domain.
    using
        Which data may change.

    Raises
    ------
    EditError
        If the data that may change have no hold on the curve at `t`.
    """

    def __init__(self, view: CurveView, t: float, using: BendWith) -> None:
        assert view.curve is not None
        self._view, self._place = view, _place_of(view, t)
        self._hold = _required_hold(view, t, using)
        self._data = self._hold.data
        self._start = view.curve.evaluate(t)
        self._size = float(np.ptp(view.points, axis=0).max())

    def bent(self, target: Vector, tolerance: float) -> Curve:
        """Return the curve with its grabbed point pulled to `target`.

        Parameters
        ----------
        target
            Where that point is to lie.
        tolerance
            Largest distance to `target`, in the plane, where a rule makes the answer inexact.
        """
        pull = np.array(target) - self._start
        source = self._view.source
        of_points_alone = not source.family.derivatives
        moves_no_parameter = all(datum.order for datum in self._data) or source.parametrization.kind in _FIXED
        if moves_no_parameter and (of_points_alone or self._data[0].order):
            return self._curve(pull)  # exact
        alone = None if of_points_alone else self._solved(pull, tolerance)
        return self._curve(alone) if alone is not None else self._bent_and_shifted(pull)

    def _bent_and_shifted(self, pull: FloatArray) -> Curve:
        of_points = sum(datum.change for datum in self._data if datum.order == 0)
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
        at, miss, inverse, step = np.zeros(2), pull, np.eye(2), pull
        for _ in range(_MAX_STEPS):
            moved = self._moved_by(at + step)
            if moved is None or _length(pull - moved) > 2 * _length(miss):
                # Too far for what the Jacobian knows; a shorter step is more like it.
                step = step / 2
                continue
            left = pull - moved
            if _length(left) <= tolerance:
                return at + step
            inverse = _broyden(inverse, step, miss - left)
            at, miss = at + step, left
            step = inverse @ miss
        return None

    def _moved_by(self, bend: FloatArray) -> FloatArray | None:
        """Return how far the grabbed point goes with a bend, None without a curve."""
        if not self._view.source.family.derivatives:
            return self._points_moved_by(bend)
        view = view_of(self._curve(bend), self._view)
        if view.curve is None or not view.is_current:
            return None
        moved: FloatArray = view.curve.evaluate(self._place.t(view.parameters)) - self._start
        return moved

    def _points_moved_by(self, bend: FloatArray) -> FloatArray | None:
        """Return the same where there are points alone: twice as fast as by way of a document."""
        curve = self._through_points(bend)
        if curve is None:
            return None
        moved: FloatArray = curve.evaluate(self._place.t(curve.parameters)) - self._start
        return moved

    def _moved_by_all(self, bend: FloatArray) -> float:
        """Return how far the grabbed point goes, after a bend, for every unit that all points are moved.

        1 where the functions add up to 1; not every family's do.
        """
        curve = None if self._view.source.family.derivatives else self._through_points(bend)
        if curve is None:
            return 1.0
        total = float(curve.basis(self._place.t(curve.parameters)).sum())
        return total if abs(total - 1.0) > _ROUNDING and total > _LEAST_SUM else 1.0

    def _through_points(self, bend: FloatArray) -> CoreCurve | None:
        """Return the curve through the points after a bend, where there are points alone."""
        view = self._view
        points = view.points + np.outer([each.change for each in self._data], bend)
        if view.source.is_closed:
            points = np.vstack([points, points[:1]])
        try:
            parameters = parameters_of(view.source, points, view.arrays.times)
            return view.source.family.make(points[:, None], parameters)
        except CurveError:
            return None

    def _curve(self, bend: FloatArray, shift: FloatArray | None = None) -> Curve:
        """Return the curve after a bend, and a shift of all points with it."""
        changed = with_jet_values(self._view.source, [datum.moved(*bend.tolist()) for datum in self._data])
        curve = with_handles_kept(self._view.source, changed)
        if shift is None:
            return curve
        every = [
            JetValue(index, 0, True, (point.x + float(shift[0]), point.y + float(shift[1])))
            for index, point in enumerate(curve.points)
        ]
        return with_jet_values(curve, every)


def _length(v: FloatArray) -> float:
    return float(np.hypot(*v))


def _broyden(inverse: FloatArray, step: FloatArray, answer: FloatArray) -> FloatArray:
    """Return the inverse Jacobian that also explains that `step` gave `answer` (Sherman and Morrison)."""
    predicted = inverse @ answer
    weight = float(step @ predicted)
    if abs(weight) < 1e-12 * _length(step) * _length(predicted):
        return inverse
    updated: FloatArray = inverse + np.outer(step - predicted, step @ inverse) / weight
    return updated
