"""Warnings about the numbers of a curve."""

from __future__ import annotations

import enum

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..curve_view import CurveView
from ..growth import growth_of_points
from .wording import short

LARGE_LEBESGUE = 100.0
"""The Lebesgue constant above which two digits of the points' accuracy are gone."""

_LOOK_CLOSER, _MOST_EXACT = 90.0, 60

NARROW = 1e-2
"""A gap between neighbouring t is narrow below this share of the wider gap beside it; Chebyshev's parameters,
however many, never come below a third."""


class Topic(enum.Enum):
    """The subjects of warnings."""

    LEBESGUE = enum.auto()
    GAP = enum.auto()


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
    # Past its points a curve is in no hurry between two of them.
    gap = _narrowest(view.parameters) if view.source.family.interpolates else None
    if gap is not None:
        knot, width, wider = gap
        found.append(
            Warned(
                Topic.GAP,
                "⚠ t almost equal",
                f"The parameters of points {view.owner(knot)} and {view.owner(knot + 1)} are only "
                f"{short(width)} apart, {short(wider / width)} times less than the next ones: the curve must "
                "get from one to the other in no time, and the smallest error shows.",
            )
        )
    if lebesgue > _LOOK_CLOSER and len(view.parameters) <= _MOST_EXACT and view.basis_curve is not None:
        lebesgue = growth_of_points(view)
    if lebesgue > LARGE_LEBESGUE:
        found.append(
            Warned(
                Topic.LEBESGUE,
                f"⚠ Λ {short(lebesgue)}",
                f"An error in a point, even one of rounding, can come out {short(lebesgue)} times as large "
                f"on the curve: {_digits(lebesgue)} of accuracy are gone. {_remedy(view)}",
            )
        )
    return found


def _narrowest(parameters: FloatArray) -> tuple[int, float, float] | None:
    """Return the knot before the narrowest gap, its width and that of the wider one beside it, if narrow."""
    gaps = np.diff(parameters)
    if len(gaps) < 2:
        return None
    wider = np.maximum(np.append(gaps[1:], 0.0), np.insert(gaps[:-1], 0, 0.0))
    knot = int(np.argmin(gaps / wider))
    narrow = gaps[knot] < NARROW * wider[knot]
    return (knot, float(gaps[knot]), float(wider[knot])) if narrow else None


def _remedy(view: CurveView) -> str:
    if not view.source.family.derivatives:
        return "Spread the parameters more evenly in Chebyshev's way, or use a Hermite curve."
    return (
        "The estimated velocities carry it along. Spread the parameters more evenly, "
        "or set the velocities beside the narrow gaps by hand."
    )


def _digits(lebesgue: float) -> str:
    return f"{int(np.log10(lebesgue))} digits" if np.isfinite(lebesgue) else "all digits"
