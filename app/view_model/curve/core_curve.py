"""The core's curve through the points of a document's curve, under its rules.

`core_curve` makes it. Of a Hermite curve its data are the derivatives that the person set and the estimates
of the rules for the rest, `Sides`. A corner divides the curve into pieces, and each piece is estimated for
itself; a closed curve without a corner is estimated as the periodic curve it is. Where the velocities at a
point are tied the curve is smooth, and the estimates go through.

`Cardinals` are the cardinal functions of the points, estimates included. `refusal_of` puts a refusal of the
core into the program's words: the core counts arguments and indices, as its callers do, while a person sees
points, their t and the numbers typed.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from functools import cached_property, partial
from itertools import pairwise
from typing import NamedTuple

import msgspec
import numpy as np
from numpy.typing import ArrayLike

import curvecore
from curvecore import Chain, CurveError, ParametricCurve, lebesgue_constant, parametrization
from curvecore.analysis.cardinal import REACH, CardinalBasis
from curvecore.arithmetic import LARGEST
from curvecore.arrays import BoolArray, FloatArray, IntArray, parameter_array
from curvecore.parametrization import Spaced

from ...document.derivatives import DERIVATIVES, EstimateRule
from ...document.model import Curve, ParametrizationKind, Point
from ...document.words import with_minus
from ..geometry import at_knots
from .point_arrays import PointArrays


class CoreCurve(msgspec.Struct, frozen=True, eq=False):
    """The core's curve, or the problem why there is none, and its jets; see the properties of `CurveView`."""

    curve: ParametricCurve | None
    problem: str = ""
    is_overdue: bool = False
    sides: Sides | None = None


def core_curve(
    curve: Curve,
    points: FloatArray,
    parameters: FloatArray,
    arrays: PointArrays,
    frozen: ParametricCurve | None = None,
) -> CoreCurve:
    """Return the core curve through points at its knots, and its jets where the family has derivatives.

    `frozen` is a curve of the family with these parameters, and without corners.
    """
    make = partial(curve.family.make, settings=curve.settings_in_effect)
    if not curve.family.derivatives:
        jets = points[:, None]
        return CoreCurve(make(jets, parameters) if frozen is None else frozen.with_jets(jets))
    sides = sides_of(curve, points, parameters, arrays)
    last = len(parameters) - 1
    jumps = [knot for knot in two_sided_knots(arrays, last + 1) if 0 < knot < last]
    # Where tied velocities are the same, nothing jumps: a curve of many such points stays in one piece.
    ties = arrays.ties
    corners = [
        knot for knot in jumps if not ties[knot] or not np.array_equal(sides.before[knot], sides.after[knot])
    ]
    if frozen is not None and not corners:
        return CoreCurve(frozen.with_jets(_piece_jets(sides, 0, last)), sides=sides)
    pieces = [
        make(_piece_jets(sides, start, end), parameters[start : end + 1])
        for start, end in pairwise([0, *corners, last])
    ]
    return CoreCurve(pieces[0] if len(pieces) == 1 else Chain(pieces), sides=sides)


def core_or_last(
    curve: Curve, arrays: PointArrays, last: ParametricCurve | None, frozen: ParametricCurve | None = None
) -> CoreCurve:
    """Return the core curve of a curve, or the last one with the reason where there is none.

    `frozen` is a core curve with the same functions and parameters, where only points have moved.
    """
    knots = at_knots(arrays.positions, closed=curve.is_closed)
    try:
        parameters = frozen.parameters if frozen is not None else checked_parameters(curve, knots, arrays)
        return core_curve(curve, knots, parameters, arrays, frozen)
    except CurveError as problem:
        return CoreCurve(last, refusal_of(problem, curve))


def _piece_jets(sides: Sides, start: int, end: int) -> FloatArray:
    jets = np.array(sides.after[start : end + 1])
    jets[-1] = sides.before[end]
    return jets


def parameters_of(curve: Curve, points: FloatArray, times: FloatArray | None = None) -> FloatArray:
    """Return the parameters that the rule of `curve` gives for the points at its knots, (k,).

    `times` are the manual parameters of its points, where they are at hand.
    """
    rule = curve.parametrization
    if rule.kind is ParametrizationKind.MANUAL:
        if times is None:
            times = np.array([np.nan if point.t is None else point.t for point in curve.points])
        return np.append(times, rule.end) if curve.is_closed else times
    given = {"count": len(points), "points": points, "alpha": rule.alpha}
    rule_of_the_core = getattr(parametrization, rule.kind.value)
    shares: FloatArray = rule_of_the_core(*(given[name] for name in rule.kind.takes))
    return parametrization.spread(shares, rule.start, rule.end)


