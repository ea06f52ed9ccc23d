"""What is set to its present value moves nothing and sets nobody else: with mouse and keys in the window."""

from __future__ import annotations

import re

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.derivatives import VelocityRule
from app.document.model import Document, ParametrizationKind, Point, make_curve
from app.document.point_edits import explicit_points
from app.families import HERMITE
from app.view_model.curve.curve_view import view_of

ALT, CTRL = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ControlModifier
HILLS = ((0, 0), (1, 2), (2.5, 1), (4, 3), (5, 0.5), (6.5, 2), (8, 0))


@pytest.fixture
def draw(editor):
    """Return what begins with a Hermite curve of seven points, none of them set."""

    def begin(rule=VelocityRule.NATURAL_SPLINE, **more):
        curve = replace(make_curve(HILLS, name="Hills", family=HERMITE), velocity_rule=rule, **more)
        editor.session.commit(Document((curve,)), "Begin")
        editor.fit()
        editor.select([])
        return editor

    return begin


@pytest.fixture
def hills(draw):
    return draw()


def explicit(editor, curve=None):
    curve = editor.curve if curve is None else editor.session.document.curves[curve]
    return sorted(explicit_points(curve, range(len(curve.points))))


def shape(editor):
    return editor.session.active_view.samples


def follows(editor, moved, points):
    """Whether these points' estimates follow a drag of another point."""
    before = [editor.session.active_view.velocity_of(index) for index in points]
    x, y = editor.point(moved)
    editor.drag_point(moved, to=(x + 0.1, y + 0.4))
    after = [editor.session.active_view.velocity_of(index) for index in points]
    return all(now != was for now, was in zip(after, before, strict=True))


@pytest.mark.parametrize("keys", ["Shift+C", "Shift+S"])
def test_one_corner_or_smooth_point_in_a_curve_of_seven_sets_itself_alone(hills, keys):
    before = shape(hills)
    hills.select_point(3)
    hills.key({"Shift+C": Qt.Key.Key_C, "Shift+S": Qt.Key.Key_S}[keys], Qt.KeyboardModifier.ShiftModifier)
    assert explicit(hills) == [3]
    assert shape(hills) == pytest.approx(before, abs=1e-12)
    assert hills.message == ""
    assert follows(hills, 0, [1, 2])
    assert follows(hills, 6, [4, 5])


def test_a_symmetric_point_between_equal_segments_sets_itself_alone(draw):
    uniform = replace(make_curve(()).parametrization, kind=ParametrizationKind.UNIFORM)
    hills = draw(parametrization=uniform)
    before = shape(hills)
    hills.select_point(3)
    hills.trigger("tangentSymmetric")
    assert explicit(hills) == [3]
    assert shape(hills) == pytest.approx(before, abs=1e-12)


def test_a_straight_segment_sets_its_ends_alone_and_the_others_follow(hills):
    before = shape(hills)
    hills.select([2, 3])
    hills.trigger("straightSegment")
    assert explicit(hills) == [2, 3]
    t = np.linspace(0, 1, len(before))
    start, end = hills.parameters[2:4]
    outside = (t < start) | (t > end)
    assert shape(hills)[outside] == pytest.approx(before[outside], abs=1e-12)
    assert follows(hills, 0, [1])
    assert follows(hills, 6, [4, 5])


def test_a_handle_that_is_pressed_and_dragged_back_or_dragged_sets_its_point_alone(hills):
    before, document = shape(hills), hills.session.document
    hills.select_point(3)
    at = hills.handle().position
    hills.click(at)
    assert hills.session.document is document
    hills.press(at)
    hills.move((at[0] + 0.3, at[1] + 0.3))
    hills.move(at)
    hills.release(at)
    assert explicit(hills) in ([], [3])
    assert shape(hills) == pytest.approx(before, abs=hills.pixel)
    hills.drag_handle((at[0] + 0.4, at[1] + 0.5))
    assert explicit(hills) == [3]
    assert follows(hills, 0, [1, 2])


def test_a_retracted_handle_sets_its_point_alone(hills):
    hills.select_point(3)
    hills.click(hills.handle(ahead=True).position, keys=CTRL)
    assert explicit(hills) == [3]
    assert hills.curve.points[3].velocity_after == (0.0, 0.0)
    assert hills.message == ""


def test_a_handle_that_is_broken_with_alt_sets_its_point_alone(hills):
    before, t = shape(hills), hills.parameters
    hills.select_point(3)
    x, y = hills.handle(ahead=True).position
    hills.drag((x, y), (x + 0.3, y + 0.6), keys=ALT)
    assert explicit(hills) == [3]
    assert hills.curve.points[3].corner
    # The other side has not moved.
    behind = np.linspace(0, 1, len(before)) < t[3]
    assert shape(hills)[behind] == pytest.approx(before[behind], abs=1e-12)


