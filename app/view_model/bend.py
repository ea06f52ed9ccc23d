"""Bending a curve: the least change of its data that puts c(t*) where it is pulled to.

`Bend` is made at the press and bends the curve at every move; `Hold` says how much each datum changes;
`divided` divides a pull between a bend and a shift of all points.

A curve is linear in its data, c(t) = Σ b_i d_i with the weights b_i = B_ir(t). Of all changes δd with
Σ b_i δd_i = Δ the one of least norm is δd = b (b·b)⁻¹ Δ. For a piecewise curve the norm is taken of what a
person drags, the Bézier control points that the data at the ends of the segment carry, also those of its
neighbours; and an offset of the curve's own points counts more than one of handles: these give way where they
can, points that were placed with care move least, and a small pull here is no large swing next door.

These changes are exact at frozen parameters. Where points change and a rule gives the parameters, or
estimates derivatives from the points, the curve answers differently: the grabbed point is then held at its
share of its segment. A piecewise curve is corrected by Broyden's method, so that only the segment's own data
change; where that leads nowhere, and where there are points alone, all of which move anyway, a shift of all
points takes over what the bend cannot do. So the grabbed point always follows, however far.

For that c(t*) answers to a bend u = (ux, uy) with some F(u), not with u, and far away there may be no u at
all with the answer that is wanted. Every rule lets a shift m of all points pass unchanged, though, so u and
m = Δ − F(u) together always meet a pull Δ, whatever u. Of these the one of least norm is wanted,

    a |u|² + 2 b u·m + n |m|²,      a = Σ w_i²,   b = the sum of w_i over the points,   n points,

where the bend changes datum i by w_i u. That is a problem of least squares in two unknowns, solved by the
damped Gauss-Newton method (Nocedal & Wright, Numerical Optimization, 2006, pp. 258–262) with a Jacobian that
begins as differences and is kept up to date by Broyden's rule. It begins from u = 0 every time, so the
result depends on the pull alone and not on the moves before; and it may stop early, for every u is exact.

Close to a point handles have little hold: a cubic's goes 1/(3s) times as far as the place at the share s of
the segment, and a pull of 60 pixels, 13 beside a point, made a loop with handles of 270. There the grabbed
place falls behind the pointer: within a tenth of a segment the handles move as at the tenth, and within a
quarter of it freely by a third of the segment, beyond that ever less, the closer to the point the less.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from enum import Enum
from functools import cached_property

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ..document.constraints import ends_of, is_straight_beside, with_handles_kept
from ..document.limits import EditError
from ..document.model import Curve, Vector
from ..document.point_edits import JetValue, with_jet_values
from .basis import weights_at
from .curve.curve_view import CurveView, view_of
from .geometry import segment_at, size_of

_ROUNDING, _LEAST_SUM = 1e-9, 0.1
"""Largest rounding of a sum of functions from 1, and the least sum by which a shift is divided."""

_MAX_STEPS = 8


class Bend:
    """A curve grabbed at one point; created at the press, it bends the curve at every move.

    Parameters
    ----------
    view
        A current view.
    t
        The grabbed parameter, inside the domain.
    using
        The data that may change.

    Raises
    ------
    EditError
        If the data that may change have no effect on the curve at `t`.
    """

    def __init__(self, view: CurveView, t: float, using: BendWith) -> None:
        self._view, self._hold = view, required_hold(view, t, using)
        self._segment = segment_at(view.parameters, t)
        start, end = view.parameters[self._segment : self._segment + 2]
        self._share = (t - start) / (end - start)
        self._start = view.present_curve.evaluate(t)
        self._size = size_of(view.points)
        nearness = 1.0 - min(self._share, 1.0 - self._share) / _DAMPED_SHARE
        self._damping = _DAMPING * max(nearness, 0.0) if self._hold.offset else 0.0

    def _excess(self, pull: FloatArray) -> float:
        """Return the offset of the handles beyond the one that is free, in lengths of the segment."""
        return max(self._hold.offset * math.hypot(*pull) / self._length - _FREE_OFFSET, 0.0)

    @cached_property
    def _length(self) -> float:
        """The length of the segment."""
        start, end = self._view.parameters[self._segment : self._segment + 2].tolist()
        steps = np.diff(self._view.present_curve.evaluate(np.linspace(start, end, _SAMPLES)), axis=0)
        return float(np.hypot(*steps.T).sum()) or math.inf

    def is_limited(self, target: Vector) -> bool:
        """Return whether the grabbed place falls behind the pointer, so that handles stay short."""
        pull = np.array(target) - self._start
        return self._hold.is_clamped or bool(self._damping and self._excess(pull))

    def bent(self, target: Vector, tolerance: float) -> Curve:
        """Return the curve with its grabbed point pulled to `target`.

        Parameters
        ----------
        target
            The new position of that point.
        tolerance
            Largest distance to `target`, in the plane, where a rule makes the result inexact.
        """
        pull = np.array(target) - self._start
        source = self._view.source
        moves_points = self._hold.changes[0].value.order == 0
        moves_parameters = moves_points and source.parametrization.kind.depends_on_points
        follow = moves_points and source.family.derivatives
        if not (moves_parameters or follow):
            if self._damping:
                pull = pull / (1.0 + self._damping * self._excess(pull))
            if self._hold.is_clamped or not self._is_held_by_lines:
                return self._curve(pull)  # exact for this pull, unless the hold is clamped
            along = self._solved(pull, tolerance)
            return self._curve(pull if along is None else along)
        alone = self._solved(pull, tolerance) if source.family.derivatives else None
        return self._curve(alone) if alone is not None else self._bent_and_shifted(pull)

    @cached_property
    def _is_held_by_lines(self) -> bool:
        """Whether a straight segment beside the grabbed one fixes the direction of a handle."""
        curve, (start, end) = self._view.source, ends_of(self._view.source, self._segment)
        return any(
            curve.points[index].tied and is_straight_beside(curve, index, ahead=ahead)
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
        """Return the bend that moves the grabbed point by `pull`, None where a few steps do not lead to it.

        Broyden, Mathematics of Computation 19 (1965) 577–593: the Jacobian of the answer begins as the
        identity, which it is at frozen parameters, and is updated at every step.
        """
        at, miss, slope, step = np.zeros(2), pull, np.eye(2), pull
        for _ in range(_MAX_STEPS):
            moved = self._moved_by(at + step)
            if moved is None or math.hypot(*(pull - moved)) > 2 * math.hypot(*miss):
                # Too far for the Jacobian; it holds better for a shorter step.
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
        """Return the move of the grabbed point by a bend, None without a curve."""
        if (after := self._after(bend)) is None:
            return None
        view, t = after
        return view.present_curve.evaluate(t) - self._start

    def _moved_by_all(self, bend: FloatArray) -> float:
        """Return the move of the grabbed point, after a bend, per unit by which all points move.

        It is 1 where the functions add up to 1, which those of some families do not.
        """
        after = self._after(bend)
        total = float(weights_at(*after).sum()) if after is not None else 1.0
        return total if abs(total - 1.0) > _ROUNDING and total > _LEAST_SUM else 1.0

    def _curve(self, bend: FloatArray, shift: FloatArray | None = None) -> Curve:
        """Return the curve after a bend, and a shift of all points with it."""
        x, y = bend.tolist()
        changed = with_jet_values(self._view.source, [change.after(x, y) for change in self._hold.changes])
        curve = with_handles_kept(self._view.source, changed)
        if shift is None:
            return curve
        every = [
            JetValue(index, 0, True, (point.x + float(shift[0]), point.y + float(shift[1])))
            for index, point in enumerate(curve.points)
        ]
        return with_jet_values(curve, every)


# A pull divided between a bend and a shift

_STEPS = 3
_FIRST_STAGE = 0.5
_MOST_STAGES = 40  # 3**40 times the curve: beyond, the first of them is a longer one
_SMALL_STEP = 1e-2
_DIFFERENCE = 1e-4
_LEAST_DAMPING, _FIRST_DAMPING = 1e-9, 1e-3


class Shares(msgspec.Struct, frozen=True):
    """A pull divided into a bend of the curve and a shift of all its points."""

    bend: FloatArray
    shift: FloatArray


class QuadraticCost(msgspec.Struct, frozen=True):
    """The squared norm of a bend u and a shift m together: a |u|² + 2 b u·m + n |m|²."""

    a: float
    b: float
    n: float

    def of(self, u: FloatArray, m: FloatArray) -> float:
        """Return the cost."""
        return float(self.a * (u @ u) + 2 * self.b * (u @ m) + self.n * (m @ m))

    def step(self, u: FloatArray, m: FloatArray, slope: FloatArray, damping: float) -> FloatArray:
        """Return the damped Gauss-Newton step from u, where a bend by du shifts by −slope du less."""
        cross = self.b * slope
        normal = self.a * np.eye(2) - cross - cross.T + self.n * (slope.T @ slope)
        normal[[0, 1], [0, 1]] *= 1 + damping
        (p, q), (_, r) = normal.tolist()
        x, y = (slope.T @ (self.b * u + self.n * m) - self.a * u - self.b * m).tolist()
        determinant = p * r - q * q
        if not determinant > 0.0:
            return np.zeros(2)
        return np.array([(r * x - q * y) / determinant, (p * y - q * x) / determinant])


def divided(
    answer: Callable[[FloatArray], FloatArray | None],
    pull: FloatArray,
    cost: QuadraticCost,
    size: float,
    slope: FloatArray,
) -> Shares:
    """Return a pull divided so that bend and shift together are nearly the least change.

    Parameters
    ----------
    answer
        The move (2,) of the grabbed point by a bend (2,); None where there is no curve.
    pull
        The move that is wanted, (2,).
    cost
        The norm of a change.
    size
        The size of the curve.
    slope
        From `slope_at_rest`; it serves for every pull.
    """
    search = _Search(answer, cost, slope)
    for share in _stages(float(np.hypot(*pull)) / size):
        search.improve(share * pull)
    return Shares(search.bend, pull - search.answer)


def _stages(length: float) -> list[float]:
    """Return the shares of a pull to solve in turn: a far pull in steps of three times as far each.

    No shares where the curve is so small beside the pull that their ratio overflows: then it is shifted.
    """
    if not 0.0 < length < math.inf:
        return []
    steps = math.ceil(math.log(length / _FIRST_STAGE, 3)) if length > _FIRST_STAGE else 0
    return [3.0**-step for step in range(min(steps, _MOST_STAGES), -1, -1)]


class _Search:
    """The best bend so far, its answer, and the Jacobian there."""

    def __init__(
        self, answer: Callable[[FloatArray], FloatArray | None], cost: QuadraticCost, slope: FloatArray
    ) -> None:
        self._answer, self._cost, self._slope = answer, cost, slope
        self.bend, self.answer = np.zeros(2), np.zeros(2)
        self._damping = _FIRST_DAMPING

    def improve(self, pull: FloatArray) -> None:
        """Take steps towards the least change that meets `pull`."""
        least = self._cost.of(self.bend, pull - self.answer)
        self._damping = min(self._damping, _FIRST_DAMPING)
        for _ in range(_STEPS):
            step = self._cost.step(self.bend, pull - self.answer, self._slope, self._damping)
            if step @ step <= _SMALL_STEP**2 * (pull @ pull):
                return
            bend = self.bend + step
            answer = self._answer(bend)
            cost = math.inf if answer is None else self._cost.of(bend, pull - answer)
            if answer is not None:
                self._slope = broyden(self._slope, step, answer - self.answer)
            if answer is not None and cost < least:
                self.bend, self.answer, least = bend, answer, cost
                self._damping = max(self._damping / 10, _LEAST_DAMPING)
            else:
                self._damping = max(self._damping, _FIRST_DAMPING) * 100


def slope_at_rest(answer: Callable[[FloatArray], FloatArray | None], size: float) -> FloatArray:
    """Return the Jacobian of `answer` at no bend, by differences; where there is none, the identity."""
    h = _DIFFERENCE * size
    columns = [answer(np.array(unit) * h) for unit in ((1.0, 0.0), (0.0, 1.0))]
    if columns[0] is None or columns[1] is None:
        return np.eye(2)
    return np.column_stack([columns[0], columns[1]]) / h


def broyden(slope: FloatArray, step: FloatArray, answer: FloatArray) -> FloatArray:
    """Return the Jacobian that also explains that `step` gave `answer`."""
    return slope + np.outer(answer - slope @ step, step) / (step @ step)


# The hold of the data on the curve

_LEAST_HOLD = 1e-4
"""b·b below which the data count as having no effect: they would change a hundred times as much."""

_LEAST_SHARE, _DAMPED_SHARE = 0.1, 0.25
"""Shares of a segment: handles act as if grabbed no closer to a point than the first; up to the second they
are damped."""

_FREE_OFFSET, _DAMPING = 1 / 3, 2.0
"""Offset of handles that is not damped, in lengths of the segment, and the greatest damping beyond that: with
less than 3 a longer pull is a longer offset, and with 2 that stays below half of the segment at the point."""

_SAMPLES = 17

_PRICE_OF_POINTS = 5.0
"""The cost of an offset of a point on the curve grabbed far from it, against 1 for a handle.