def checked_parameters(curve: Curve, knots: FloatArray, arrays: PointArrays) -> FloatArray:
    """Return the parameters of the knots, refused where they are not strictly increasing."""
    # Refused as a whole: a piece between two corners would count from its own beginning.
    return parameter_array(parameters_of(curve, knots, arrays.times), len(knots))


# Derivatives at the knots

Estimate = Callable[[FloatArray, ArrayLike], FloatArray]

_REACH = 64
"""Knots after which an estimate has forgotten the data: a natural spline forgets half at every knot."""


class Sides(NamedTuple):
    """The jets at the knots, before and after each; they differ only at corners. Shapes (k, R, 2)."""

    before: FloatArray
    after: FloatArray


def sides_of(curve: Curve, points: FloatArray, parameters: FloatArray, arrays: PointArrays) -> Sides:
    """Return the jets of `curve` at its knots, whose points (k, 2) and parameters (k,) are given."""
    before = np.zeros((len(points), curve.family.derivatives + 1, 2))
    before[:, 0] = points
    after = before.copy()
    corners = _dividing_knots(arrays, len(points))
    has_given = not np.isnan(arrays.given).all()
    for order, rule in enumerate(curve.rules, start=1):
        estimate = _estimate_by(rule, curve)
        is_given = [_is_given(arrays, side, order, len(points)) for side in (0, 1)] if has_given else None
        _estimate(
            before[:, order],
            after[:, order],
            points,
            parameters,
            corners,
            estimate,
            curve.is_closed,
            is_given,
        )
        for side, jets in enumerate((before, after) if has_given else ()):
            rows = _given_rows(arrays, side, order, len(jets))
            jets[rows, order] = arrays.given[rows % len(arrays.given), side, order - 1]
    return Sides(before, after)


def moved_with_points(
    curve: Curve,
    points: FloatArray,
    parameters: FloatArray,
    arrays: PointArrays,
    coordinate: int | None = None,
) -> Callable[[FloatArray], tuple[FloatArray, FloatArray]]:
    """Return a function from moves of the points, (n, m), to changes of the derivatives at each knot.

    These are the changes before and after each knot. At fixed parameters, and for Catmull-Rom at fixed knots,
    the estimates are linear in the points; of others they are the changes by small moves, as a mean or of one
    coordinate. Derivatives that the person set do not change.
    """
    corners = _dividing_knots(arrays, len(points))

    def moved(moves: FloatArray) -> tuple[FloatArray, FloatArray]:
        # The moves are cut and unrolled with the points.
        both = np.hstack([points, at_knots(moves, closed=curve.is_closed)])
        before = np.zeros((len(points), curve.family.derivatives, moves.shape[1]))
        after = before.copy()
        for order, rule in enumerate(curve.rules):
            change = _of_moves(rule, curve, coordinate)
            _estimate(before[:, order], after[:, order], both, parameters, corners, change, curve.is_closed)
            for side, derivatives in enumerate((before, after)):
                derivatives[_given_rows(arrays, side, order + 1, len(points)), order] = 0.0
        return before, after

    return moved


def _of_moves(rule: EstimateRule, curve: Curve, coordinate: int | None) -> Estimate:
    """Return the changes of an estimate by moves of the points: columns 0 and 1 are points, the others moves.

    Of a rule that is not linear this is its Jacobian at the points, times the moves: where it treats each
    coordinate for itself, the mean of both, which is the mean over the directions of a move; or, of one
    coordinate, the change on that side of a kink to which the moves lead.
    """
    if rule.is_linear:
        return lambda both, t: _estimate_by(rule, curve)(both[:, 2:], t)
    function = getattr(curvecore, rule.changes)

    def changes(both: FloatArray, t: ArrayLike) -> FloatArray:
        if coordinate is not None:
            one: FloatArray = function(both[:, [coordinate]], t, both[:, 2:], one_sided=True)[:, 0]
            return one
        mean: FloatArray = function(both[:, :2], t, both[:, 2:], **_further(rule, curve)).mean(axis=1)
        return mean

    return changes


def two_sided_knots(arrays: PointArrays, count: int) -> list[int]:
    """Return the knots, of `count`, that have derivatives of their own on each side."""
    return _knots_where(arrays.corners, count)


