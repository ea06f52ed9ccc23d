"""The core's curve through a document's points, at the parameters that its rules give."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import msgspec
import numpy as np

from curvecore import Chain, CurveError, ParametricCurve, parametrization
from curvecore.arrays import FloatArray, parameter_array

from ...document.model import Curve, ParametrizationKind
from ..geometry import at_knots
from .jets import Sides, sides_of, two_sided_knots
from .point_arrays import PointArrays
from .refusals import refusal_of


class Core(msgspec.Struct, frozen=True, eq=False):
    """The core's curve, or why there is none, and its jets; see the properties of `CurveView`."""

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
) -> Core:
    """Return the core curve through points at its knots, and its jets where the family has derivatives.

    `frozen` is a curve of the family with these parameters, and without corners.
    """
    make = partial(curve.family.make, settings=curve.settings_in_effect)
    if not curve.family.derivatives:
        jets = points[:, None]
        return Core(make(jets, parameters) if frozen is None else frozen.with_jets(jets))
    sides = sides_of(curve, points, parameters, arrays)
    last = len(parameters) - 1
    jumps = [knot for knot in two_sided_knots(arrays, last + 1) if 0 < knot < last]
    # Where tied velocities are the same, nothing jumps: a curve of many such points stays in one piece.
    ties = arrays.ties
    corners = [
        knot for knot in jumps if not ties[knot] or not np.array_equal(sides.before[knot], sides.after[knot])
    ]
    if frozen is not None and not corners:
        return Core(frozen.with_jets(_piece_jets(sides, 0, last)), sides=sides)
    pieces = [
        make(_piece_jets(sides, start, end), parameters[start : end + 1])
        for start, end in pairwise([0, *corners, last])
    ]
    return Core(pieces[0] if len(pieces) == 1 else Chain(pieces), sides=sides)


def core_after(curve: Curve, arrays: PointArrays, before: ParametricCurve) -> Core:
    """Return the curve after its points have moved, given the one before; nothing but them has changed."""
    knots = at_knots(arrays.positions, closed=curve.is_closed)
    try:
        return core_curve(curve, knots, before.parameters, arrays, before)
    except CurveError as problem:
        return Core(before, refusal_of(problem, curve))


def core_anew(curve: Curve, arrays: PointArrays, before: ParametricCurve | None) -> Core:
    """Return the curve that the points and rules give, the one before where they give none."""
    knots = at_knots(arrays.positions, closed=curve.is_closed)
    try:
        return core_curve(curve, knots, checked_parameters(curve, knots, arrays), arrays)
    except CurveError as problem:
        return Core(before, refusal_of(problem, curve))


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
