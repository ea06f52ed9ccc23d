"""Bounds of curves, curves that fill a box, and transforms found from the points."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.document.point_group import points_of
from app.document.several_curves import move_group, transform_group, whole_curves
from app.document.transforms import reflection, rotation, scaling
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.view_model.boxes import Bounds, bounds_of
from app.view_model.curve.curve_view import view_of
from app.view_model.pivot import Pivot, Turning, anchored
from app.view_model.resize import stretched
from tests.effort import calls_of
from tests.rows import each_row

POINTS = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5), (6.0, 1.0)]
RULES = [kind for kind in ParametrizationKind if kind is not ParametrizationKind.MANUAL]


def document_of(family, kind=ParametrizationKind.CHORD_LENGTH, count=1):
    curve = replace(make_curve(POINTS, family=family), parametrization=Parametrization(kind=kind))
    shifted = [[(x + k, y - 3 * k) for x, y in POINTS] for k in range(1, count)]
    others = [replace(make_curve(each, name=f"C{k}", family=family)) for k, each in enumerate(shifted)]
    return Document((curve, *others))


def views_of(document):
    return [view_of(curve) for curve in document.curves]


def sampled(views):
    places = np.vstack([view.curve.evaluate(np.linspace(*view.curve.domain, 40_001)) for view in views])
    return np.array([places.min(axis=0), places.max(axis=0)])


def as_array(bounds):
    return np.array([bounds.low, bounds.high])


@pytest.mark.parametrize("family", FAMILIES)
def test_the_bounds_of_whole_curves_are_those_of_the_curves(family):
    document = document_of(family, count=3)
    views = views_of(document)
    found = as_array(bounds_of(views, whole_curves(document, {0, 1, 2})))
    expected = sampled(views)
    # |c''| Δt² / 8 with |c''| up to some 10³; never outside of what was found, but for rounding.
    assert found == pytest.approx(expected, abs=1e-6)
    assert (found[0] <= expected[0] + 1e-13).all()
    assert (found[1] >= expected[1] - 1e-13).all()


def test_of_many_drawn_curves_only_those_at_the_edges_are_measured():
    """All 2,000 of a drawing were, for 6 s of an import of paths with corners."""
    rng = np.random.default_rng(5)
    curves = [
        make_curve(rng.uniform(0, 40, 2) + rng.uniform(0, 5, (5, 2)), family=HERMITE) for _ in range(450)
    ]
    document = Document(tuple(curves))
    group = whole_curves(document, range(len(curves)))
    exact = bounds_of(views_of(document), group)
    drawn = views_of(document)
    for view in drawn:
        _ = view.extent
    assert bounds_of(drawn, group) == exact
    assert 2 <= sum("bounds" in view.__dict__ for view in drawn) < 40


def test_the_bounds_of_some_points_are_those_of_the_points():
    document = document_of(FAMILIES.named("lagrange"))
    assert bounds_of(views_of(document), points_of(0, {1, 3})) == Bounds((1.0, 0.5), (4.0, 2.0))


def test_an_empty_group_has_no_bounds():
    document = document_of(FAMILIES.named("lagrange"))
    assert bounds_of(views_of(document), points_of(0, ())) is None


@each_row("kind", RULES)
@each_row("family", FAMILIES)
def test_curves_fill_a_given_box_exactly(family, kind):
    document = document_of(family, kind)
    views, group = views_of(document), whole_curves(document, {0})
    wanted = ((-1.0, 2.0), (6.5, 3.5))
    new = stretched(document, views, group, wanted)
    reached = as_array(bounds_of(views_of(new), group))
    # Rounding of numbers of about 6, and of curves that swing.
    assert reached == pytest.approx(np.array(wanted), abs=1e-11)


def narrowed(seed, family):
    """A walk whose box is to have 0.3 of its width: the document, the box, and what fills it."""
    rng = np.random.default_rng(seed)
    walk = np.cumsum(rng.normal(size=(8, 2)), axis=0)
    document = Document((make_curve(walk.tolist(), family=family),))
    views, group = views_of(document), whole_curves(document, {0})
    (left, bottom), (right, top) = as_array(bounds_of(views, group)).tolist()
    wanted = ((left, bottom), (left + 0.3 * (right - left), top))
    return document, np.array(wanted), lambda: stretched(document, views, group, wanted)


@pytest.mark.parametrize("seed", [9, 31, 32])
def test_curves_whose_bounds_oscillate_fill_a_given_box(seed):
    """Forty corrections, each by what the last one reached, left these 0.2 to 2 away from their boxes."""
    _, wanted, stretch = narrowed(seed, LAGRANGE)
    new = stretch()
    reached = as_array(bounds_of(views_of(new), whole_curves(new, {0})))
    assert reached == pytest.approx(wanted, abs=1e-11)


def test_smooth_curves_take_some_ten_corrections():
    """They took thirty; of hundreds of curves each takes a tenth of a second."""
    document, _, stretch = narrowed(3, HERMITE)
    once = calls_of(lambda: bounds_of(views_of(document), whole_curves(document, {0})))
    assert calls_of(stretch) < 20 * once


def test_exchanged_corners_mirror():
    document = document_of(FAMILIES.named("hermite"), ParametrizationKind.UNIFORM)
    views, group = views_of(document), whole_curves(document, {0})
    low, high = as_array(bounds_of(views, group)).tolist()
    new = stretched(document, views, group, ((high[0], low[1]), (low[0], high[1])))
    xs = [point.x for point in new.curves[0].points]
    assert xs == pytest.approx([low[0] + high[0] - x for x, _ in POINTS], abs=1e-14)


MAPS = {
    "turn": rotation(37.0, (1.0, 2.0)),
    "scale": scaling(2.0, 2.0, (1.0, 2.0)),
    "stretch": scaling(2.0, 0.5, (1.0, 2.0)),
    "flip": reflection(0, (1.0, 2.0)),
}


@pytest.mark.parametrize("how", MAPS)
@pytest.mark.parametrize("indices", [{0, 1, 2, 3, 4}, {0, 1, 3}, {2, 3}])
def test_the_pivot_follows_the_transform(how, indices):
    if how == "stretch" and len(indices) == 2:
        pytest.skip("two points tell no stretch from a turn")
    document = document_of(FAMILIES.named("hermite"), ParametrizationKind.UNIFORM)
    group, place = points_of(0, indices), (5.0, -3.0)
    pivot = Pivot(place, anchored(views_of(document), group))
    new = transform_group(document, group, MAPS[how])
    found = pivot.at(anchored(views_of(new), group))
    if how == "flip" and len(indices) == 2:
        # A turn maps two points as well; it has the same middle.
        assert found.anchor.points.mean(axis=0) == pytest.approx((2 - 3.5, 1.5))
    else:
        assert found.position == pytest.approx(MAPS[how].point(place), abs=1e-9)
    assert pivot.at(
        anchored(views_of(move_group(document, group, (2.0, 1.0))), group)
    ).position == pytest.approx((7.0, -2.0))


def test_the_centre_of_a_rotation_stays_to_the_last_bit():
    document = document_of(FAMILIES.named("hermite"))
    group, place = points_of(0, range(5)), (0.1, 0.7)
    pivot = Pivot(place, anchored(views_of(document), group))
    for _ in range(5):
        document = transform_group(document, group, rotation(72.0, place))
        pivot = pivot.at(anchored(views_of(document), group))
    assert pivot.position == place


def test_points_edited_one_by_one_keep_the_pivot_and_another_selection_has_no_pivot():
    document = document_of(FAMILIES.named("hermite"))
    pivot = Pivot((5.0, -3.0), anchored(views_of(document), points_of(0, range(5))))
    edited = move_group(document, points_of(0, {2}), (0.3, 1.0))
    assert pivot.at(anchored(views_of(edited), points_of(0, range(5)))).position == (5.0, -3.0)
    assert pivot.at(anchored(views_of(document), points_of(0, {1, 2}))) is None


@each_row("degrees", [0.0, 30.0, -135.0, 180.0])
def test_the_angle_follows_from_the_points(degrees):
    document = document_of(FAMILIES.named("hermite"))
    group = points_of(0, range(5))
    before = anchored(views_of(document), group)
    new = transform_group(
        transform_group(document, group, rotation(degrees, (3.0, 3.0))), group, scaling(2.0, 2.0, (0.0, 1.0))
    )
    turned = Turning(before).at(anchored(views_of(move_group(new, group, (1.0, 1.0))), group))
    assert turned % 360.0 == pytest.approx(degrees % 360.0, abs=1e-9)