def _dividing_knots(arrays: PointArrays, count: int) -> list[int]:
    """Return the knots, of `count`, that divide the estimates: corners whose velocities are free."""
    return _knots_where(arrays.corners & ~arrays.ties, count)


def _knots_where(holds: BoolArray, count: int) -> list[int]:
    knots: list[int] = holds.nonzero()[0].tolist()
    if count > len(holds) and holds[0]:
        knots.append(count - 1)
    return knots


def _estimate_by(rule: EstimateRule, curve: Curve) -> Estimate:
    function = getattr(curvecore, rule.function)

    def estimate(points: FloatArray, t: ArrayLike) -> FloatArray:
        data = (points, t) if "parameters" in rule.takes else (points,)
        estimates: FloatArray = function(*data, **_further(rule, curve))
        return estimates

    return estimate


def _further(rule: EstimateRule, curve: Curve) -> dict[str, float]:
    """Return the arguments of a rule beside points and parameters."""
    return {"alpha": curve.parametrization.alpha} if "alpha" in rule.takes else {}


def _estimate(
    before: FloatArray,
    after: FloatArray,
    points: FloatArray,
    parameters: FloatArray,
    corners: Sequence[int],
    estimate: Estimate,
    closed: bool,
    is_given: Sequence[BoolArray] | None = None,
) -> None:
    """Estimate from corner to corner; a closed curve is unrolled and goes on where it ends.

    Where all derivatives between two corners `is_given`, before and after the knots, nothing is estimated.
    """
    if not closed and not corners:
        after[:] = before[:] = estimate(points, parameters)
        return
    count = len(points) - closed
    spacing = parameters[1:] - parameters[:-1]
    is_endless = closed and not corners
    cuts = sorted({0, count - 1, *corners})
    if is_endless:
        cuts = [-_REACH, count + _REACH]
    elif closed:
        cuts = sorted({corner % count for corner in corners})
        cuts.append(cuts[0] + count)
    for start, end in pairwise(cuts):
        indices = np.arange(start, end + 1)
        knots = indices % count
        if is_given is not None and is_given[0][knots[1:]].all() and is_given[1][knots[:-1]].all():
            continue
        piece = estimate(points[knots], Spaced(spacing[knots[:-1]]))
        wanted = (indices >= 0) & (indices < count) | (not is_endless)
        after[knots[:-1][wanted[:-1]]] = piece[:-1][wanted[:-1]]
        before[knots[1:][wanted[1:]]] = piece[1:][wanted[1:]]
    if closed:
        before[count], after[count] = before[0], after[0]
    else:
        # The ends have one side only; the other is never used.
        before[0], after[-1] = after[0], before[-1]


def _given_rows(arrays: PointArrays, side: int, order: int, count: int) -> IntArray:
    """Return the knots, of `count`, whose derivative was set; a closed curve ends at its first point."""
    (rows,) = (~np.isnan(arrays.given[:, side, order - 1, 0])).nonzero()
    return np.append(rows, count - 1) if len(rows) and rows[0] == 0 and count > len(arrays.given) else rows


def _is_given(arrays: PointArrays, side: int, order: int, count: int) -> BoolArray:
    """Return the mask of the knots, of `count`, whose derivative was set."""
    is_given = np.zeros(count, dtype=np.bool_)
    is_given[_given_rows(arrays, side, order, count)] = True
    return is_given


def is_explicit(point: Point, order: int, *, ahead: bool) -> bool:
    """Whether the person set the derivative of an order on a side of a point."""
    return point.explicit_sides(order)[ahead] is not None


# Cardinal functions

_MANY, _SHORT_REACH = 200, 24
"""Points from which on an estimate forgets a point after `_SHORT_REACH` others: about 1e-14 of it is left."""


class Cardinal(msgspec.Struct, frozen=True, eq=False, dict=True):
    """Cardinal functions; None where an estimate is beyond all floats."""

    functions: CardinalBasis | None

    @cached_property
    def growth(self) -> float:
        """Their Lebesgue constant; infinite where it is beyond all floats."""
        return unbounded(lebesgue_constant(self.functions)) if self.functions is not None else math.inf


def unbounded(growth: float) -> float:
    """Return a growth, or infinity in place of the largest float."""
    return growth if growth < LARGEST else math.inf


