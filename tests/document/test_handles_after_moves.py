"""Handles of other points keep their positions when points move, under every parameter rule."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.constraints import with_handles_kept
from app.document.limits import EditError
from app.document.model import (
    Curve,
    Document,
    Parametrization,
    ParametrizationKind,
    Point,
)
from app.document.point_edits import delete_points, move_points, set_position
from app.document.point_group import points_of
from app.document.several_curves import step_group
from app.document.transforms import rotation, scaling, transform_points
from app.families import FAMILIES, HERMITE
from app.view_model.curve.curve_view import view_of
from tests.effort import calls_of
from tests.rows import each_row

BY_DISTANCE = (
    Parametrization(ParametrizationKind.CHORD_LENGTH),
    Parametrization(ParametrizationKind.CENTRIPETAL, start=-2.0, end=3.0),
    Parametrization(ParametrizationKind.POWER, alpha=0.8),
)
SHAPE = ((0, 0), (1, 2), (3, 1), (4, 4), (6, 3), (7, 0), (4, -2), (1, -1))
WITH_VELOCITIES = [family for family in FAMILIES if family.derivatives]


def document(rule, family=HERMITE, *, closed=False):
    """A curve all of whose derivatives are set, with a corner at point 5."""
    points = [
        Point(
            float(x),
            float(y),
            velocity=(3.0 + x, 2.0 - y),
            acceleration=(float(y), 5.0),
            jerk=(8.0 - x, x + y),
        )
        for x, y in SHAPE
    ]
    after = {"velocity_after": (1.0, -7.0), "acceleration_after": (2.0, 2.0), "jerk_after": (-9.0, 4.0)}
    points[5] = replace(points[5], corner=True, **after)
    return Document((Curve("Wave", family, rule, tuple(points), closed=closed),))


def controls(doc):
    """The Bezier control points of each segment, as a list of lists."""
    view = view_of(doc.curves[0])
    found = []
    for segment in range(len(view.parameters) - 1):
        h = view.spacing(view.owner(segment), ahead=True) or view.spacing(0, ahead=False)
        start, end = view.sides.after[segment], view.sides.before[segment + 1]
        degree = 2 * len(start) - 1
        found.append([start[0], start[0] + h * start[1] / degree, end[0] - h * end[1] / degree, end[0]])
        if degree >= 5:
            second = degree * (degree - 1)
            found[-1].append(start[0] + 2 * h * start[1] / degree + h * h * start[2] / second)
            found[-1].append(end[0] - 2 * h * end[1] / degree + h * h * end[2] / second)
        if degree == 7:
            found[-1].append(start[0] + 3 * h * start[1] / 7 + h * h * start[2] / 14 + h**3 * start[3] / 210)
            found[-1].append(end[0] - 3 * h * end[1] / 7 + h * h * end[2] / 14 - h**3 * end[3] / 210)
    return found


def same(a, b):
    return all(p == pytest.approx(q, abs=1e-12) for p, q in zip(a, b, strict=True))


@each_row("rule", BY_DISTANCE)
@each_row("family", WITH_VELOCITIES)
@each_row("closed", [False, True])
@each_row("index", [0, 3, 5, 7])
def test_a_moved_point_changes_only_the_two_adjacent_segments(rule, family, closed, index):
    before = document(rule, family, closed=closed)
    for after in (
        move_points(before, 0, {index}, (2.3, 0.7)),
        set_position(before, 0, index, (9.0, 9.0)),
        step_group(before, points_of(0, {index}), (-0.1, 0.2)),
    ):
        old, new = controls(before), controls(after)
        beside = {index - 1, index} if not closed else {(index - 1) % 8, index}
        assert all(same(old[k], new[k]) for k in range(len(old)) if k not in beside)


def handles(doc, segment):
    """The velocity handles of a segment, ahead of its start and behind its end."""
    start, ahead, behind, end = (np.array(point) for point in controls(doc)[segment][:4])
    return ahead - start, behind - end


@each_row("rule", BY_DISTANCE)
@each_row("family", WITH_VELOCITIES)
def test_independent_handles_keep_their_lengths(rule, family):
    """A point dragged far away made those of its neighbour at the end eight times as long."""
    before = document(rule, family)
    after = move_points(before, 0, {1}, (20.0, -30.0))
    # The first point has one handle, the last one too; both sides of a corner are their own.
    assert handles(after, 0)[0] == pytest.approx(handles(before, 0)[0], rel=1e-12)
    after = move_points(before, 0, {4}, (20.0, -30.0))
    assert handles(after, 4)[1] == pytest.approx(handles(before, 4)[1], rel=1e-12)
    assert handles(after, 5)[0] == pytest.approx(handles(before, 5)[0], rel=1e-12)


@pytest.mark.parametrize("rule", BY_DISTANCE)
def test_handles_of_a_moved_point_keep_their_total_length(rule):
    before = document(rule)
    after = move_points(before, 0, {3}, (5.0, 8.0))
    old, new = (np.hypot(*handles(each, 2)[1]) + np.hypot(*handles(each, 3)[0]) for each in (before, after))
    assert new == pytest.approx(old, rel=1e-12)


@each_row("rule", BY_DISTANCE)
@each_row("family", WITH_VELOCITIES)
@each_row("by", [rotation(30.0, (1.0, 1.0)), scaling(2.0, 2.0, (0.0, 0.0)), scaling(0.5, 0.5, (3.0, 1.0))])
def test_points_transformed_together_transform_their_handles(rule, family, by):
    before = document(rule, family)
    chosen = {2, 3, 4, 5}
    old, new = controls(before), controls(transform_points(before, 0, chosen, by))
    for segment in (2, 3, 4):
        assert same([by.point(tuple(p)) for p in old[segment]], [tuple(p) for p in new[segment]])
    for segment in (0, 6):
        assert same(old[segment], new[segment])


@each_row("rule", [*BY_DISTANCE, Parametrization(ParametrizationKind.UNIFORM)])
def test_a_transform_of_all_points_transforms_the_curve(rule):
    before, by = document(rule), scaling(3.0, 3.0, (1.0, 2.0))
    old, new = controls(before), controls(transform_points(before, 0, range(8), by))
    for segment in range(7):
        assert same([by.point(tuple(p)) for p in old[segment]], [tuple(p) for p in new[segment]])


@each_row("rule", [*BY_DISTANCE, Parametrization(ParametrizationKind.UNIFORM)])
def test_segments_far_from_a_deleted_point_stay(rule):
    before = document(rule)
    old, new = controls(before), controls(delete_points(before, 0, {4}))
    assert all(same(old[k], new[k]) for k in (0, 1, 2))
    assert all(same(old[k], new[k - 1]) for k in (5, 6))


@pytest.mark.parametrize(
    "kind", [ParametrizationKind.UNIFORM, ParametrizationKind.CHEBYSHEV, ParametrizationKind.MANUAL]
)
def test_derivatives_stay_under_rules_without_distances(kind):
    before = document(Parametrization(kind))
    points = tuple(replace(point, t=k / 7) for k, point in enumerate(before.curves[0].points))
    before = before.with_curve(0, replace(before.curves[0], points=points))
    after = move_points(before, 0, {3}, (5.0, 5.0))
    assert [point.velocity for point in after.curves[0].points] == [point.velocity for point in points]


@pytest.mark.parametrize("rule", BY_DISTANCE)
def test_moving_a_point_and_back_restores_the_document(rule):
    before = document(rule)
    away = move_points(before, 0, {3}, (0.5, 0.25))
    assert move_points(before, 0, {3}, (0.0, 0.0)) == before
    back = move_points(away, 0, {3}, (-0.5, -0.25)).curves[0].points
    for one, other in zip(back, before.curves[0].points, strict=True):
        assert one.velocity == pytest.approx(other.velocity, rel=1e-14)


def test_coincident_points_keep_finite_derivatives():
    rule = BY_DISTANCE[0]
    points = tuple(Point(1.0, 1.0, velocity=(1.0, 0.0)) for _ in range(3))
    before = Document((Curve("Heap", HERMITE, rule, points),))
    after = move_points(before, 0, {1}, (1.0, 0.0))
    assert [point.velocity for point in after.curves[0].points] == [(1.0, 0.0)] * 3


def test_a_derivative_beyond_the_limits_is_refused():
    points = (Point(0.0, 0.0, velocity=(9e11, 0.0)), Point(1e-6, 0.0), Point(2e-6, 0.0))
    before = Document((Curve("Tiny", HERMITE, BY_DISTANCE[0], points),))
    with pytest.raises(EditError, match="derivative"):
        move_points(before, 0, {2}, (1.0, 0.0))


@each_row("rule", BY_DISTANCE)
@each_row(("is_corner", "calls"), [(False, 19), (True, 50)])
def test_a_curve_moved_as_a_whole_keeps_its_derivatives_quickly(rule, is_corner, calls):
    """Thousands of curves are moved at once."""
    points = [
        Point(np.cos(k), np.sin(3 * k), velocity=(1.0 + k, 2.0), corner=is_corner, velocity_after=(1.0, -k))
        for k in range(300)
    ]
    before = Curve("Whole", HERMITE, rule, tuple(points))
    # Distances differ by roundings; the second map has turned the derivatives.
    for x, sign in ((0.1, 1.0), (0.2, -1.0)):
        there = [
            replace(
                each,
                x=sign * each.x + x,
                y=each.y + 0.7,
                velocity=(sign * each.velocity[0], 2.0),
                velocity_after=(sign, each.velocity_after[1]),
            )
            for each in points
        ]
        after = replace(before, points=tuple(there))
        assert with_handles_kept(before, after, range(300)) == after
        assert calls_of(lambda after=after: with_handles_kept(before, after, range(300))) < 300 * calls
