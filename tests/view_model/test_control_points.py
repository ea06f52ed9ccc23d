"""Sentences and drawings of curves that do not pass their points."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from app.document.limits import EditError
from app.document.model import make_curve
from app.document.words import short
from app.families import FAMILIES
from app.view_model.analysis.joints import certificate_of
from app.view_model.analysis.overlays.bezier import BEZIER
from app.view_model.analysis.overlays.vectors import VELOCITIES
from app.view_model.analysis.picture import live_picture
from app.view_model.analysis.settings import AnalysisSettings
from app.view_model.analysis.warnings import Topic, warnings_of
from app.view_model.analysis.wiggle import explain
from app.view_model.basis import weights_at
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.handles import control_polygon
from app.view_model.join import joined

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0))


@pytest.fixture(params=["bezier", "b_spline"])
def name(request):
    return request.param


def test_a_curve_of_control_points_has_no_warning_about_narrow_gaps(name):
    """The badge said that the curve must get from one point to the other in no time."""
    points = [(0.0, 0.0), (1.0, 2.0), (1.0001, 2.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0)]
    beside, through = (view_of(make_curve(points, family=FAMILIES.named(each))) for each in (name, "hermite"))
    assert warnings_of(beside, 1.0) == []
    assert [each.topic for each in warnings_of(through, 1.0)] == [Topic.GAP]


def test_a_wiggle_between_control_points_is_explained(name):
    """It said how far the curve leaves the straight line between two points that it does not pass."""
    view = view_of(make_curve(POINTS, family=FAMILIES.named(name)))
    found = explain(view, 0.45)
    strongest = int(np.argmax(weights_at(view, 0.45)))
    away = float(np.hypot(*(view.curve.evaluate(0.45) - view.points[strongest])))
    assert found.sentences[0].startswith(f"Point {strongest} pulls hardest, with weight ")
    assert f"passes it at a distance of {short(away)}" in found.sentences[0]
    assert "stays in the hull" in found.sentences[1]
    assert "go through" not in " ".join(explain(view, float(view.parameters[2])).sentences)


def test_joints_lie_on_the_curve_not_at_its_points():
    view = view_of(make_curve(POINTS, family=FAMILIES.named("b_spline")))
    certificate = certificate_of(view)
    assert [row.joint for row in certificate.rows] == [2, 3]
    for row in certificate.rows:
        assert row.t == view.parameters[row.joint]
        assert row.position == pytest.approx(tuple(view.curve.evaluate(row.t)), abs=1e-15)
        assert row.smoothness == "C²"
        # The third derivative of cubics jumps.
        assert row.jumps[:3] == (0.0, 0.0, 0.0)
        assert row.jumps[3] > 1.0
    assert certificate.summary == "C² everywhere."


def test_arrows_begin_on_the_curve(name):
    """They began at the control points."""
    view = view_of(make_curve(POINTS, family=FAMILIES.named(name)))
    settings = AnalysisSettings(overlays=frozenset([VELOCITIES]))
    (figure,) = [each for each in live_picture(view, settings, 2.0).figures if len(each.points) > 2]
    assert figure.points[::2] == pytest.approx(view.curve.evaluate(view.parameters), abs=1e-15)


def test_the_bezier_polygon_of_a_high_degree_is_that_of_its_points():
    """It said that no control points were known."""
    points = [(float(x), float(x * x % 7)) for x in range(20)]
    view = view_of(make_curve(points, family=FAMILIES.named("bezier")))
    figures = live_picture(view, AnalysisSettings(overlays=frozenset([BEZIER])), 2.0).figures
    assert figures[0].points[:20].tolist() == [list(point) for point in points]


def test_the_control_polygon_consists_of_handles(name):
    view = view_of(make_curve(POINTS, family=FAMILIES.named(name)))
    assert [(each.anchor, each.position) for each in control_polygon(view)] == list(pairwise(POINTS))
    assert control_polygon(view_of(make_curve(POINTS))) == []


def test_curves_that_cannot_be_joined_must_be_converted_first(name):
    first, second = (
        view_of(make_curve([(x + by, y) for x, y in POINTS], family=FAMILIES.named(name)))
        for by in (0.0, 7.0)
    )
    title = first.source.family.title
    with pytest.raises(EditError, match=f"Two {title} curves cannot be joined.* first, keeping the shape"):
        joined(first, second)
