"""Refusals of the core in the words of the screen: points, t₁, and typed numbers."""

import re

import pytest
from msgspec.structs import replace

from app.document.model import Curve, Parametrization, ParametrizationKind, Point, make_curve
from app.families import HERMITE
from app.view_model.curve.core_curve import in_words
from app.view_model.curve.curve_view import view_of
from curvecore import CurveError, LagrangeCurve
from tests.rows import each_row

MANUAL = Parametrization(ParametrizationKind.MANUAL, start=-50.0, end=0.25)


def manual(*times, closed=False, corner=None, family=HERMITE):
    points = tuple(Point(float(i), float(i * i), t, corner=i == corner) for i, t in enumerate(times))
    return Curve("", family, MANUAL, points, closed=closed)


@each_row(
    ("curve", "sentence"),
    [
        (manual(5.0, -32.0, 6.0), "t₁ = −32 must be greater than t₀ = 5."),
        (manual(0.0, 0.1, 0.1), "t₂ = 0.1 must be greater than t₁ = 0.1."),
        # A corner ends a piece of the core, which counts from its own beginning.
        (manual(0.0, 1.0, 2.0, 4.0, 3.5, 5.0, corner=2), "t₄ = 3.5 must be greater than t₃ = 4."),
        (
            manual(0.0, 0.1, 0.5, closed=True),
            "t₂ = 0.5 must be less than 0.25, where the curve returns to its first point.",
        ),
        (
            replace(
                make_curve([(0.0, 0.0), (1e-9, 0.0), (1e9, 0.0)]),
                parametrization=Parametrization(ParametrizationKind.CHORD_LENGTH, start=-32.0, end=8.0),
            ),
            "t₀ and t₁ are the same number, −32: for an interval from −32 to 8 "
            "points 0 and 1 lie too close together.",
        ),
        (
            make_curve([(0.0, 0.0), (1.0, 2.0), (1.0, 2.0)]),
            "Points 1 and 2 coincide; chord-length parameters need distinct consecutive points.",
        ),
        (
            replace(make_curve([(0.0, 0.0), (1.0, 2.0), (0.0, 0.0)], family=HERMITE), closed=True),
            "Points 2 and 0 coincide; chord-length parameters need distinct consecutive points.",
        ),
    ],
)
def test_a_refused_curve_has_a_reason_in_the_terms_of_the_window(curve, sentence):
    """It said "parameters[1] = -32.0 does not exceed parameters[0]"."""
    problem = view_of(curve).problem
    assert problem == sentence
    assert not re.search(r"\w\[\d|-\d|\d\.0\b", problem)


def test_indexed_entries_of_a_reason_are_translated_into_point_terms():
    said = in_words("points[3, 1] is nan; velocities[0, 0] = -2.50 and parameters[12] = 1e+20, at least 3")
    assert said == "y of point 3 is nan; vx of point 0 = −2.5 and t₁₂ = 1e+20, at least 3"


def test_the_core_stays_precise():
    with pytest.raises(
        CurveError, match=re.escape("parameters[1] = -32.0 does not exceed parameters[0] = 5.0")
    ):
        LagrangeCurve([[0, 0], [1, 1]], [5, -32])
