"""Facts about curves: arc length against closed forms, boxes, warnings."""

import math

import numpy as np
import pytest

from app.document.model import (
    Curve,
    Document,
    Family,
    Node,
    Parametrization,
    ParametrizationKind,
)
from app.exchange.facts import arc_length, facts_of
from app.view_model.curve_view import view_of
from curvecore import HermiteCurve, LagrangeCurve


def test_the_length_of_a_line_and_of_a_parabola():
    line = LagrangeCurve([(0, 0), (3, 4)], [0, 1])
    assert arc_length(line, 1e-12).value == pytest.approx(5, rel=1e-14)
    parabola = LagrangeCurve([(-1, 1), (0, 0), (1, 1)], [-1, 0, 1])
    exact = math.sqrt(5) + math.asinh(2) / 2
    assert arc_length(parabola, 1e-12).value == pytest.approx(exact, rel=1e-13)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_the_length_at_a_cusp_is_within_the_tolerance(tolerance):
    # (t², t³) on [-1, 1] has a cusp inside the segment: two arms of (13^1.5 - 8)/27 each.
    curve = HermiteCurve([(1, -1), (1, 1)], [(-2, 3), (2, 3)], [-1, 1])
    exact = 2 * (13**1.5 - 8) / 27
    length = arc_length(curve, tolerance)
    assert abs(length.value - exact) <= tolerance * exact
    assert abs(length.value - exact) <= 4 * length.error + 1e-14


def test_the_length_of_many_segments_adds_up():
    angle = np.linspace(0, 2 * np.pi, 2001)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    curve = HermiteCurve(circle, np.stack([-circle[:, 1], circle[:, 0]], axis=1), angle)
    assert arc_length(curve, 1e-9).value == pytest.approx(2 * np.pi, rel=1e-12)


def test_facts_of_the_examples(example):
    (facts,) = facts_of(example)
    curve = view_of(example.curves[0]).curve
    samples = curve.evaluate(np.linspace(*curve.domain, 20001))
    size = np.ptp(samples, axis=0).max()
    assert facts.points == len(curve.points)
    assert facts.degree == curve.degree
    assert facts.domain == curve.domain
    assert not facts.warnings
    edges = [*samples.min(axis=0), *samples.max(axis=0)]
    np.testing.assert_allclose(facts.box, edges, rtol=0, atol=2e-5 * size)
    polygon = np.hypot(*np.diff(samples, axis=0).T).sum()
    assert facts.length.value == pytest.approx(polygon, rel=1e-6)
    assert facts.length.value >= polygon * (1 - 1e-12)


def test_a_curve_that_cannot_be_made_says_why(half_drawn):
    line, begun = facts_of(half_drawn)
    assert line.warnings == ()
    assert begun.points == 1
    assert (begun.degree, begun.domain, begun.length, begun.box) == (None,) * 4
    assert begun.warnings == ("A curve needs at least two points.",)


def uniform(points):
    rule = Parametrization(ParametrizationKind.UNIFORM)
    return Document((Curve("", Family.LAGRANGE, rule, tuple(Node(*point) for point in points)),))


def test_growing_errors_are_mentioned():
    (facts,) = facts_of(uniform([(float(i), 0.0) for i in range(20)]))
    (warning,) = facts.warnings
    # The Lebesgue constant of 20 uniform points is 5889.6 (Trefethen & Weideman, J. Approx. Theory 65
    # (1991) 247-260 give its growth); sampling finds most of it.
    assert warning.startswith("Errors in the points grow up to 5.9e+03-fold")


def test_a_curve_beyond_all_floats_has_no_length_and_no_box():
    # Beyond forty parameters that nearly coincide, the polynomial grows like (1e24)**39.
    nodes = (*(Node(float(i), (-1.0) ** i, t=i * 1e-12) for i in range(40)), Node(0.0, 0.0, t=1e12))
    rule = Parametrization(ParametrizationKind.MANUAL)
    (facts,) = facts_of(Document((Curve("", Family.LAGRANGE, rule, nodes),)))
    assert (facts.length, facts.box) == (None, None)
    assert facts.warnings[0].startswith("“” swings beyond 1e+30 between its points")
    assert "Errors in the points grow beyond all bounds" in facts.warnings[1]


def test_a_lagrange_curve_of_very_many_points_is_not_measured_for_minutes():
    (facts,) = facts_of(uniform([(float(i), 0.0) for i in range(600)]))
    assert facts.length is None
