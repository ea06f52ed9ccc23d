"""Warnings about the numbers of a curve."""

from __future__ import annotations

import enum

import msgspec
import numpy as np

from ..basis import growth_of_points
from ..curve.curve_view import CurveView
from ..curve.rounded_parameters import ParameterRounding
from .wording import short

LARGE_LEBESGUE = 100.0
"""The Lebesgue constant above which two digits of the points' accuracy are gone."""

_LOOK_CLOSER, _MOST_EXACT = 90.0, 60

_HASTE = 10.0
"""How many times as fast as beside it the curve may run through a narrow gap without a warning."""

NARROW = 1e-2
"""A gap between neighbouring t is narrow below this share of the wider gap beside it; Chebyshev's parameters,
however many, never come below a third."""


class Topic(enum.Enum):
    """The subjects of warnings."""

    LEBESGUE = enum.auto()
    GAP = enum.auto()
    ROUNDING = enum.auto()


class Warned(msgspec.Struct, frozen=True):
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


def warnings_of(view: CurveView, lebesgue: float) -> list[Warned]:
    """Return what is worth a warning about a curve, the most telling first.

    `lebesgue` is its Lebesgue constant, as far as samples show it; where it counts it is computed exactly.
    """
    if not view.is_current:
        return []
    found = []
    if remark := ParameterRounding(view).remark:
        found.append(Warned(Topic.ROUNDING, "⚠ t rounded", remark))
    # Past its points a curve is in no hurry between two of them.
    gap = _narrowest(view) if view.source.family.interpolates else None
    if gap is not None:
        shows = ", and the smallest error shows" if gap.is_estimated else ""
        found.append(
            Warned(
                Topic.GAP,
                "⚠ t almost equal",
                f"The parameters of points {view.owner(gap.knot)} and {view.owner(gap.knot + 1)} are only "
                f"{short(gap.width)} apart, {short(gap.wider / gap.width)} times less than the next ones: "
                f"the curve must get from one to the other in no time{shows}.",
            )
        )
    if lebesgue > _LOOK_CLOSER and len(view.parameters) <= _MOST_EXACT and view.basis_curve is not None:
        lebesgue = growth_of_points(view)
    if lebesgue > LARGE_LEBESGUE:
        found.append(
            Warned(
                Topic.LEBESGUE,
                f"⚠ Λ {short(lebesgue)}",
                _words_on_growth(view, lebesgue),
            )
        )
    return found


class _Gap(msgspec.Struct, frozen=True):
    """A narrow gap between parameters.

    Attributes
    ----------
    knot
        Before it.
    width, wider
        Its own, and that of the gap beside it.
    is_estimated
        Whether derivatives at its ends are, so that its points move them by the more.
    """

    knot: int
    width: float
    wider: float
    is_estimated: bool


def _narrowest(view: CurveView) -> _Gap | None:
    """Return the narrowest gap that matters, if one is narrow.

    None does where the points are as near as their parameters and the derivatives were set: the curve takes
    its time there, and no error of a point grows.
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
    """Whether a rule says what the curve does at the ends of a segment, or all of its points together."""
    points, orders = view.source.points, range(1, view.source.family.derivatives + 1)
    ends = [(points[view.owner(knot)], True), (points[view.owner(knot + 1)], False)]
    return not orders or any(
        point.explicit_sides(order)[ahead] is None for order in orders for point, ahead in ends
    )


def _speed(view: CurveView, knot: int) -> float:
    """Return how fast the curve must be between the points of a segment at least."""
    one, other = (view.points[view.owner(each)] for each in (knot, knot + 1))
    return float(np.hypot(*(other - one)) / (view.parameters[knot + 1] - view.parameters[knot]))


def _words_on_growth(view: CurveView, lebesgue: float) -> str:
    if view.growth_holds and np.isinf(lebesgue):
        return (
            "Between two straight runs of x or y the velocity jumps with the smallest error in a point, and "
            "the curve with it. Move a point of the runs, or set the velocity between them by hand."
        )
    return (
        f"An error in a point, even one of rounding, can come out {short(lebesgue)} times as large "
        f"on the curve: {_digits(lebesgue)} of accuracy are gone. {_remedy(view)}"
    )


def _remedy(view: CurveView) -> str:
    if not view.source.family.derivatives:
        return "Spread the parameters more evenly in Chebyshev's way, or use a Hermite curve."
    return (
        "The estimated velocities carry it along. Spread the parameters more evenly, "
        "or set the velocities beside the narrow gaps by hand."
    )


def _digits(lebesgue: float) -> str:
    return f"{int(np.log10(lebesgue))} digits" if np.isfinite(lebesgue) else "all digits"
