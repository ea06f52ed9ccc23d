"""The same curve as one of another family, where it is one or can be followed: the shape is kept."""

from __future__ import annotations

import numpy as np

from curvecore import CurveError, lagrange_to_bezier

from ..document.edits import EditError
from ..document.model import Curve
from ..document.words import count_of, number
from ..families import Family
from .curve_view import CurveView, view_of
from .measure import dense, is_kept, largest_distance
from .plane import size_of
from .reshape import Reshaped, refuse_without_curve, through

_FOLLOWED = 1e-4
"""Share of the curve's size within which one that is no polynomial is followed."""

_WORTH_A_WORD = 10.0
"""Growth of errors from points to control points that is told."""


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
    try:
        tolerance = _FOLLOWED * max(size_of(view.points), float(np.finfo(float).tiny))
        same = family.curve_class.near(view.curve, tolerance)
    except CurveError as problem:
        raise EditError(f"This is no {family.title} curve: {problem}.") from None
    made = through(view, same, family)
    after = view_of(made)
    refuse_without_curve(after)
    t = dense(view.parameters)
    residual = largest_distance(view, t, after, t)
    if residual > tolerance and not is_kept(residual, (view.source,)):
        raise EditError(
            f"As {family.a_curve} it would be up to {number(residual, 2)} away: too much is lost by rounding."
        )
    left_rule = made.is_manual and not view.source.is_manual
    note = _growth(view, family) or _corners_made(view.source, made)
    return Reshaped(made, residual, left_rule=left_rule, note=note)


def _corners_made(before: Curve, made: Curve) -> str:
    """Say how many points had to become corners: where a derivative jumps that the family's does not."""
    new = sum(point.corner for point in made.points) - sum(point.corner for point in before.points)
    return f"{count_of(new, 'point')} became {'a corner' if new == 1 else 'corners'}." if new > 0 else ""


def _growth(view: CurveView, family: Family) -> str:
    """Say how errors of points on one polynomial grow in control points beside it."""
    assert view.curve is not None
    if family.interpolates or not view.curve.is_one_polynomial:
        return ""
    condition = lagrange_to_bezier(view.curve).condition
    if condition < _WORTH_A_WORD:
        return ""
    return f"An error of a point counts up to {number(condition, 2)} times as much in the control points."
