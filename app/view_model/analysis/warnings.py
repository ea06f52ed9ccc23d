"""Warnings about the numbers of a curve."""

from __future__ import annotations

import enum

import msgspec
import numpy as np

from ...document.words import short
from ..basis import growth_of_points
from ..curve.curve_view import CurveView
from ..curve.rounded_parameters import ParameterRounding

LARGE_LEBESGUE = 100.0
"""The Lebesgue constant above which two digits of the accuracy of the points are lost."""

_LOOK_CLOSER, _MOST_EXACT = 90.0, 60

_HASTE = 10.0
"""Factor of the speed in a narrow gap over that beside it up to which there is no warning."""

NARROW = 1e-2
"""A gap between neighbouring t is narrow below this share of the wider gap beside it; Chebyshev's parameters,
however many, never come below a third."""


class Topic(enum.Enum):
    """The subjects of warnings."""

    LEBESGUE = enum.auto()
    GAP = enum.auto()
    ROUNDING = enum.auto()


class CurveWarning(msgspec.Struct, frozen=True):
    """A warning.

    Attributes
    ----------
    topic
        Its subject.
    badge
        A sign and a word or two.
    sentence
        Its meaning.
    """

    topic: Topic
    badge: str
    sentence: str


def warnings_of(view: CurveView, lebesgue: float) -> list[CurveWarning]:
    """Return the warnings about a curve, the most important first.

    `lebesgue` is its Lebesgue constant by samples; where it is near the limit it is computed exactly.
    """
    if not view.is_current:
        return []
    warnings = []
    if remark := ParameterRounding(view).remark:
        warnings.append(CurveWarning(Topic.ROUNDING, "⚠ t rounded", remark))
    # A curve that does not pass its points need not be fast between two of them.
    gap = _narrowest(view) if view.source.family.interpolates else None
    if gap is not None:
        shows = ", and the smallest error becomes visible" if gap.is_estimated else ""
        sentence = (
            f"The parameters of points {view.owner(gap.knot)} and {view.owner(gap.knot + 1)} are only "
            f"{short(gap.width)} apart, {short(gap.wider / gap.width)} times less than the next ones: "
            f"the curve must pass from one to the other in almost no time{shows}."
        )
        warnings.append(CurveWarning(Topic.GAP, "⚠ t almost equal", sentence))
    if lebesgue > _LOOK_CLOSER and len(view.parameters) <= _MOST_EXACT and view.basis_curve is not None:
        lebesgue = growth_of_points(view)
    if lebesgue > LARGE_LEBESGUE:
        sentence = _words_on_growth(view, lebesgue)
        warnings.append(CurveWarning(Topic.LEBESGUE, f"⚠ Λ {short(lebesgue)}", sentence))
    return warnings


class _Gap(msgspec.Struct, frozen=True):
    """A narrow gap between parameters.

    Attributes
    ----------
    knot
        The knot before the gap.
    width, wider
        The width of the gap, and that of the gap beside it.
    is_estimated
        Whether derivatives at its ends are estimated, so that its points move them strongly.
    """

    knot: int
    width: float
    wider: float
    is_estimated: bool


def _narrowest(view: CurveView) -> _Gap | None:
    """Return the narrowest gap that matters, if one is narrow.

    A gap does not matter where the points are as near as their parameters and the derivatives were set: the
    curve is not fast there, and no error of a point grows.
    """
    gaps = np.diff(view.parameters)
    if len(gaps) < 2:
        return None
    knots = np.arange(len(gaps))
    beside = np.where(np.append(gaps[1:], 0.0) >= np.insert(gaps[:-1], 0, 0.0), knots + 1, knots - 1)
    shares = gaps / gaps[beside]
    for knot in np.argsort(shares, kind="stable").tolist():
        if not shares[knot] < NARROW:
            return None
        is_estimated = _is_estimated(view, knot)
        if is_estimated or _speed(view, knot) > _HASTE * _speed(view, beside[knot]):
            return _Gap(knot, float(gaps[knot]), float(gaps[beside[knot]]), is_estimated)
    return None


def _is_estimated(view: CurveView, knot: int) -> bool:
    """Whether a rule estimates derivatives at the ends of a segment, or all points decide about them."""
    points, orders = view.source.points, range(1, view.source.family.derivatives + 1)
    ends = [(points[view.owner(knot)], True), (points[view.owner(knot + 1)], False)]
    return not orders or any(
        point.explicit_sides(order)[ahead] is None for order in orders for point, ahead in ends
    )


def _speed(view: CurveView, knot: int) -> float:
    """Return the least speed of the curve between the points of a segment."""
    one, other = (view.points[view.owner(index)] for index in (knot, knot + 1))
    return float(np.hypot(*(other - one)) / (view.parameters[knot + 1] - view.parameters[knot]))


def _words_on_growth(view: CurveView, lebesgue: float) -> str:
    if view.growth_holds and np.isinf(lebesgue):
        return (
            "Between two straight runs of x or y the smallest error in a point makes the velocity jump, and "
            "the curve with it. Move a point of the runs, or set the velocity between them by hand."
        )
    digits = int(np.log10(lebesgue)) if np.isfinite(lebesgue) else "all"
    return (
        f"An error in a point, even by rounding, can be {short(lebesgue)} times as large on the curve: "
        f"{digits} digits of accuracy are lost. {_remedy(view)}"
    )


def _remedy(view: CurveView) -> str:
    if not view.source.family.derivatives:
        return "Use Chebyshev parameters, or a Hermite curve."
    return (
        "The estimated velocities follow the error. Space the parameters more evenly, "
        "or set the velocities beside the narrow gaps by hand."
    )