def test_a_point_inserted_on_the_line_stays_estimated(hills):
    before = shape(hills)
    at = hills.session.active_view.curve.evaluate(sum(hills.parameters[3:5]) / 2)
    hills.double_click(tuple(at))
    assert len(hills.curve.points) == 8
    assert explicit(hills) == []
    assert shape(hills) == pytest.approx(before, abs=1e-12)
    assert hills.status.startswith("Shape kept")
    assert follows(hills, 0, [1, 2, 3])


def test_a_split_sets_the_ends_at_the_cut_alone(hills):
    before = hills.session.active_view
    hills.select([3])
    hills.trigger("splitCurve")
    first, second = hills.session.views
    assert (explicit(hills, 0), explicit(hills, 1)) == ([3], [0])
    for part in (first, second):
        t = np.linspace(*part.parameters[[0, -1]], 50)
        assert part.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=1e-12)
    hills.session.selected.select_whole([0, 1])
    hills.trigger("joinCurve")
    assert explicit(hills) == [3]
    joined = view_of(hills.session.document.curves[0])
    t = np.linspace(*before.parameters[[0, -1]], 50)
    assert joined.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=1e-12)


def test_a_deleted_point_sets_nobody_and_its_change_is_said(hills):
    """Beside a set point its other neighbour was set, for a fold; without one, 185 pixels were not told."""
    for index in (None, 3):
        if index is not None:
            hills.select_point(index)
            x, y = hills.handle().position
            hills.drag_handle((x + 0.3, y - 0.2))
        before = hills.session.active_view
        hills.select([4])
        hills.key(Qt.Key.Key_Delete)
        assert explicit(hills) == ([] if index is None else [index])
        assert hills.message == ""
        said = re.fullmatch(
            r"Deleted 1 point. The shape changed by up to (.*)\.",
            hills.status,
        )
        pairs = sampled(before)[:, None] - sampled(hills.session.active_view)[None]
        far = np.hypot(*pairs.transpose(2, 0, 1)).min(axis=1).max()
        # A bound, of which two digits are said.
        assert 0.95 * far <= float(said[1]) <= 1.25 * far
        hills.trigger("undo")


def sampled(view):
    return view.curve.evaluate(np.linspace(*view.curve.domain, 800))


def test_an_inserted_point_that_is_deleted_leaves_the_shape_as_it_was(hills):
    before = shape(hills)
    hills.double_click(tuple(hills.session.active_view.curve.evaluate(sum(hills.parameters[3:5]) / 2)))
    hills.select([4])
    hills.key(Qt.Key.Key_Delete)
    assert shape(hills) == pytest.approx(before, abs=1e-12)
    assert explicit(hills) == []
    assert hills.status == "Deleted 1 point. The shape is unchanged."


# Where a local rule cannot keep the shape


def test_under_a_local_rule_the_message_names_what_was_set_by_every_way(draw):
    def insert(hills):
        at = hills.session.active_view.curve.evaluate(sum(hills.parameters[3:5]) / 2)
        hills.double_click(tuple(at))

    def split(hills):
        hills.select([3])
        hills.trigger("splitCurve")

    def break_handle(hills):
        hills.select_point(3)
        x, y = hills.handle(ahead=True).position
        hills.drag((x, y), (x + 0.3, y + 0.6), keys=ALT)

    def retract(hills):
        hills.select_point(3)
        hills.click(hills.handle(ahead=True).position, keys=CTRL)

    def double_click(hills):
        hills.double_click(hills.point(3))

    for way, names in (
        (insert, "Points 2, 3, 5 and 6 were set to keep the shape."),
        (split, "2 points in 2 curves were set to keep the shape."),
        (break_handle, "Points 2 and 4 were set to keep the shape."),
        (retract, "Points 2 and 4 were set to keep the shape."),
        (double_click, "Points 2 and 4 were set to keep the shape."),
    ):
        hills = draw(VelocityRule.AKIMA)
        way(hills)
        assert hills.message == names, way.__name__
        set_before = sum(len(explicit(hills, k)) for k in range(len(hills.session.document.curves)))
        hills.trigger("resetKept")
        set_after = sum(len(explicit(hills, k)) for k in range(len(hills.session.document.curves)))
        assert set_after < set_before, way.__name__
        assert hills.message == "", way.__name__


def test_five_points_that_were_set_are_named(draw):
    """“5 points were set to keep the shape.” did not say which."""
    hills = draw(VelocityRule.AKIMA)
    points = tuple(Point(x + 8.0 * turn, y + 0.3 * turn) for turn in (0, 1) for x, y in HILLS[:-1])
    longer = Document((replace(hills.curve, points=points),))
    hills.session.change("Longer", lambda _document: longer)
    hills.select([2, 4, 6, 8])
    hills.trigger("tangentCorner")
    assert hills.message == "Points 1, 3, 5, 7 and 9 were set to keep the shape."
