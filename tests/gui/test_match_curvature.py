"""Match Curvature with real events; curvatures, and the least change, by exact control points."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from app.document.derivatives import VelocityRule
from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from app.view_model.match_curvature import MOST_JOINTS
from app.view_model.point_kinds import SMOOTH, kind_at, with_corners, with_smooth_points
from tests.exact_pieces import curvature_at, pieces_of

WAVE = ((0, 0), (2, 2), (4, 2.5), (6, 1.5), (7, -1))
RING = ((0, 0), (3, 2.5), (6, 1), (5, -2), (1.5, -2.4))
ROUNDING = 2e-14
"""Relative error of two curvatures: heights of handles are differences of coordinates ten times as large."""


def begin(editor, *curves):
    editor.session.commit(Document(curves), "Begin", active=0)
    editor.fit()
    return editor


def smooth(family=HERMITE, points=WAVE, at=(1, 2, 3), factors=((0.8, 1.3), (1.2, 0.7), (0.9, 1.1)), **fields):
    """A curve with smooth points, whose two speeds, and accelerations, are set and differ."""
    curve = replace(make_curve(points, family=family), **fields)
    view = view_of(curve)
    tied = list(with_smooth_points(view, at).points)
    for point, (before, after) in zip(at, factors, strict=True):
        if family is not HERMITE:
            tied[point] = replace(
                tied[point], acceleration=(3.0 * before, -9.0), acceleration_after=(1.0, -4.0 * after)
            )
        tied[point] = replace(
            tied[point],
            velocity=tuple(before * x for x in tied[point].velocity),
            velocity_after=tuple(after * x for x in tied[point].velocity_after),
        )
    return replace(curve, points=tuple(tied))


def curvatures(editor, point, curve=None):
    """The curvatures before and after a point, from exact control points."""
    view = editor.session.views[editor.session.active_index if curve is None else curve]
    pieces = pieces_of(view)
    return curvature_at(pieces[point - 1], Fraction(1)), curvature_at(
        pieces[point % len(pieces)], Fraction(0)
    )


def handle_lengths(view, point):
    """The lengths of the handles before and after a point."""
    pieces = pieces_of(view)
    before, after = pieces[point - 1][2], pieces[point % len(pieces)][2]
    return tuple(
        math.dist(map(float, p), map(float, q)) for p, q in ((before[-1], before[-2]), (after[0], after[1]))
    )


def test_the_palette_matches_the_curvature_at_a_smooth_point_by_the_least_change_of_its_handles(editor):
    begin(editor, smooth())
    before, document = editor.session.active_view, editor.session.document
    one, other = curvatures(editor, 2)
    assert abs(one - other) > 0.3 * abs(one)
    editor.select([2])
    editor.run_command("Match Curvature")
    one, other = curvatures(editor, 2)
    assert one == pytest.approx(other, rel=ROUNDING)
    # The curvature is 2/3 of a height over the square of a length: lengths are as the roots of the heights.
    (a, b), (c, d) = handle_lengths(before, 2), curvature_ratio(before, 2)
    share = (a * c + b * d) / (c * c + d * d)
    assert handle_lengths(editor.session.active_view, 2) == pytest.approx((share * c, share * d), rel=1e-12)
    others = [point for at, point in enumerate(editor.curve.points) if at != 2]
    assert others == [point for at, point in enumerate(document.curves[0].points) if at != 2]
    assert editor.point(2) == WAVE[2]
    assert kind_at(editor.session.active_view, 2) is SMOOTH
    t = np.linspace(*before.curve.domain, 4001)
    moved = np.abs(
        np.hypot(*(editor.session.active_view.curve.evaluate(t) - before.curve.evaluate(t)).T)
    ).max()
    assert editor.status.startswith("Curvature matched at point 2: largest change ")
    assert float(editor.status.rpartition(" ")[2].removesuffix(".")) == pytest.approx(moved, rel=0.02)
    assert editor.session.undo_stack.undoText() == "Match curvature at point 2"
    editor.trigger("undo")
    assert editor.session.document == document


def curvature_ratio(view, point):
    """The square roots of the heights of the far handles over the tangent."""
    pieces = pieces_of(view)
    heights = [
        abs(curvature_at(piece, Fraction(s))) * length**2
        for piece, s, length in zip(
            (pieces[point - 1], pieces[point]), (1, 0), handle_lengths(view, point), strict=True
        )
    ]
    return tuple(map(math.sqrt, heights))


def test_a_point_with_one_velocity_becomes_smooth_with_two_handle_lengths(editor):
    curve = replace(make_curve(WAVE, family=HERMITE), velocity_rule=VelocityRule.BESSEL)
    begin(editor, curve)
    assert editor.curve.points[1].velocity is None
    editor.select([1])
    editor.open_menu(WAVE[1])
    editor.choose("matchCurvature")
    assert editor.curve.points[1].tied
    one, other = curvatures(editor, 1)
    assert one == pytest.approx(other, rel=ROUNDING)
    # The neighbours stay estimates.
    assert [index for index, point in enumerate(editor.curve.points) if point.velocity is not None] == [1]


@pytest.mark.parametrize("kind", [ParametrizationKind.UNIFORM, ParametrizationKind.CHORD_LENGTH])
@pytest.mark.parametrize("closed", [False, True])
def test_neighbouring_points_are_matched_together_with_the_least_norm(editor, closed, kind):
    curve = smooth(parametrization=Parametrization(kind))
    if closed:
        factors = ((1, 1), (0.8, 1.3), (1.2, 0.7), (0.9, 1.1), (1, 1))
        curve = smooth(
            points=RING, at=range(5), factors=factors, closed=True, parametrization=Parametrization(kind)
        )
    begin(editor, curve)
    before = editor.session.active_view
    editor.select([1, 2, 3])
    editor.trigger("matchCurvature")
    after = editor.session.active_view
    for point in (1, 2, 3):
        one, other = curvatures(editor, point)
        assert one == pytest.approx(other, rel=ROUNDING), point
    assert editor.status.startswith("Curvature matched at points 1, 2 and 3: largest change ")
    # A least change has no part along which the curvatures stay equal.
    change = np.subtract(lengths_of(after), lengths_of(before))
    slopes = curvature_slopes(after)
    along = np.linalg.svd(slopes)[2][len(slopes) :]
    assert np.abs(along @ change).max() < 1e-6 * np.abs(change).max()


def lengths_of(view):
    return [length for point in (1, 2, 3) for length in handle_lengths(view, point)]


def curvature_slopes(view, step=1e-6):
    """The derivatives of the differences of curvature by the six handle lengths, by central differences."""
    columns = []
    for point in (1, 2, 3):
        for name, length in zip(("velocity", "velocity_after"), handle_lengths(view, point), strict=True):
            sides = []
            for factor in (1.0 + step, 1.0 - step):
                points = list(view.source.points)
                vector = tuple(factor * x for x in getattr(points[point], name))
                points[point] = replace(points[point], **{name: vector})
                pieces = pieces_of(view_of(replace(view.source, points=tuple(points))))
                ends = [
                    (curvature_at(pieces[at - 1], Fraction(1)), curvature_at(pieces[at], Fraction(0)))
                    for at in (1, 2, 3)
                ]
                sides.append([one - other for one, other in ends])
            columns.append(np.subtract(*sides) / (2.0 * step * length))
    return np.transpose(columns)


@pytest.mark.parametrize("rule", [VelocityRule.NATURAL_SPLINE, VelocityRule.BESSEL])
def test_curvature_is_continuous_beside_estimated_neighbours(editor, rule):
    begin(editor, smooth(at=(2,), factors=((0.8, 1.4),), velocity_rule=rule))
    editor.select([2])
    editor.trigger("matchCurvature")
    one, other = curvatures(editor, 2)
    assert one == pytest.approx(other, rel=ROUNDING)
    assert [index for index, point in enumerate(editor.curve.points) if point.velocity is not None] == [2]


@pytest.mark.parametrize("family", [QUINTIC_HERMITE, FAMILIES.named("septic_hermite")])
def test_accelerations_change_least_where_the_family_has_them(editor, family):
    begin(editor, smooth(family))
    before = editor.curve.points[2]
    editor.select([2])
    editor.trigger("matchCurvature")
    one, other = curvatures(editor, 2)
    assert one == pytest.approx(other, rel=ROUNDING)
    after = editor.curve.points[2]
    assert (after.velocity, after.velocity_after) == (before.velocity, before.velocity_after)
    squares = [math.hypot(*vector) ** 2 for vector in (before.velocity, before.velocity_after)]
    moves = [np.subtract(after.acceleration, before.acceleration)]
    moves.append(np.subtract(after.acceleration_after, before.acceleration_after))
    tangent = np.divide(before.velocity, math.hypot(*before.velocity))
    assert np.abs(moves @ tangent).max() < 1e-13
    # Along the line of equal curvatures, (s², S²), nothing moves.
    normals = moves @ np.array([-tangent[1], tangent[0]])
    assert abs(normals @ squares) < 1e-12 * np.abs(normals).max() * max(squares)


def two_curves(family=HERMITE, turn=0.0):
    """Two curves that end at (4, 2), with tangents in line but for a turn."""
    one = make_curve([(0, 0), (2, 1.5), (4, 2)], family=family, name="One")
    other = make_curve([(8, -1), (6.5, 1), (4, 2)], family=family, name="Two")
    ends = [*one.points[:2], replace(one.points[2], velocity=(4.0, 0.5), acceleration=(0.0, -5.0))]
    back = (-6.0 * math.cos(turn) + 0.75 * math.sin(turn), -0.75 * math.cos(turn) - 6.0 * math.sin(turn))
    starts = [*other.points[:2], replace(other.points[2], velocity=back, acceleration=(1.0, -9.0))]
    return replace(one, points=tuple(ends)), replace(other, points=tuple(starts))


@pytest.mark.parametrize("how", ["whole curves", "one end", "both ends"])
@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
def test_the_meeting_ends_of_two_curves_are_matched(editor, family, how):
    begin(editor, *two_curves(family))
    document = editor.session.document
    selected = editor.session.selected
    if how == "one end":
        editor.select([2])
    else:
        selected.select_whole([0, 1])
    if how == "both ends":
        selected.edit_selected()
        selected.set_group(both_ends())
    editor.trigger("matchCurvature")
    assert editor.status.startswith("Curvature matched at the ends of “One” and “Two”: largest change ")
    ends = [curvature_at(pieces_of(view)[-1], Fraction(1)) for view in editor.session.views]
    # The second runs the other way.
    assert ends[0] == pytest.approx(-ends[1], rel=ROUNDING)
    after = editor.session.document.curves
    assert all(new.points[:2] == old.points[:2] for new, old in zip(after, document.curves, strict=True))
    assert all(new.points[2] != old.points[2] for new, old in zip(after, document.curves, strict=True))
    editor.trigger("undo")
    assert editor.session.document == document


@pytest.mark.parametrize("degrees", [0.009, -1.9])
@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
def test_tangents_of_ends_that_nearly_agree_are_turned_to_their_mean(editor, family, degrees):
    """Ends drawn by hand were refused for 0.009°."""
    begin(editor, *two_curves(family, turn=math.radians(degrees)))
    document, before = editor.session.document, end_handles(editor)
    editor.session.selected.select_whole([0, 1])
    editor.trigger("matchCurvature")
    assert editor.status.startswith("Curvature matched at the ends of “One” and “Two”: largest change ")
    assert editor.status.endswith(f"; tangents {abs(degrees)}° apart were turned into line.")
    ends = [curvature_at(pieces_of(view)[-1], Fraction(1)) for view in editor.session.views]
    assert ends[0] == pytest.approx(-ends[1], rel=1e-9)
    one, other = (handle / abs(handle) for handle in end_handles(editor))
    assert one == pytest.approx(-other, abs=1e-15)
    if family is HERMITE:
        mean = before[0] - before[1]
    else:
        mean = before[0] / abs(before[0]) - before[1] / abs(before[1])
    assert one == pytest.approx(mean / abs(mean), abs=1e-15)
    editor.trigger("undo")
    assert editor.session.document == document


@pytest.mark.parametrize("bend", [0.0, 0.1])
def test_a_straight_end_is_not_turned(editor, bend):
    one = make_curve([(0, 0), (4, 0)], family=HERMITE, name="One")
    begin(editor, one, make_curve([(4, 0), (8, 0.1), (12, 0.2 + bend)], family=HERMITE, name="Two"))
    editor.session.selected.select_whole([0, 1])
    assert "the tangents differ by " in refused(editor)


def end_handles(editor):
    """The last handles of the two curves, as complex numbers from the point on."""
    return [
        complex(*map(float, np.subtract(points[-2], points[-1])))
        for points in (pieces_of(view)[-1][2] for view in editor.session.views)
    ]


def both_ends():
    from app.document.point_group import group_points

    return group_points([(0, frozenset({2})), (1, frozenset({2}))])


def refused(editor, *points):
    document = editor.session.document
    if points:
        editor.select(points)
    editor.trigger("matchCurvature")
    assert editor.session.document is document
    return editor.status


def test_impossible_matches_are_refused_with_the_reason(editor):
    # The long handle ahead of point 1 lies on the other side of the tangent at point 2.
    begin(editor, smooth(closed=True, parametrization=Parametrization(ParametrizationKind.UNIFORM)))
    assert refused(editor, 2) == "Nothing was changed. Not at point 2: the curve bends to opposite sides."
    begin(editor, with_points(make_curve(WAVE, family=HERMITE), [1]))
    assert refused(editor, 1).startswith("Nothing was changed. Not at point 1: the tangents differ by ")
    editor.trigger("undo")
    begin(editor, smooth(points=((0, 0), (2, 0), (4, 0), (6, -2), (8, -6)), at=(2,), factors=((1, 1.5),)))
    editor.select([0, 1, 2])
    editor.trigger("straightSegment")
    editor.select([2])
    editor.trigger("tangentSmooth")
    assert refused(editor, 2) == "Nothing was changed. Not at point 2: the curvature is 0 on one side."
    begin(editor, *two_curves(turn=0.1))
    editor.session.selected.select_whole([0, 1])
    assert (
        refused(editor)
        == "Nothing was changed. Not at the ends of “One” and “Two”: the tangents differ by 5.7°."
    )
    begin(editor, two_curves()[0], two_curves(QUINTIC_HERMITE)[1])
    editor.session.selected.select_whole([0, 1])
    assert refused(editor).endswith(
        "Not at the ends of “One” and “Two”: one curve is cubic, the other is not."
    )
    for family in map(FAMILIES.named, ("lagrange", "cubic_spline", "b_spline")):
        begin(editor, make_curve(WAVE, family=family))
        assert refused(editor, 2).endswith(f"the curvature of {family.a_curve} is continuous already."), (
            family
        )


def with_points(curve, corners):
    cornered = list(with_corners(view_of(curve), corners).points)
    for at in corners:
        cornered[at] = replace(cornered[at], velocity_after=(9.0, 1.0))
    return replace(curve, points=tuple(cornered))


def test_what_is_continuous_already_stays(editor):
    begin(editor, make_curve(WAVE, family=HERMITE))
    assert refused(editor, 1, 2) == "The curvature is continuous already at points 1 and 2."
    assert refused(editor, 0) == "Select smooth points, ends that meet, or curves whose ends meet."


def test_more_points_than_can_be_matched_at_once_are_refused(editor):
    """300 points of a jagged curve took minutes, and the window stood still."""
    begin(editor, make_curve([(i, i % 3) for i in range(MOST_JOINTS + 3)], family=HERMITE))
    assert refused(editor, *range(MOST_JOINTS + 3)).startswith("Select at most 60 points")


def test_points_that_can_are_matched_and_the_others_are_named(editor):
    begin(editor, with_points(smooth(at=(3,), factors=((0.8, 1.2),)), [1]))
    editor.select([1, 3])
    editor.trigger("matchCurvature")
    one, other = curvatures(editor, 3)
    assert one == pytest.approx(other, rel=ROUNDING)
    assert "Curvature matched at point 3: largest change" in editor.status
    assert "Not at point 1: the tangents differ by" in editor.status


def test_the_joints_panel_has_a_button_for_the_jump_that_it_shows(editor):
    begin(editor, smooth())
    editor.trigger("showJoints")
    editor.select([2])
    button = editor.window.findChild(QToolButton, "matchCurvatureInJointsButton")
    assert button.isVisible()
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor.settle()
    one, other = curvatures(editor, 2)
    assert one == pytest.approx(other, rel=ROUNDING)
