"""When the numbers of a curve deserve a word of warning, and which."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from app.view_model.analysis.wording import short
from app.view_model.curve_view import CurveView
from curvecore.stability import lebesgue_constant

LARGE_LEBESGUE = 100.0
"""The Lebesgue constant above which two digits of the points' accuracy are gone."""

_LOOK_CLOSER, _MOST_EXACT = 90.0, 60

NARROW = 1e-3
"""A gap of neighbouring t is narrow below this share of the mean gap."""


class Topic(enum.Enum):
    """What a warning is about."""

    LEBESGUE = enum.auto()
    GAP = enum.auto()


@dataclass(frozen=True)
class Warned:
    """A warning.

    Attributes
    ----------
    topic
        What it is about.
    badge
        A sign and a word or two.
    sentence
        What it means.
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
    gaps = np.diff(view.parameters)
    narrow = int(np.argmin(gaps))
    if len(gaps) > 1 and gaps[narrow] < NARROW * gaps.mean():
        first, second = view.owner(narrow), view.owner(narrow + 1)
        found.append(
            Warned(
                Topic.GAP,
                "⚠ t almost equal",
                f"The parameters of points {first} and {second} are only {short(float(gaps[narrow]))} apart, "
                f"{short(float(gaps.mean() / gaps[narrow]))} times less than usual: "
                "the curve is forced from one to the other in no time, and the smallest error shows.",
            )
        )
    if lebesgue > _LOOK_CLOSER and len(view.parameters) <= _MOST_EXACT and view.skeleton is not None:
        lebesgue = lebesgue_constant(view.skeleton)
    if lebesgue > LARGE_LEBESGUE:
        found.append(
            Warned(
                Topic.LEBESGUE,
                f"⚠ Λ {short(lebesgue)}",
                f"An error in a point, even one of rounding, can come out {short(lebesgue)} times as large "
                f"on the curve: {_digits(lebesgue)} of accuracy are gone. Spread the parameters "
                "more evenly in Chebyshev's way, or use a Hermite curve.",
            )
        )
    return found


def _digits(lebesgue: float) -> str:
    count = int(np.log10(lebesgue))
    return f"{count} digits"
