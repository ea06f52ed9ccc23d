"""The hold of a curve's data on one of its points: by how much each changes for every unit that it is moved.

A curve is linear in its data, c(t) = Σ b_i d_i with the weights b_i = B_ir(t). Of all changes δd with
Σ b_i δd_i = Δ the one of least norm is δd = b (b·b)⁻¹ Δ. For a piecewise curve the norm is taken of what a
person drags, the Bézier control points that the data at the ends of the segment carry, also those of its
neighbours; and a way of the curve's own points counts more than one of handles: these give way where they
can, points that were placed with care move least, and a small pull here is no large swing next door.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import Enum

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.edits import EditError
from ...document.jet_edits import JetValue
from ..basis.basis_view import weights_at
from ..curve.curve_view import CurveView
from ..geometry import segment_at

_LEAST_HOLD = 1e-4
"""b·b below which the data have no hold on the curve: they would change a hundred times as much as it."""

_PRICE_OF_POINTS = 5.0
"""The cost of a way of a point on the curve, that of a handle being 1, where it is grabbed far from it.

More would keep points better and swing the segments next door more: they share the velocity.
"""

_NEAR = 0.25
"""The share of a segment within which a point is the cheaper the nearer it is: handles do not swing there."""


class BendWith(Enum):
    """The data that a bend changes, in words."""

    ALL = "the points come along"
    POINTS = "the points alone move"
    DERIVATIVES = "the points stay"


class DatumChange(msgspec.Struct, frozen=True):
    """A value of the document, and by how much it changes for every unit that the curve moves at t."""

    value: JetValue
    rate: float

    def after(self, x: float, y: float) -> JetValue:
        """Return the value after a move of the curve."""
        before = self.value.value
        return replace(self.value, value=(before[0] + x * self.rate, before[1] + y * self.rate))


class Hold(msgspec.Struct, frozen=True):
    """The changes of the data, and the hold they have on the curve: Σ b_i² of what the norm is taken of.

    `price` is what the way of a point counts in that norm.
    """

    changes: tuple[DatumChange, ...]
    strength: float
    price: float = 1.0


def has_handles(view: CurveView) -> bool:
    """Whether a curve can be bent between its points while these stay."""
    family = view.source.family
    return bool(family.derivatives) and family.curve_class.is_local


def required_hold(view: CurveView, t: float, using: BendWith) -> Hold:
    """Return the hold of the data that may change on a current curve at `t`.

    Raises
    ------
    EditError
        If they have none.
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
                "The handles have no hold on the curve so close to a point; with Alt the point comes along."
            )
        raise EditError("The points have no hold on the curve so close to a point; grab it farther away.")
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
    h, strength, found = end - start, 0.0, []
    for knot, ahead, way in ((segment, True, t - start), (segment + 1, False, end - t)):
        price = None if ends_stay else _price(way / h)
        rates, force = _least_change(view, knot, basis[knot], h if ahead else -h, price)
        strength += float(force @ rates)
        found += [(knot, order, rate, ahead) for order, rate in enumerate(rates.tolist(), int(ends_stay))]
    changes = (_change(view, knot, order, rate, strength, ahead=ahead) for knot, order, rate, ahead in found)
    return Hold(tuple(changes), strength, _PRICE_OF_POINTS)


def _price(share: float) -> float:
    """Return the price of the point at the end of a segment, grabbed at this share of it from there."""
    return 1.0 + (_PRICE_OF_POINTS - 1.0) * min(share / _NEAR, 1.0)


def _least_change(
    view: CurveView, knot: int, weights: FloatArray, h: float, price: float | None
) -> tuple[FloatArray, FloatArray]:
    """Return how the data at `knot` change for every unit of force, and what they do per unit of each.

    h < 0 where the segment lies behind. Without a price the point stays.
    The change is measured by the ways of the Bézier control points that depend on the data, on both sides of
    a smooth point: a handle that is short here may be a long one there.
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
    force = (weights / scales)[first:]
    return np.linalg.solve(norm.T @ norm, force) / scales[first:], weights[first:]


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
