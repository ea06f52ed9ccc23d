"""The same curve as one of another family, where it is one or can be followed: the shape is kept."""

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
"""Share of the curve's size within which one that is no polynomial is followed."""

_WORTH_A_WORD = 10.0
"""Growth of errors from points to control points that is told."""

_ROUNDING = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""


class Outlook(msgspec.Struct, frozen=True):
    """The curve that another would become in a family, told before it is written there.

    Attributes
    ----------
    within
        The largest distance that is allowed where the curve is followed; 0 where the shape is kept.
    refusal
        The reason why there is none, as a sentence; empty where there is.
    """

    within: float = 0.0
    refusal: str = ""


def outlook(view: CurveView, family: Family) -> Outlook:
    """Return what would become of a current curve as one of `family`, without the work of writing it so."""
    assert view.curve is not None
    if family.curve_class.follows and not all(piece.has_exact_pieces for piece in view.curve.pieces):
        return Outlook(within=_tolerance(view))
    try:
        family.curve_class.check_shape(view.curve)
    except CurveError as problem:
        return Outlook(refusal=_refusal(family, problem))
    return Outlook()


def converted(view: CurveView, family: Family) -> Reshaped:
    """Return the curve as one of `family`; what becomes of its shape is measured.

    A curve that is no polynomial is followed within a ten-thousandth of its size, where the family can.

    Raises
    ------
    EditError
        If there is no curve, or it is none of that family: the sentence says why.
    """
    refuse_without_curve(view)
    assert view.curve is not None
    found = outlook(view, family)
    if found.refusal:
        raise EditError(found.refusal)
    tolerance = _tolerance(view)
    try:
        same = family.curve_class.near(view.curve, tolerance)
    except CurveError as problem:
        raise EditError(_refusal(family, problem)) from None
    made = through(view, same, family)
    after = view_of(made)
    refuse_without_curve(after)
    t = dense(view.parameters)
    residual = largest_distance(view, t, after, t)
    if residual > tolerance and not keeps_shape(residual, (view.source,)):
        raise EditError(
            f"As {family.a_curve} it would be up to {number(residual, 2)} away: too much is lost by rounding."
        )
    left_rule = made.is_manual and not view.source.is_manual
    note = _growth(view, family) or _jumps(view, after)
    return Reshaped(made, residual, left_rule=left_rule, note=note)


def needless_change(before: CurveView, after: CurveView) -> float:
    """Return how far a curve is from what it was in a family before, where this one could hold it; else 0.

    It is a curve whose derivatives were set by hand: of others the rules decide the shape.
    """
    is_set = before.source.has_derivatives and before.source.family.derivatives
    if not (is_set and after.source.family.takes_shapes and before.is_current and after.is_current):
        return 0.0
    found = outlook(before, after.source.family)
    if found.refusal or found.within:
        return 0.0
    t = dense(before.parameters)
    away = largest_distance(before, t, after, t)
    return 0.0 if keeps_shape(away, (before.source,)) else away


def _tolerance(view: CurveView) -> float:
    return _FOLLOWED * max(size_of(view.points), float(np.finfo(float).tiny))


def _refusal(family: Family, problem: CurveError) -> str:
    return f"This is no {family.title} curve: {problem}."


def _jumps(before: CurveView, after: CurveView) -> str:
    """Say at how many joints a derivative jumps that the family's does not, except where they did of old."""
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
    each = DERIVATIVES[int(np.argmax(jumps))]
    points = "the point there has" if len(new) == 1 else "the points there have"
    return f"The {each.name} jumps at {count_of(len(new), 'joint')}: {points} derivatives before and after."


def _growth(view: CurveView, family: Family) -> str:
    """Say how errors of points on one polynomial grow in control points beside it."""
    assert view.curve is not None
    if family.interpolates or not view.curve.is_one_polynomial:
        return ""
    # Asked of the package: the module is loaded when it is first used.
    condition = curvecore.lagrange_to_bezier(view.curve).condition
    if condition < _WORTH_A_WORD:
        return ""
    return f"An error of a point counts up to {number(condition, 2)} times as much in the control points."
