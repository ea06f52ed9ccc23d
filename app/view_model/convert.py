"""The same curve as one of another family, exactly or followed closely."""

from __future__ import annotations

import msgspec
import numpy as np

import curvecore
from curvecore import CurveError

from ..document.derivatives import DERIVATIVES
from ..document.limits import EditError
from ..document.words import count_of, number
from ..families import Family
from .curve.curve_view import CurveView, view_of
from .curve.distances import dense, keeps_shape, largest_distance
from .geometry import size_of
from .reshape import Reshaped, refuse_without_curve, through

_FOLLOWED = 1e-4
"""Share of the size of a curve within which one that is no polynomial is followed."""

_WORTH_A_WORD = 10.0
"""Growth of errors from points to control points from which on a note says so."""

_ROUNDING = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""


class Outlook(msgspec.Struct, frozen=True):
    """The result to expect of a conversion to a family, known before the work.

    Attributes
    ----------
    within
        The largest distance that is allowed where the curve is followed; 0 where the shape is kept.
    refusal
        A sentence why there is no such curve; empty where there is one.
    """

    within: float = 0.0
    refusal: str = ""


def outlook(view: CurveView, family: Family) -> Outlook:
    """Return the outlook of converting a current curve to `family`."""
    if family.curve_class.follows and not all(piece.has_exact_pieces for piece in view.present_curve.pieces):
        return Outlook(within=_tolerance(view))
    try:
        family.curve_class.check_shape(view.present_curve)
    except CurveError as problem:
        return Outlook(refusal=_refusal(family, problem))
    return Outlook()


def converted(view: CurveView, family: Family) -> Reshaped:
    """Return the curve as one of `family`; the change of its shape is measured.

    A curve that is no polynomial is followed within a ten-thousandth of its size, where the family can.

    Raises
    ------
    EditError
        If there is no curve, or the family has no such curve: the sentence says why.
    """
    refuse_without_curve(view)
    prospect = outlook(view, family)
    if prospect.refusal:
        raise EditError(prospect.refusal)
    tolerance = _tolerance(view)
    try:
        same = family.curve_class.near(view.present_curve, tolerance)
    except CurveError as problem:
        raise EditError(_refusal(family, problem)) from None
    result = through(view, same, family)
    after = view_of(result)
    refuse_without_curve(after)
    t = dense(view.parameters)
    residual = largest_distance(view, t, after, t)
    if residual > tolerance and not keeps_shape(residual, (view.source,)):
        raise EditError(
            f"As {family.a_curve} the shape would change by up to {number(residual, 2)} through rounding."
        )
    left_rule = result.is_manual and not view.source.is_manual
    note = _growth(view, family) or _jumps(view, after)
    return Reshaped(result, residual, left_rule=left_rule, note=note)


def needless_change(before: CurveView, after: CurveView) -> float:
    """Return the change of a curve by a new family that has the same curve; else 0.

    Only curves whose derivatives were set by hand count: of others the rules decide the shape.
    """
    is_set = before.source.has_derivatives and before.source.family.derivatives
    if not (is_set and after.source.family.takes_shapes and before.is_current and after.is_current):
        return 0.0
    prospect = outlook(before, after.source.family)
    if prospect.refusal or prospect.within:
        return 0.0
    t = dense(before.parameters)
    away = largest_distance(before, t, after, t)
    return 0.0 if keeps_shape(away, (before.source,)) else away


def _tolerance(view: CurveView) -> float:
    return _FOLLOWED * max(size_of(view.points), float(np.finfo(float).tiny))


def _refusal(family: Family, problem: CurveError) -> str:
    return f"This curve is not {family.a_curve}: {problem}."


def _jumps(before: CurveView, after: CurveView) -> str:
    """Return a sentence about new jumps of a derivative that the family usually has not; else nothing."""
    if after.sides is None:
        return ""
    old, near = before.parameters[before.two_sided], _ROUNDING * np.ptp(before.parameters)
    is_new = np.abs(after.parameters[after.two_sided, None] - old).min(axis=1, initial=np.inf) > near
    new = np.array(after.two_sided, dtype=int)[is_new]
    if not len(new):
        return ""
    behind, ahead = (side[:, 1:] for side in after.sides)
    size = np.abs(ahead).max(axis=(0, 2))
    jumps = (np.abs(ahead - behind).max(axis=2) > _ROUNDING * size)[new].any(axis=0)
    derivative = DERIVATIVES[int(np.argmax(jumps))]
    points = "the point there has" if len(new) == 1 else "the points there have"
    joints = count_of(len(new), "joint")
    return f"The {derivative.name} jumps at {joints}: {points} derivatives before and after."


def _growth(view: CurveView, family: Family) -> str:
    """Return a sentence about the growth of errors from points of a polynomial to control points."""
    if family.interpolates or not view.present_curve.is_one_polynomial:
        return ""
    # By way of the package: the module is loaded when it is first used.
    condition = curvecore.lagrange_to_bezier(view.present_curve).condition
    if condition < _WORTH_A_WORD:
        return ""
    return f"An error of a point grows by a factor of up to {number(condition, 2)} in the control points."
