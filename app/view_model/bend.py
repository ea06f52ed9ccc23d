"""Bending a curve: the least change of its data that puts c(t*) where it is pulled to.

A curve is linear in its data, c(t) = Σ b_i d_i with the weights b_i = B_ir(t). Of all changes δd with
Σ b_i δd_i = Δ the one of least norm is δd = b (b·b)⁻¹ Δ. Derivatives enter the norm as h·v and h²·a, h the
length of the segment: then everything is a length in the plane.

That is exact at frozen parameters. Where points change and a rule gives the parameters, or estimates
derivatives from the points, the curve answers a little differently; the pull is then corrected until the
grabbed point, at its share of its segment, is where it should be.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum, auto

import msgspec
import numpy as np

from app.document.edits import EditError
from app.document.jet_edits import JetValue, with_jet_values
from app.document.model import Curve, Family, Vector
from app.view_model.curve_view import CurveView, Floats, view_of

_LEAST_HOLD = 1e-4
"""b·b below which the data have no hold on the curve: they would change a hundred times as much as it."""

_MAX_STEPS = 16


class BendWith(Enum):
    """Which data may change."""

    ALL = auto()
    POINTS = auto()
    DERIVATIVES = auto()


class _Datum(msgspec.Struct, frozen=True):
    """One datum with its weight at t* and its value, both scaled to lengths in the plane."""

    index: int
    order: int
    ahead: bool
    weight: float
    value: Vector
    scale: float

    def moved(self, x: float, y: float) -> JetValue:
        value = (self.value[0] + x / self.scale, self.value[1] + y / self.scale)
        return JetValue(self.index, self.order, self.ahead, value)


class _Place(msgspec.Struct, frozen=True):
    """A place on a curve that outlasts a change of parameters: a segment and the share of it."""

    segment: int
    share: float

    def t(self, parameters: Floats) -> float:
        start, end = parameters[self.segment], parameters[self.segment + 1]
        return float(start + self.share * (end - start))


def bent(view: CurveView, t: float, target: Vector, using: BendWith, tolerance: float) -> Curve:
    """Return the curve of `view` with its point at `t` pulled to `target`.

    Parameters
    ----------
    view
        A current view.
    t
        Where it was grabbed, inside the domain.
    target
        Where that point is to lie.
    using
        Which data may change.
    tolerance
        Largest distance to `target`, in the plane, where a rule makes the answer inexact.

    Raises
    ------
    EditError
        If the data that may change have no hold on the curve at `t`, or cannot pull it there.
    """
    assert view.curve is not None
    data = _data_at(view, t, using)
    _require_hold(data, using)
    place = _place_of(view, t)
    pull = np.array(target) - view.curve.evaluate(t)
    return _Answer(view, data, place, np.array(target)).solve(pull, tolerance)


def least_change(view: CurveView, t: float, pull: Vector, using: BendWith) -> list[JetValue]:
    """Return the data after the least change that moves c(t) by `pull` at frozen parameters."""
    data = _data_at(view, t, using)
    _require_hold(data, using)
    return _moved(data, np.array(pull))


def _moved(data: Sequence[_Datum], pull: Floats) -> list[JetValue]:
    total = sum(each.weight**2 for each in data)
    return [each.moved(*(pull * (each.weight / total)).tolist()) for each in data]


def _require_hold(data: Sequence[_Datum], using: BendWith) -> None:
    if sum(each.weight**2 for each in data) < _LEAST_HOLD:
        what = "The derivatives have" if using is BendWith.DERIVATIVES else "The points have"
        raise EditError(f"{what} no hold on the curve so close to a point; grab it farther away.")


def _place_of(view: CurveView, t: float) -> _Place:
    parameters = view.parameters
    segment = int(np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2))
    start, end = parameters[segment : segment + 2]
    return _Place(segment, float((t - start) / (end - start)))


def _data_at(view: CurveView, t: float, using: BendWith) -> list[_Datum]:
    assert view.skeleton is not None
    weights = view.skeleton.basis(np.array([t]))[0]
    if view.source.family is Family.LAGRANGE:
        return [
            _Datum(index, 0, True, float(weight), view.source.nodes[index].position, 1.0)
            for index, weight in enumerate(weights[:, 0])
        ]
    segment = _place_of(view, t).segment
    h = float(view.parameters[segment + 1] - view.parameters[segment])
    return [
        _datum(view, segment + 1 - ahead, order, ahead=bool(ahead), weights=weights, h=h)
        for ahead in (1, 0)
        for order in _orders(view, using)
    ]


def _orders(view: CurveView, using: BendWith) -> Sequence[int]:
    derivatives = range(1, view.source.family.derivatives + 1)
    return {BendWith.ALL: (0, *derivatives), BendWith.POINTS: (0,), BendWith.DERIVATIVES: derivatives}[using]


def _datum(view: CurveView, knot: int, order: int, *, ahead: bool, weights: Floats, h: float) -> _Datum:
    index, scale = view.owner(knot), h**order
    if order == 0:
        value: Vector | None = view.source.nodes[index].position
    else:
        value = (
            view.velocity_of(index, ahead=ahead) if order == 1 else view.acceleration_of(index, ahead=ahead)
        )
    assert value is not None
    return _Datum(index, order, ahead, float(weights[knot, order]) / scale, value, scale)


class _Answer:
    """How the grabbed point answers a pull; solved by Broyden's method from the frozen answer.

    Broyden, Mathematics of Computation 19 (1965) 577–593: the Jacobian of the answer begins as the
    identity, which it is at frozen parameters, and learns from every step.
    """

    def __init__(self, view: CurveView, data: Sequence[_Datum], place: _Place, target: Floats) -> None:
        self._view, self._data, self._place, self._target = view, data, place, target

    def solve(self, pull: Floats, tolerance: float) -> Curve:
        """Return the curve whose grabbed point is within `tolerance` of the target."""
        at, miss, inverse, step = np.zeros(2), pull, np.eye(2), pull
        for _ in range(_MAX_STEPS):
            tried = self._try(at + step)
            if tried is None or _length(tried[1]) > 2 * _length(miss):
                # Too far for what the Jacobian knows; a shorter step is more like it.
                step = step / 2
                continue
            curve, left = tried
            if _length(left) <= tolerance:
                return curve
            inverse = _broyden(inverse, step, miss - left)
            at, miss = at + step, left
            step = inverse @ miss
        raise EditError(
            "This rule for the parameters does not let the curve follow that far; freeze them first."
        )

    def _try(self, pull: Floats) -> tuple[Curve, Floats] | None:
        """Return the curve after a pull and how far its point is from the target, None without a curve."""
        curve = with_jet_values(self._view.source, _moved(self._data, pull))
        view = view_of(curve)
        if view.curve is None or not view.is_current:
            return None
        return curve, self._target - view.curve.evaluate(self._place.t(view.parameters))


def _length(v: Floats) -> float:
    return float(np.hypot(*v))


def _broyden(inverse: Floats, step: Floats, answer: Floats) -> Floats:
    """Return the inverse Jacobian that also explains that `step` gave `answer` (Sherman and Morrison)."""
    predicted = inverse @ answer
    weight = float(step @ predicted)
    if abs(weight) < 1e-12 * _length(step) * _length(predicted):
        return inverse
    updated: Floats = inverse + np.outer(step - predicted, step @ inverse) / weight
    return updated
