"""The core's curve through the points of a document's curve, under its rules.

`core_curve` makes it. Of a Hermite curve its data are the derivatives that the person set and the estimates
of the rules for the rest, `Sides`. What is set is given to the rules: in a spline it is a condition. A corner
divides the curve into pieces, and each piece is estimated for itself; a closed curve without a corner is
estimated as the periodic curve it is. Where velocities are tied the curve is smooth, and both are set.

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
from typing import Any, NamedTuple

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

import curvecore
from curvecore import Chain, CurveError, ParametricCurve, lebesgue_constant, parametrization
from curvecore.analysis.cardinal import REACH, CardinalBasis
from curvecore.arithmetic import LARGEST
from curvecore.arrays import BoolArray, FloatArray, IntArray, parameter_array
from curvecore.parametrization import Spaced

from ...document.derivatives import DERIVATIVES, EstimateRule
from ...document.model import Curve, ParametrizationKind
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

Estimate = Callable[..., FloatArray]
"""Points (m, dim), their parameters and by name what is set, each (m, dim), to derivatives (m, dim)."""

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
    estimates = [_estimate_by(rule, curve) for rule in curve.rules]
    given = None if np.isnan(arrays.given).all() else _at_knots(arrays.given, len(points))
    _estimate(curve, Sides(before[:, 1:], after[:, 1:]), points, parameters, arrays, estimates, given)
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
    changes = [_of_moves(rule, curve, coordinate) for rule in curve.rules]
    given = None if np.isnan(arrays.given).all() else 0.0 * _at_knots(arrays.given[..., :1], len(points))

    def moved(moves: FloatArray) -> tuple[FloatArray, FloatArray]:
        # The moves are cut and unrolled with the points.
        both = np.hstack([points, at_knots(moves, closed=curve.is_closed)])
        before = np.zeros((len(points), curve.family.derivatives, moves.shape[1]))
        sides = Sides(before, before.copy())
        rest = None if given is None else np.broadcast_to(given, (*given.shape[:3], moves.shape[1]))
        _estimate(curve, sides, both, parameters, arrays, changes, rest)
        return sides

    return moved


class SetDerivative(NamedTuple):
    """A derivative that the person set: its point, its order, and whether it is that after a corner."""

    point: int
    order: int
    ahead: bool


def moved_with_set(
    curve: Curve,
    points: FloatArray,
    parameters: FloatArray,
    arrays: PointArrays,
    which: Sequence[SetDerivative],
) -> Sides:
    """Return the changes of the derivatives at the knots by those that the person set, (k, R - 1, m) each.

    Each of the m columns belongs to a derivative that is set, and one unit of it: with its own, the estimates
    that follow it.
    """
    changes = [_of_moves(rule, curve, None) for rule in curve.rules]
    rest = np.repeat(0.0 * arrays.given[..., :1], len(which), axis=3)
    for column, (point, order, ahead) in enumerate(which):
        rest[point, int(ahead) if arrays.corners[point] else slice(None), order - 1, column] = 1.0
    before = np.zeros((len(points), curve.family.derivatives, len(which)))
    sides, data = Sides(before, before.copy()), np.hstack([points, before[:, 0]])
    _estimate(curve, sides, data, parameters, arrays, changes, _at_knots(rest, len(points)))
    return sides


def _of_moves(rule: EstimateRule, curve: Curve, coordinate: int | None) -> Estimate:
    """Return the changes of an estimate by moves of the points: columns 0 and 1 are points, the others moves.

    Of a rule that is not linear this is its Jacobian at the points, times the moves: where it treats each
    coordinate for itself, the mean of both, which is the mean over the directions of a move; or, of one
    coordinate, the change on that side of a kink to which the moves lead.
    """
    if rule.is_linear:
        return lambda both, t, **given: _estimate_by(rule, curve)(both[:, 2:], t, **given)
    function = getattr(curvecore, rule.changes)

    def changes(both: FloatArray, t: ArrayLike, **given: FloatArray) -> FloatArray:
        if coordinate is not None:
            return np.asarray(function(both[:, [coordinate]], t, both[:, 2:], one_sided=True)[:, 0])
        by_coordinate = function(both[:, :2], t, both[:, 2:], **_further(rule, curve), **given)
        return np.asarray(by_coordinate.mean(axis=1))

    return changes


def two_sided_knots(arrays: PointArrays, count: int) -> list[int]:
    """Return the knots, of `count`, that have derivatives of their own on each side."""
    return _at_knots(arrays.corners, count).nonzero()[0].tolist()


def _at_knots(rows: NDArray[Any], count: int) -> NDArray[Any]:
    """Return rows of points at the knots, of `count`; a closed curve ends at its first point."""
    return rows if len(rows) == count else np.concatenate([rows, rows[:1]])


def _estimate_by(rule: EstimateRule, curve: Curve) -> Estimate:
    function = getattr(curvecore, rule.function)

    def estimate(points: FloatArray, t: ArrayLike, **given: FloatArray) -> FloatArray:
        data = (points, t) if "parameters" in rule.takes else (points,)
        return np.asarray(function(*data, **_further(rule, curve), **given))

    return estimate


def _further(rule: EstimateRule, curve: Curve) -> dict[str, float]:
    """Return the arguments of a rule beside points, parameters and derivatives that are set."""
    return {"alpha": curve.parametrization.alpha} if "alpha" in rule.takes else {}


def _estimate(
    curve: Curve,
    sides: Sides,
    data: FloatArray,
    parameters: FloatArray,
    arrays: PointArrays,
    estimates: Sequence[Estimate],
    given: FloatArray | None,
) -> None:
    """Fill the derivatives at both sides of the knots, (k, R - 1, dim): those given, and the estimates.

    `data` are what is estimated from, (k, any); `given` is NaN where a derivative is to be estimated, by side
    and order, (k, 2, R - 1 or more, dim).
    """
    count, closed = len(data), curve.is_closed
    corners, ties = (_at_knots(column, count) for column in (arrays.corners, arrays.ties & arrays.corners))
    is_plain = not (closed or corners.any())
    # Tied velocities are conditions of a spline; other rules go on there, for the curve is smooth.
    divides = corners if curve.rules[0].is_spline else corners & ~ties
    rows: _Rows | None = None
    for order, (rule, estimate) in enumerate(zip(curve.rules, estimates, strict=True)):
        if given is not None and not np.isnan(given[:, :, order, 0]).any():
            _take(sides, order, given)
            continue
        known = _known(curve.rules, order, given, ties)
        if is_plain:
            at = {name: values[:, 0] for name, values in known.items()}
            sides.before[:, order] = sides.after[:, order] = estimate(data, parameters, **at)
            _take(sides, order, given)
            continue
        rows = rows or _rows_of(parameters, divides, closed=closed)
        for run in [rows] if rule.is_spline else rows.runs():
            if given is not None and run.is_all_set(given[:, :, order, 0]):
                continue
            at = {name: values[run.knots, run.sides] for name, values in known.items()}
            piece = estimate(data[run.knots], Spaced(run.spacing), **at)
            sides.before[run.knots[run.before], order] = piece[run.before]
            sides.after[run.knots[run.after], order] = piece[run.after]
        if order > 1 and ties.any():
            # Of a point that stays smooth when its velocities are tied: the mean, as of one that is not tied.
            h = np.diff(parameters)
            share = (np.append(h[-1], h) / (np.append(h[-1], h) + np.append(h, h[0])))[ties, None]
            before, after = (derivatives[ties, order] for derivatives in sides)
            for derivatives in sides:
                derivatives[ties, order] = before + share * (after - before)
        if closed:
            for derivatives in sides:
                derivatives[-1, order] = derivatives[0, order]
        _take(sides, order, given)


def _take(sides: Sides, order: int, given: FloatArray | None) -> None:
    """Replace the derivatives of an order, from 0, by those given."""
    for side, derivatives in enumerate(sides if given is not None else ()):
        assert given is not None
        np.copyto(derivatives[:, order], given[:, side, order], where=~np.isnan(given[:, side, order]))


def _known(
    rules: Sequence[EstimateRule], order: int, given: FloatArray | None, ties: BoolArray
) -> dict[str, FloatArray]:
    """Return the data given to the rule of an order, from 0: by name those on both sides, (k, 2, dim)."""
    known = {}
    for lower, derivative in enumerate(DERIVATIVES[: len(rules)] if given is not None else ()):
        # A local rule has velocities of its own, from which other orders are not estimated.
        if derivative.plural in rules[order].takes and (lower == order or rules[lower].is_spline):
            assert given is not None
            goes_on = ties[:, None, None] & (lower == 0 and not rules[0].is_spline)
            known[derivative.plural] = np.where(goes_on, np.nan, given[:, :, lower])
    return known


class _Rows(NamedTuple):
    """Rows of an estimate, along the curve: one for a knot, two for a corner that divides it.

    Attributes
    ----------
    knots
        The knot of each row, (m,).
    spacing
        Distances in t, (m - 1,); 0 between the rows of a corner.
    before, after
        Whether a row is the estimate on that side of its knot, (m,).
    """

    knots: IntArray
    spacing: FloatArray
    before: BoolArray
    after: BoolArray

    @property
    def sides(self) -> IntArray:
        """The side of its knot on which a derivative that is set counts for a row, (m,)."""
        sides = (~self.before).astype(np.intp)
        # At the start of an open curve only that side is used.
        sides[0] = 1
        return sides

    def is_all_set(self, given: FloatArray) -> bool:
        """Whether nothing is to be estimated: of both sides of the knots, (k, 2), all are given."""
        missing = np.isnan(given)
        return not (missing[self.knots[self.before], 0].any() or missing[self.knots[self.after], 1].any())

    def runs(self) -> list[_Rows]:
        """Return the rows from corner to corner."""
        cuts = (self.spacing == 0.0).nonzero()[0] + 1
        return [
            _Rows(self.knots[i:j], self.spacing[i : j - 1], self.before[i:j], self.after[i:j])
            for i, j in pairwise([0, *cuts.tolist(), len(self.knots)])
        ]


def _rows_of(parameters: FloatArray, divides: BoolArray, *, closed: bool) -> _Rows:
    """Return the rows of a curve; a closed one begins at a corner, or is unrolled without one."""
    count, spacing = len(parameters) - closed, parameters[1:] - parameters[:-1]
    if closed and not divides.any():
        at = np.arange(-_REACH, count + _REACH + 1)
        is_inside = (at >= 0) & (at < count)
        return _Rows(at % count, spacing[at[:-1] % count], is_inside, is_inside)
    first = int(np.argmax(divides)) if closed else 0
    at = np.arange(first, first + len(parameters))
    is_twice = divides[at % count]
    is_twice[[0, -1]] = False
    at = np.repeat(at, 1 + is_twice)
    is_step = at[1:] > at[:-1]
    knots = at % count
    return _Rows(
        knots,
        np.where(is_step, spacing[knots[:-1]], 0.0),
        np.insert(is_step, 0, not closed),
        np.append(is_step, not closed),
    )


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
