"""Handles of one selected point and of many: each is seen, and can be grabbed."""

from __future__ import annotations

import math
from itertools import chain, pairwise, product

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.canvas.handle_marks import MOST_POINTS, mark_sizes
from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import FAMILIES, HERMITE
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.handles import handles_at, handles_on, sides_facing
from app.view_model.palette import contrast
from app.view_model.point_kinds import CORNER, SMOOTH, kind_at


def test_marks_of_one_point_do_not_overlap(editor):
    """Of 20 points under septic Hermite all three marks of a side lay over each other, 11 pixels wide."""
    for family, count in product(("hermite", "quintic_hermite", "septic_hermite"), (3, 20)):
        points = [(float(k), 2.0 * math.sin(1.3 * k)) for k in range(count)]
        editor.session.commit(Document((make_curve(points, family=FAMILIES.named(family)),)), "Begin")
        editor.fit()
        editor.select_point(count // 2)
        shown, handles = editor.window.canvas.pixel_map, editor.window.canvas.drawing.points.handles
        sizes_of_arms = [mark_sizes(shown.points(arm).tolist(), 1.0) for arm in handles.arms]
        sizes = dict(zip(handles, chain.from_iterable(sizes_of_arms), strict=True))
        assert len(sizes) == 2 * editor.curve.family.derivatives, (family, count)
        for before, after in pairwise(handles):
            if after.anchor == before.position:
                gap = math.dist(shown.point(*before.position), shown.point(*after.position))
                assert sizes[before] + sizes[after] < gap, (family, count)
                assert min(sizes[before], sizes[after]) >= 2.0, (family, count)
        if count == 3:
            assert all(size == (4.0, 5.5, 5.5)[each.order - 1] for each, size in sizes.items()), family
        for each in handles:
            editor.hover(each.position)
            assert f"{('velocity', 'acceleration', 'jerk')[each.order - 1]}" in editor.status, (family, count)


@pytest.fixture
def zigzag(editor):
    """A cubic curve of six points."""
    points = [(2.0 * k, 3.0 * (k % 2)) for k in range(6)]
    editor.session.commit(Document((make_curve(points, family=HERMITE),)), "Begin", active=0)
    editor.fit()
    return editor


def test_handles_of_several_points_are_dragged_separately_and_kinds_hold(zigzag):
    """With two points selected no handle was shown."""
    zigzag.select([2])
    zigzag.trigger(SMOOTH.action)
    zigzag.select([2, 3])
    before, steps = zigzag.curve.points, zigzag.session.undo_stack.count()
    behind = zigzag.handle(ahead=False, index=2)
    zigzag.drag_handle((5.5, 0.5), index=2)
    points, view = zigzag.curve.points, zigzag.session.active_view
    assert [old is new for old, new in zip(before, points, strict=True)] == [
        True,
        True,
        False,
        True,
        True,
        True,
    ]
    assert zigzag.handle(index=2).position == pytest.approx((5.5, 0.5), abs=zigzag.pixel)
    # Smooth: the other handle has turned, and is as long as it was.
    turned = zigzag.handle(ahead=False, index=2)
    assert kind_at(view, 2) is SMOOTH
    assert math.dist(turned.position, turned.anchor) == pytest.approx(
        math.dist(behind.position, behind.anchor)
    )
    assert math.atan2(*turned.position) != pytest.approx(math.atan2(*behind.position))
    assert zigzag.session.selection == {2, 3}
    zigzag.drag(zigzag.handle(index=3).position, (7.0, 4.0), keys=Qt.KeyboardModifier.AltModifier)
    assert kind_at(zigzag.session.active_view, 3) is CORNER
    assert zigzag.session.undo_stack.count() == steps + 2
    zigzag.press(zigzag.handle(index=2).position)
    zigzag.move((4.0, 4.0))
    zigzag.escape()
    zigzag.release((4.0, 4.0))
    assert zigzag.curve.points[2] is points[2]


def test_handles_that_face_the_selected_points_are_fainter_and_dragged_as_well(zigzag):
    zigzag.select([2])
    canvas = zigzag.window.canvas
    facing = canvas.drawing.points.visible_handles.facing(canvas.pixel_map)
    assert [(each.index, each.ahead) for each in facing] == [(1, True), (3, False)]
    own, other = (zigzag.handle(ahead=False, index=index).position for index in (2, 3))
    picture, paper = zigzag.screenshot(), canvas.drawing.points.theme.paper.name()

    def strongest(place):
        """The contrast of the mark around a place with the paper."""
        at = canvas.viewport().mapTo(zigzag.window, canvas.to_pixel(*place))
        around = [(at.x() + dx, at.y() + dy) for dx in range(-6, 7) for dy in (-3, 3)]
        return max(contrast(picture.pixelColor(x, y).name(), paper) for x, y in around)

    # It was 1.9.
    assert 3.0 <= strongest(other) < 0.8 * strongest(own)
    before = zigzag.curve.points
    zigzag.drag_handle((5.0, 4.0), ahead=False, index=3)
    assert [old is new for old, new in zip(before, zigzag.curve.points, strict=True)] == [True] * 3 + [
        False
    ] + [True] * 2
    assert zigzag.session.selection == {2}
    # A press of the pen beside the curve is to mean a point.
    zigzag.trigger("addTool")
    assert not len(canvas.drawing.points.visible_handles.facing(canvas.pixel_map))


def test_a_straight_segment_has_handles_of_a_single_point_only(zigzag):
    layer = zigzag.window.canvas.drawing.points
    zigzag.select([2, 3])
    zigzag.trigger("straightSegment")
    assert {(each.index, each.ahead) for each in layer.handles} == {(2, False), (3, True)}
    zigzag.select([2])
    facing = layer.visible_handles.facing(zigzag.window.canvas.pixel_map)
    assert {(each.index, each.ahead) for each in layer.handles} == {(2, False), (2, True)}
    assert [(each.index, each.ahead) for each in facing] == [(1, True)]
    # Bent, it has them again.
    zigzag.drag_handle((5.0, 4.0), index=2)
    zigzag.select([2, 3])
    assert {(2, True), (3, False)} < {(each.index, each.ahead) for each in layer.handles}


def test_handles_of_very_many_selected_points_are_drawn_when_few_points_are_visible(editor):
    count = 3 * MOST_POINTS
    points = [(float(abs(k % 40 - 19.5)), float(k // 20)) for k in range(count)]
    editor.session.commit(Document((make_curve(points, family=HERMITE),)), "Begin", active=0)
    editor.fit()
    editor.trigger("selectAll")
    layer, canvas = editor.window.canvas.drawing.points, editor.window.canvas
    assert not len(layer.handles)
    assert layer.note == f"Handles are shown for up to {MOST_POINTS} selected points · zoom in to see them"
    canvas.camera.zoom(4.0, canvas.camera.centre())
    editor.settle()
    assert 2 < len(layer.handles) <= 2 * MOST_POINTS
    assert layer.note == ""
    middle = count // 2
    place = editor.handle(index=middle).position
    editor.hover(place)
    assert f"velocity of point {middle}" in editor.status


@pytest.mark.parametrize("closed", [False, True])
def test_handles_in_arrays_are_bezier_control_points(closed):
    points = [(0.0, 0.0), (1.0, 2.0), (3.0, 1.0), (4.0, 3.0)]
    view = view_of(replace(make_curve(points, family=HERMITE), closed=closed))
    pieces = view.curve.bezier_pieces()
    count = len(pieces)
    for index in range(4):
        beside = {True: index, False: (index - 1) % 4}
        expected = {
            ahead: pytest.approx(tuple(pieces[at][1 if ahead else 2]), abs=1e-12)
            for ahead, at in beside.items()
            if at < count
        }
        assert {each.ahead: each.position for each in handles_at(view, [index])} == expected
    facing = [(each.index, each.ahead) for each in handles_on(view, sides_facing([0, 1], 4, closed=closed))]
    assert facing == ([(3, True), (2, False)] if closed else [(2, False)])


def test_among_small_points_marks_are_small(editor):
    """Of 60 points the handles of one, nine pixels wide, lay over its neighbours, which are three wide."""
    points = [(k / 12.0, 0.3 * math.sin(k / 3.0)) for k in range(60)]
    canvas, grey = editor.window.canvas, editor.window.canvas.drawing.points.theme.handle.name()
    for few in (True, False):
        # Handles a unit long, with the other points far away and near.
        curve = make_curve(points[::10] if few else points, family=HERMITE)
        index, speed = (3, 15.0) if few else (30, 177.0)
        pulled = [
            replace(each, velocity=(0.0, speed)) if k == index else each
            for k, each in enumerate(curve.points)
        ]
        editor.session.commit(Document((replace(curve, points=tuple(pulled)),)), "Begin")
        canvas.camera.show_box((0.0, 10.0), (-3.0, 3.0))
        editor.select([index])
        editor.hover((8.0, 2.5))
        editor.wait_for_rest()
        middle = canvas.to_pixel(*editor.handle(index=index).position)
        image = canvas.viewport().grab().toImage()
        assert image.pixelColor(middle).name() == grey
        assert (image.pixelColor(middle.x() - 4, middle.y()).name() == grey) is few


def test_numbers_are_read_on_filled_shapes(editor):
    """Grey digits lay on whatever a shape was filled with."""
    square = make_curve([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)], family=HERMITE)
    filled = replace(square, closed=True, style=Style(stroke="none", fill="#505a66"))
    editor.session.commit(Document((filled,)), "Begin")
    editor.fit()
    editor.wait_for_rest()
    layer, image = editor.window.canvas.drawing.points, editor.window.canvas.viewport().grab().toImage()
    inside = 0
    for centre, _ in layer.numbers:
        x, y = (centre + editor.window.canvas.camera.origin).toPoint().toTuple()
        beside = {image.pixelColor(x + dx, y + dy).name() for dx in (-9, 9) for dy in (-9, 9)}
        seen = [image.pixelColor(x + dx, y + dy).name() for dx in range(-6, 7) for dy in range(-8, 9)]
        if beside == {"#505a66"}:
            inside += 1
            assert seen.count(layer.theme.paper.name()) > 15
            assert min(contrast(each, "#000000") for each in seen) < contrast("#6c757d", "#000000")
    assert inside
