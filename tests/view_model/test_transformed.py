"""Views of mapped curves equal views made from nothing, and need no core curve."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import point_edits, rule_edits
from app.document.derivatives import VelocityRule
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point, make_curve
from app.document.several_curves import move_group, transform_group, whole_curves
from app.document.transforms import Affine, reflection, rotation, scaling
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.view_model.boxes import compute_boxes, exact_box
from app.view_model.curve.curve_view import CurveView, view_of
from app.view_model.curve.transformed import views_after
from curvecore.bezier.flatten import segment_distance

PLACES = ((0.0, 0.0), (1.0, 2.0), (3.0, 1.0), (4.0, 3.0), (5.5, 0.0))
LOCAL = [family for family in FAMILIES if family.curve_class.is_local or not family.interpolates]
SKEW = Affine(0.3, 0.4, -0.2, 0.1, (1.0, 1.0), (0.5, 0.25))
MAPS = {
    "moved": Affine(0.0, 0.0, 0.0, 0.0, (0.0, 0.0), (0.1, 1 / 3)),
    "flipped": reflection(0, (0.3, 0.1)),
    "turned": rotation(37.0, (2.0, 1.0)),
    "made larger": scaling(2.5, 2.5, (0.1, 0.1)),
}


def several(family, kind=ParametrizationKind.CENTRIPETAL, **values) -> Document:
    """A curve, a larger one far away, a closed one, one with a corner and one with a velocity set."""
    curve = replace(make_curve(PLACES, family=family), **values)
    curves = [curve, curve, replace(curve, closed=family.curve_class.can_close), curve, curve]
    document = Document(tuple(curves))
    document = move_group(document, whole_curves(document, [1]), (300.0, -200.0))
    document = transform_group(document, whole_curves(document, [1]), scaling(7.0, 3.0, (300.0, -200.0)))
    if family.derivatives:
        document = point_edits.make_corner(document, 3, 2, (1.0, 0.5), None)
        document = point_edits.set_velocity(document, 4, 1, (2.0, -1.0))
    for place in range(len(curves)):
        document = rule_edits.set_parametrization(document, place, kind, [0.0, 0.2, 0.5, 0.6, 1.0])
    return document


@pytest.mark.parametrize("name", ["moved", "flipped", "made larger"])
@pytest.mark.parametrize("is_known", [True, False])
def test_exact_boxes_are_mapped_and_contain_the_points_to_the_last_digit(name, is_known):
    """A box took a millisecond for each curve that was moved: its curve was made and asked where it turns."""
    document = several(HERMITE)
    before = extended_views(document)
    if is_known:
        compute_boxes(before)
    after = transform_group(document, whole_curves(document, range(len(before))), MAPS[name])
    carried = views_after(after.curves, before)
    compute_boxes(carried)
    assert all(view.is_followed for view in carried)
    anew = [view_of(view.source) for view in carried]
    compute_boxes(anew)
    ends = 0
    for view, fresh in zip(carried, anew, strict=True):
        box, expected = exact_box(view), exact_box(fresh)
        size = np.abs(expected).max()
        assert box == pytest.approx(expected, rel=0.0, abs=1e-14 * size)
        by_points = expected == fresh.extent[0]
        assert (box[by_points] == expected[by_points]).all()
        ends += by_points.sum()
    assert ends > 3


def extended_views(document: Document) -> list[CurveView]:
    views = [view_of(curve) for curve in document.curves]
    assert all(len(view.extent) for view in views)
    return views


def after(document: Document, by: Affine, views: list[CurveView]) -> tuple[Document, list[CurveView]]:
    document = transform_group(document, whole_curves(document, range(len(views))), by)
    return document, views_after(document.curves, views)


def off(view: CurveView, tolerance: float, points: np.ndarray, t: np.ndarray) -> float:
    """How far points of the curve are off its polyline at most, in tolerances."""
    line = view.flattened(tolerance)
    piece = np.clip(np.searchsorted(line.parameters, t, side="right") - 1, 0, len(line.parameters) - 2)
    return segment_distance(points, line.points[piece], line.points[piece + 1]).max() / tolerance


def assert_right(views: list[CurveView]) -> None:
    """Drawn as closely as views made from nothing, and the same curves once somebody asks."""
    for view in views:
        fresh = view_of(view.source)
        t = np.linspace(*fresh.curve.domain, 400)
        points, size = fresh.curve.evaluate(t), float(np.hypot(*np.ptp(fresh.points, axis=0)))
        # The second is finer than what was mapped, the third so fine that the curve itself is asked.
        assert max(off(view, share * size, points, t) for share in (1e-3, 1e-4, 1e-6)) <= 1.0
        assert np.allclose(view.extent, fresh.extent, rtol=0.0, atol=2e-3 * size)
        assert np.array_equal(view.curve.jets, fresh.curve.jets)
        assert np.array_equal(view.curve.parameters, fresh.curve.parameters)
        assert not view.problem


@pytest.mark.parametrize("by", MAPS.values(), ids=MAPS)
@pytest.mark.parametrize("kind", [ParametrizationKind.CENTRIPETAL, ParametrizationKind.MANUAL])
@pytest.mark.parametrize("family", LOCAL, ids=str)
def test_mapped_curves_need_no_core_curve(family, kind, by):
    document = several(family, kind)
    views = extended_views(document)
    for _ in range(3):
        document, views = after(document, by, views)
        assert all(view.curve_map is not None and view.is_followed for view in views)
    assert_right(views)


def test_lengths_that_a_map_changes_are_computed_again():
    """Centripetal parameters are others after a skew, and equal ones are the same."""
    by_length, uniform = several(HERMITE), several(HERMITE, ParametrizationKind.UNIFORM)
    _, made = after(by_length, SKEW, extended_views(by_length))
    _, kept = after(uniform, SKEW, extended_views(uniform))
    assert not any(view.curve_map for view in made)
    assert all(view.curve_map for view in kept)
    assert_right([*made, *kept])


@pytest.mark.parametrize("family", [HERMITE, LAGRANGE], ids=str)
def test_a_curve_that_is_not_mapped_whole_gets_a_core_curve(family):
    rule = VelocityRule.AKIMA if family is HERMITE else VelocityRule.NATURAL_SPLINE
    document = several(family, velocity_rule=rule)
    views = extended_views(document)
    _, made = after(document, MAPS["moved"], views)
    assert not any(view.curve_map for view in made)
    assert_right(made)


def test_a_move_of_some_points_or_without_derivatives_is_no_map():
    document = several(HERMITE)
    views = extended_views(document)
    some = point_edits.move_points(document, 0, {0, 1}, (0.5, 0.5))
    turned = tuple(
        replace(curve, points=tuple(replace(point, x=-point.x) for point in curve.points))
        for curve in document.curves[3:]
    )
    changed = views_after((some.curves[0], *document.curves[1:3], *turned), views)
    assert [view.curve_map is not None for view in changed] == [False, True, True, False, False]
    assert_right(changed)


def test_a_curve_scaled_to_a_dot_is_drawn():
    """A tolerance of 0 was asked for, while the canvas was painted."""
    points = tuple(Point(1.0, 1.0, t, (0.0, 0.0)) for t in (0.0, 1.0))
    dot = Curve("Dot", HERMITE, Parametrization(ParametrizationKind.MANUAL), points)
    document = Document((dot, dot))
    _, views = after(document, scaling(0.0, 0.0, (1.0, 1.0)), extended_views(document))
    assert all(view.curve_map for view in views)
    assert [view.flattened(0.1).points.tolist() for view in views] == [[[1.0, 1.0]] * 2] * 2
