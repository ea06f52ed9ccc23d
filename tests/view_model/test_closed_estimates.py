"""Estimates of closed curves: distances of t that are small beside a turn stay exact in every turn."""

from fractions import Fraction

import numpy as np
import pytest

from app.document.derivatives import VelocityRule
from app.document.model import Curve, Parametrization, ParametrizationKind, Point
from app.families import HERMITE
from app.view_model.curve.curve_view import view_of
from curvecore import CubicSplineCurve

TIMES, END = (0.3, 1.3, 1.3 + 2.0**-40, 2.3), 2.3 + 2.0**-30
PLACES = ((0.0, 0.0), (3.0, 1.0), (3.0, 1.0 + 2.0**-40), (1.0, 2.0))


def velocities(rule):
    """The curve and its velocities under a rule."""
    points = tuple(Point(x, y, t=t) for (x, y), t in zip(PLACES, TIMES, strict=True))
    times = Parametrization(ParametrizationKind.MANUAL, start=TIMES[0], end=END)
    view = view_of(Curve("Loop", HERMITE, times, points, velocity_rule=rule, closed=True))
    assert view.curve is not None
    return view.curve, view.curve.jets[:, 1]


def test_slopes_across_the_end_are_as_exact_as_the_parameters():
    """The mean of the slopes at the first point was off by 1.8e-7: t behind the end was rounded."""
    _, found = velocities(VelocityRule.FINITE_DIFFERENCE)
    t = [Fraction(each) for each in (*TIMES, END)]
    before = [-Fraction(end) / (t[4] - t[3]) for end in PLACES[3]]
    after = [Fraction(end) / (t[1] - t[0]) for end in PLACES[1]]
    exact = [float((one + other) / 2) for one, other in zip(before, after, strict=True)]
    assert found[0] == pytest.approx(exact, rel=1e-15)


def test_a_closed_spline_is_the_same_by_its_velocities():
    """Of the periodic spline, solved in one turn, velocities were off by 3.6e-7."""
    curve, found = velocities(VelocityRule.NATURAL_SPLINE)
    exact = CubicSplineCurve(curve.points, curve.parameters, ends="periodic").evaluate(curve.parameters, 1)
    assert (np.abs(found - exact).max(axis=1) <= 1e-11 * np.linalg.norm(exact, axis=1)).all()