A higher cost would keep points better and swing the neighbouring segments more: they share the velocity.
"""

_NEAR = 0.25
"""Share of a segment within which a nearer point costs less: handles do not swing there."""


class BendWith(Enum):
    """The data that a bend changes, in words."""

    ALL = "the points move as well"
    POINTS = "only the points move"
    DERIVATIVES = "the points stay"


class DatumChange(msgspec.Struct, frozen=True):
    """A value of the document, and its change per unit by which the curve moves at t."""

    value: JetValue
    rate: float

    def after(self, x: float, y: float) -> JetValue:
        """Return the value after a move of the curve."""
        before = self.value.value
        return replace(self.value, value=(before[0] + x * self.rate, before[1] + y * self.rate))


class Hold(msgspec.Struct, frozen=True):
    """The changes of the data, and the strength of their effect on the curve: Σ b_i² in the norm.

    `price` is the cost of the offset of a point in that norm, `offset` the greatest offset of a handle of
    the segment per unit of the pull, 0 where points move. One that `is_clamped` acts as if grabbed farther
    away from the point.
    """

    changes: tuple[DatumChange, ...]
    strength: float
    price: float = 1.0
    offset: float = 0.0
    is_clamped: bool = False


def has_handles(view: CurveView) -> bool:
    """Whether a curve can be bent between its points while the points stay."""
    family = view.source.family
    return bool(family.derivatives) and family.curve_class.is_local


def required_hold(view: CurveView, t: float, using: BendWith) -> Hold:
    """Return the hold of the data that may change on a current curve at `t`.

    Raises
    ------
    EditError
        If their effect is too weak.
    """
    segment = segment_at(view.parameters, t)
    if not has_handles(view):
        hold = _hold_of_points(view, t, range(len(view.source.points)))
    elif using is BendWith.POINTS:
        hold = _hold_of_points(view, t, (segment, segment + 1))
    else:
        hold = _hold_of_segment(view, t, segment, ends_stay=using is BendWith.DERIVATIVES)
    if hold.strength < _LEAST_HOLD:
        if using is BendWith.DERIVATIVES:
            raise EditError(
                "Handles cannot bend the curve so close to a point. Hold Alt to move the point with it."
            )
        raise EditError(
            "Points cannot bend the curve so close to a point. Drag it farther away from the point."
        )
    if hold.offset:
        start, end = view.parameters[segment : segment + 2].tolist()
        away = _LEAST_SHARE * (end - start)
        held = min(max(t, start + away), end - away)
        if held != t:
            return replace(_hold_of_segment(view, held, segment, ends_stay=True), is_clamped=True)
    return hold


def _hold_of_points(view: CurveView, t: float, knots: Sequence[int]) -> Hold:
    """Return the hold of points at `knots`; derivatives that are estimated follow them."""
    of_points = weights_at(view, t).tolist()
    weights = [(knot, of_points[view.owner(knot)]) for knot in knots]
    strength = sum(weight**2 for _, weight in weights)
    return Hold(tuple(_change(view, knot, 0, weight, strength) for knot, weight in weights), strength)


def _hold_of_segment(view: CurveView, t: float, segment: int, *, ends_stay: bool) -> Hold:
    """Return the hold of the points and derivatives at the ends of a segment, or of the derivatives alone."""
    assert view.basis_curve is not None
    basis = view.basis_curve.basis(np.array([t]))[0]
    start, end = view.parameters[segment : segment + 2].tolist()
    h, strength, offset, data = end - start, 0.0, 0.0, []
    for knot, ahead, distance in ((segment, True, t - start), (segment + 1, False, end - t)):
        price = None if ends_stay else 1.0 + (_PRICE_OF_POINTS - 1.0) * min(distance / h / _NEAR, 1.0)
        rates, force, offsets = _least_change(view, knot, basis[knot], h if ahead else -h, price)
        strength, offset = strength + float(force @ rates), max(offset, float(np.abs(offsets).max()))
        data += [(knot, order, rate, ahead) for order, rate in enumerate(rates.tolist(), int(ends_stay))]
    changes = (_change(view, knot, order, rate, strength, ahead=ahead) for knot, order, rate, ahead in data)
    offset = offset / strength if ends_stay and strength else 0.0
    return Hold(tuple(changes), strength, _PRICE_OF_POINTS, offset)


def _least_change(
    view: CurveView, knot: int, weights: FloatArray, h: float, price: float | None
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the changes of the data at `knot` per unit of force, the effect per unit of each, and offsets.

    The offsets are those of the control points of the segment. h < 0 where it lies behind. Without a price
    the point stays. The change is measured by the offsets of the Bézier control points that depend on the
    data, on both sides of a smooth point: a handle that is short on one side may be long on the other.
    """
    kinds, first = len(weights), int(price is None)
    # The data of unit h, so that nothing depends on the unit of time.
    scales = h ** np.arange(kinds)
    rows = [(price or 0.0) * np.eye(kinds)[:1], _control_rows(kinds, 1.0)]
    index = view.owner(knot)
    beyond = None if view.arrays.corners[index] else view.spacing(index, ahead=h < 0)
    if beyond:
        rows.append(_control_rows(kinds, -beyond / abs(h)))
    norm = np.vstack(rows)[:, first:]
    change = np.linalg.solve(norm.T @ norm, (weights / scales)[first:])
    return change / scales[first:], weights[first:], rows[1][:, first:] @ change


def _control_rows(kinds: int, h: float) -> FloatArray:
    """Return the control points behind the first as combinations of the data at the start of a segment."""
    orders, degree = range(kinds), 2 * kinds - 1
    terms = [[math.comb(j, order) / math.perm(degree, order) for order in orders] for j in orders[1:]]
    return np.asarray(terms * h ** np.arange(kinds))


def _change(
    view: CurveView, knot: int, order: int, rate: float, strength: float, *, ahead: bool = True
) -> DatumChange:
    index = view.owner(knot)
    values = view.points[index]
    if order and view.sides is not None:
        values = view.sides[ahead][index, order]
    x, y = values.tolist()
    return DatumChange(JetValue(index, order, ahead, (x, y)), rate / strength if strength else 0.0)