class Cardinals:
    """Cache of the cardinal functions of one curve, which change with few of its edits.

    They depend on parameters, rules, corners and on which derivatives were set, not on the points.
    """

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._known = Cardinal(None)

    def of(
        self, curve: Curve, points: FloatArray, basis_curve: ParametricCurve, arrays: PointArrays
    ) -> Cardinal:
        """Return the functions of a curve.

        Parameters
        ----------
        curve
            The document's value.
        points
            Its points at its knots, (k, 2).
        basis_curve
            A core curve with its basis functions.
        arrays
            The numbers in its points.
        """
        is_set = ~np.isnan(arrays.given[:, :, : curve.family.derivatives, 0])
        numbers = [basis_curve.parameters, arrays.corners, arrays.ties, is_set]
        if not all(rule.is_linear for rule in curve.rules):
            numbers += [np.array(curve.parametrization.alpha), points]
        key = (curve.functions_key, curve.is_closed, *curve.rules, *(column.tobytes() for column in numbers))
        if key != self._key:
            self._key, self._known = key, Cardinal(_cardinal_basis(curve, points, basis_curve, arrays))
        return self._known


def _cardinal_basis(
    curve: Curve, points: FloatArray, basis_curve: ParametricCurve, arrays: PointArrays
) -> CardinalBasis | None:
    if not curve.family.derivatives:
        return CardinalBasis(basis_curve, closed=curve.is_closed)
    reach = REACH if len(curve.points) < _MANY else _SHORT_REACH
    moved = partial(moved_with_points, curve, points, basis_curve.parameters, arrays)
    is_local = any(rule.growth_holds for rule in curve.rules)
    sides = [moved(coordinate) for coordinate in (0, 1)] if is_local else []
    try:
        return CardinalBasis(basis_curve, moved(), closed=curve.is_closed, reach=reach, one_sided=sides)
    except CurveError:
        return None


# Refusals

_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_NAMES = {"points": "", **{derivative.plural: derivative.letter for derivative in DERIVATIVES}}
_ENTRY = re.compile(rf"\b({'|'.join(_NAMES)}|parameters)\[(\d+)(?:, (\d+))?\]")
_NUMBER = re.compile(r"(?<![\w.])(-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)(?![\w.]|\))")


def refusal_of(problem: CurveError, curve: Curve) -> str:
    """Return a sentence that says why the core refused a curve of the document."""
    text = str(problem)
    if text.startswith("parameters must be strictly increasing") and len(problem.indices) == 2:
        return _not_increasing(text, problem.indices, curve)
    if curve.is_closed and len(curve.points) in problem.indices:
        # Where the curve returns to its first point.
        text = re.sub(rf"\b{len(curve.points)}\b", "0", text)
    return sentence(in_words(text))


def in_words(text: str) -> str:
    """Return a refusal of the core with t₁ for parameters[1], x of point 2 for points[2, 0], and so on."""
    return _NUMBER.sub(lambda match: _number(match[1]), _ENTRY.sub(_entry, text))


def sentence(text: str) -> str:
    """Return text with a capital at the beginning and a full stop at the end."""
    text = text[:1].upper() + text[1:]
    return text if text.endswith(".") else text + "."


def _not_increasing(text: str, indices: tuple[int, ...], curve: Curve) -> str:
    before, after = indices
    second, first = (_number(value) for value in re.findall(r"= (\S+)", text)[:2])
    if not curve.is_manual:
        return (
            f"{_t(before)} and {_t(after)} are the same number, {first}: for an interval from "
            f"{_number(repr(curve.parametrization.start))} to {_number(repr(curve.parametrization.end))} "
            f"points {before} and {after % len(curve.points)} lie too close together."
        )
    if after == len(curve.points):
        return (
            f"{_t(before)} = {first} must be less than {second}, where the curve returns to its first point."
        )
    return f"{_t(after)} = {second} must be greater than {_t(before)} = {first}."


def _t(index: int) -> str:
    return "t" + str(index).translate(_SUBSCRIPTS)


def _entry(match: re.Match[str]) -> str:
    name, row, column = match[1], int(match[2]), match[3]
    if name == "parameters":
        return _t(row)
    component = "xy"[int(column)] if column in ("0", "1") else ""
    return f"{_NAMES[name]}{component} of point {row}".strip()


def _number(text: str) -> str:
    """Return a number as it is displayed and typed: all digits, no point without digits, a true minus."""
    value = float(text)
    digits = f"{value:.0f}" if value == round(value) and abs(value) < 1e15 else f"{value!r}"
    return with_minus(digits)
