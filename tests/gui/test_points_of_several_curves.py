"""Points of several curves selected and edited together: of a shape, of chosen curves; real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from pixels import pixels_of
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QLineEdit

from app.document.model import Document, make_curve
from app.document.several_curves import set_style
from app.document.style import Style
from app.families import HERMITE
from tests.gui.editor_facts import retype, transform, undo_text

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
Key = Qt.Key


def diamond(size, name, x=0.0, shape="O"):
    points = [(x + size, 0.0), (x, size), (x - size, 0.0), (x, -size)]
    curve = make_curve(points, name=name, family=HERMITE)
    return replace(curve, closed=True, shape=shape, style=Style())


@pytest.fixture
def letter(editor):
    """An O of two contours, of which the outer is edited, and a dot beside it."""
    curves = (diamond(3.0, "Outer"), diamond(1.5, "Inner"), diamond(1.0, "Dot", x=6.0, shape=""))
    editor.session.commit(Document(curves), "Begin", active=0)
    editor.session.selected.activate(0)
    editor.window.canvas.camera.show_box((-5, 8), (-5, 5))
    editor.settle()
    return editor


def positions(editor):
    """The points of all curves, (curves, 4, 2)."""
    return np.array([[point.position for point in curve.points] for curve in editor.session.document.curves])


def selected(editor):
    return dict(editor.session.selected.group.parts)


def ways(editor, before):
    return positions(editor) - before


def test_a_band_over_both_contours_and_a_drag_moves_the_stem(letter):
    before, document = positions(letter), letter.session.document
    letter.press((-4.0, 0.7))
    letter.move((-1.0, -0.7))
    assert letter.status.startswith("2 points in 2 curves selected")
    letter.release((-1.0, -0.7))
    assert selected(letter) == {0: {2}, 1: {2}}
    assert (letter.session.selection, letter.session.active_index) == ({2}, 0)
    letter.hover((-1.5, 0.0))
    assert letter.window.status_line.hint.startswith("Drag to move 2 points in 2 curves")
    letter.drag((-1.5, 0.0), (-2.0, 0.5))
    way = np.zeros((3, 4, 2))
    way[:2, 2] = (-0.5, 0.5)
    assert ways(letter, before) == pytest.approx(way, abs=2 * letter.pixel)
    # To the last bit the same way.
    moved = ways(letter, before)[:2, 2]
    assert moved[0] == pytest.approx(moved[1], abs=1e-12)
    assert (undo_text(letter), letter.curve.name) == ("Move 2 points in 2 curves", "Inner")
    assert selected(letter) == {0: {2}, 1: {2}}
    letter.trigger("undo")
    assert letter.session.document == document
    assert selected(letter) == {0: {2}, 1: {2}}


def test_a_rubber_band_around_another_contour_only_activates_that_contour(letter):
    letter.drag((-1.7, 1.7), (0.5, -1.8))
    assert selected(letter) == {1: {1, 2, 3}}
    assert (letter.curve.name, letter.session.selection) == ("Inner", {1, 2, 3})


def test_shift_click_toggles_points_of_either_contour(letter):
    letter.click((0.0, 3.0))
    letter.hover((0.0, 1.5))
    assert letter.window.status_line.hint.startswith("Drag to move point 1 of “Inner”")
    assert letter.window.canvas.marks.spot == (0.0, 1.5)
    letter.click((0.0, 1.5), keys=SHIFT)
    assert (selected(letter), letter.curve.name) == ({0: {1}, 1: {1}}, "Inner")
    assert letter.status == "2 points in 2 curves selected."
    letter.click((-3.0, 0.0), keys=SHIFT)
    assert (selected(letter), letter.curve.name) == ({0: {1, 2}, 1: {1}}, "Outer")
    # The one edited has none any more: then it is one that has.
    letter.click((0.0, 3.0), keys=SHIFT)
    letter.click((-3.0, 0.0), keys=SHIFT)
    assert (selected(letter), letter.curve.name) == ({1: {1}}, "Inner")
    letter.click((0.0, 1.5), keys=SHIFT)
    assert selected(letter) == {}


def test_a_click_or_a_drag_of_an_unselected_point_acts_on_that_point_only(letter):
    letter.click((3.0, 0.0))
    letter.click((1.5, 0.0))
    assert (selected(letter), letter.curve.name) == ({1: {0}}, "Inner")
    before = positions(letter)
    letter.drag((3.0, 0.0), (3.5, 0.0))
    way = np.zeros((3, 4, 2))
    way[0, 0] = (0.5, 0.0)
    assert ways(letter, before) == pytest.approx(way, abs=2 * letter.pixel)
    assert (undo_text(letter), letter.curve.name) == ("Move point 0", "Outer")


def test_escape_cancels_a_drag_and_a_band_over_several_curves(letter):
    letter.drag((-4.0, 0.7), (-1.0, -0.7))
    document, count = letter.session.document, letter.session.undo_stack.count()
    letter.press((-3.0, 0.0))
    letter.move((-3.5, 1.0))
    letter.move((-2.0, 2.0))
    assert (positions(letter)[:2, 2] != [(-3.0, 0.0), (-1.5, 0.0)]).any(axis=1).all()
    letter.escape()
    letter.release((-2.0, 2.0))
    assert (letter.session.document, letter.session.undo_stack.count()) == (document, count)
    assert selected(letter) == {0: {2}, 1: {2}}
    # The band takes none of Outer, which is edited all the same until it ends.
    letter.press((1.0, -2.0))
    letter.move((1.8, 0.5))
    assert (selected(letter), letter.curve.name) == ({1: {0}}, "Outer")
    letter.escape()
    letter.release((1.8, 0.5))
    assert (selected(letter), letter.curve.name) == ({0: {2}, 1: {2}}, "Outer")


def test_all_points_are_nudged_turned_and_deleted_by_keys(letter):
    begun, before = letter.session.document, positions(letter)
    letter.key(Key.Key_A, CTRL)
    assert selected(letter) == {0: set(range(4)), 1: set(range(4))}
    assert letter.status == "8 points in 2 curves selected."
    letter.key(Key.Key_Right)
    way = ways(letter, before)
    step = positions(letter)[0, 1, 0]
    assert step > 0
    assert way[:2] == pytest.approx(np.broadcast_to([step, 0.0], (2, 4, 2)), abs=1e-12)
    assert not way[2].any()
    assert undo_text(letter) == "Nudge 8 points in 2 curves"
    letter.trigger("undo")
    transform(letter, "R", "90")
    turned = np.stack([-before[:2, :, 1], before[:2, :, 0]], axis=2)
    assert positions(letter)[:2] == pytest.approx(turned, abs=1e-12)
    letter.trigger("undo")
    # Inner goes with all its points, Outer keeps one.
    letter.click((3.0, 0.0), keys=SHIFT)
    letter.key(Key.Key_Delete)
    assert undo_text(letter) == "Delete 7 points in 2 curves"
    curves = letter.session.document.curves
    assert [(curve.name, len(curve.points), curve.shape) for curve in curves] == [
        ("Outer", 1, ""),
        ("Dot", 4, ""),
    ]
    assert selected(letter) == {}
    letter.trigger("undo")
    assert letter.session.document == begun


def test_points_restored_by_undo_are_selected_in_both_contours(letter):
    letter.drag((-4.0, 0.7), (-1.0, -0.7))
    letter.key(Key.Key_Delete)
    assert [len(curve.points) for curve in letter.session.document.curves] == [3, 3, 4]
    letter.trigger("undo")
    assert selected(letter) == {0: {2}, 1: {2}}


def test_the_box_surrounds_the_points_of_both_contours_and_scales_both(letter):
    letter.drag((-4.0, 0.7), (-1.0, -0.7))
    box = letter.window.canvas.marks.box
    assert (box.low, box.high) == ((-3.0, 0.0), (-1.5, 0.0))
    x, y = letter.grip(-1, 0)
    letter.drag((x, y), (x - 1.5, y))
    assert positions(letter)[:2, 2] == pytest.approx(
        np.array([(-4.5, 0.0), (-1.5, 0.0)]), abs=2 * letter.pixel
    )
    assert undo_text(letter) == "Scale 2 points in 2 curves"


def test_kinds_and_alignment_are_of_the_points_of_both_contours(letter):
    letter.drag((-4.0, 0.7), (-1.0, -0.7))
    letter.key(Key.Key_C, SHIFT)
    assert [curve.points[2].corner for curve in letter.session.document.curves] == [True, True, False]
    assert letter.status.startswith("Corner at 2 points in 2 curves.")
    assert letter.action("tangentCorner").isChecked()
    letter.trigger("alignLeft")
    assert positions(letter)[:2, 2, 0].tolist() == [-3.0, -3.0]
    letter.trigger("resetVelocities")
    outer, inner, _ = letter.session.document.curves
    assert (outer.points[2].velocity, inner.points[2].velocity) == (None, None)


def test_points_of_selected_curves_are_selected_together(letter):
    letter.session.selected.activate(2)
    letter.click((2.6, 1.5), keys=SHIFT)
    assert letter.session.selected.curves == {0, 1, 2}
    # Within the box around them, where a drag moves them all.
    letter.drag((2.0, 0.5), (5.2, -0.5), keys=SHIFT)
    assert selected(letter) == {0: {0}, 2: {2}}
    before = positions(letter)
    letter.drag((3.0, 0.0), (3.0, 0.5))
    way = np.zeros((3, 4, 2))
    way[[0, 2], [0, 2]] = (0.0, 0.5)
    assert ways(letter, before) == pytest.approx(way, abs=2 * letter.pixel)
    assert letter.session.selected.curves == {0, 1, 2}


def test_points_are_selected_of_no_curve_that_is_edited_no_longer(letter):
    letter.key(Key.Key_A, CTRL)
    letter.trigger("breakApart")
    assert set(selected(letter)) <= letter.session.selected.active_curves
    letter.trigger("undo")
    letter.session.selected.activate(0)
    letter.key(Key.Key_A, CTRL)
    dot = letter.session.document.curves[2]
    letter.session.change("Dot alone", lambda _document: Document((dot,)), active=0)
    assert selected(letter) == {}


def test_a_drag_snaps_to_the_points_that_stay_and_to_no_other(letter):
    letter.drag((-4.0, 0.7), (-1.0, -0.7))
    letter.trigger("toggleSnap")
    # Beside Dot's leftmost point, and past the one of Outer that moves along.
    letter.press((-1.5, 0.0))
    letter.move((0.0, 0.0))
    letter.move((4.97, 0.02))
    letter.release((4.97, 0.02))
    assert positions(letter)[:2, 2].tolist() == [[3.5, 0.0], [5.0, 0.0]]


def test_points_of_both_contours_are_copied_and_doubled_as_curves(letter):
    letter.drag((-4.0, 4.0), (0.5, -0.7))
    assert selected(letter) == {0: {1, 2}, 1: {1, 2}}
    letter.key(Key.Key_D, CTRL)
    curves = letter.session.document.curves
    assert [len(curve.points) for curve in curves] == [4, 4, 2, 2, 4]
    assert letter.session.selected.active_curves == {2, 3}
    letter.trigger("undo")
    letter.session.selected.activate(0)
    letter.drag((-4.0, 4.0), (0.5, -0.7))
    letter.key(Key.Key_C, CTRL)
    assert letter.status == "Copied 4 points in 2 curves."
    letter.trigger("pasteInPlace")
    assert [len(curve.points) for curve in letter.session.document.curves] == [4, 4, 4, 2, 2]


def test_tab_walks_through_the_points_of_both_contours(letter):
    letter.click((0.0, -3.0))
    letter.key(Key.Key_Tab)
    assert (selected(letter), letter.curve.name) == ({1: {0}}, "Inner")
    letter.key(Key.Key_Tab, SHIFT)
    assert (selected(letter), letter.curve.name) == ({0: {3}}, "Outer")


def test_the_stroke_keeps_its_width_when_the_shape_is_scaled(letter):
    letter.session.change("Wide", lambda document: set_style(document, [0], width=2.0))
    letter.key(Key.Key_A, CTRL)
    transform(letter, "S", "2")
    assert {curve.style.width for curve in letter.session.document.curves[:2]} == {2.0}


def test_the_menu_of_a_point_of_another_contour_acts_on_the_selection(letter):
    letter.drag((-4.0, 0.7), (-1.0, -0.7))
    menu = letter.open_menu((-1.5, 0.0))
    assert "tangentCorner" in {entry.objectName() for entry in menu.actions()}
    menu.close()
    assert (selected(letter), letter.curve.name) == ({0: {2}, 1: {2}}, "Inner")
    letter.open_menu((0.0, 3.0)).close()
    assert (selected(letter), letter.curve.name) == ({0: {1}}, "Outer")


def test_handles_of_both_contours_are_visible_and_can_be_dragged(letter):
    """Of the contour that is not the active one there were none."""
    letter.drag((-4.0, 0.7), (-1.0, -0.7))
    assert letter.curve.name == "Outer"
    before = letter.session.document
    # The handles of the circle's point beside it, and the one that faces it; where they lie is plain.
    own, facing = (-1.5, -0.75), (-0.75, -1.5)
    shown = ink_around(letter, own), ink_around(letter, facing)
    letter.hover(own)
    assert letter.window.status_line.hint.startswith("Drag to set the velocity of point 2")
    letter.press(own)
    letter.move((-2.0, -1.5))
    assert letter.session.document.curves[1] != before.curves[1]
    letter.key(Key.Key_Escape)
    letter.release((-2.0, -1.5))
    assert letter.session.document is before
    # Escape restored the active curve too.
    assert (selected(letter), letter.curve.name) == ({0: {2}, 1: {2}}, "Outer")
    # With the other contour active, the handle of the outer one belongs to another curve.
    letter.session.selected.switch_active(1)
    assert (selected(letter), letter.curve.name) == ({0: {2}, 1: {2}}, "Inner")
    letter.drag((-3.0, -1.5), (-3.5, -2.0))
    after = letter.session.document.curves
    assert (after[1], letter.curve.name) == (before.curves[1], "Outer")
    assert after[0].points[2].velocity == pytest.approx((-6.0, -24.0), abs=0.3)
    assert undo_text(letter) == "Set velocity of point 2"
    letter.drag(facing, (-1.0, -2.0))
    assert letter.session.document.curves[1].points[3].velocity is not None
    letter.trigger("undo")
    letter.trigger("undo")
    assert letter.session.document == before
    letter.click((-3.0, 0.0))
    assert selected(letter) == {0: {2}}
    gone = ink_around(letter, own), ink_around(letter, facing)
    assert all(few < many for few, many in zip(gone, shown, strict=True))


def ink_around(editor, place):
    """How many pixels of the mark of a handle have another colour than most there."""
    at = editor.window.canvas.to_pixel(*place)
    image = editor.window.canvas.grab().toImage().copy(at.x() - 6, at.y() - 6, 13, 13)
    _, counts = np.unique(pixels_of(image), return_counts=True)
    return image.width() * image.height() - counts.max()


def test_curves_are_split_at_all_selected_points(letter):
    """Three of the ring, two of its hole, one of the dot, all of which are edited."""
    letter.session.selected.set_curves({0, 2})
    document = letter.session.document
    letter.drag((-3.5, 3.5), (0.5, -3.5))
    letter.drag((4.0, 0.7), (5.5, -0.7), keys=SHIFT)
    assert selected(letter) == {0: {1, 2, 3}, 1: {1, 2, 3}, 2: {2}}
    letter.click((0.0, 1.5), keys=SHIFT)
    letter.key(Key.Key_B, SHIFT)
    curves = letter.session.document.curves
    assert [curve.name for curve in curves] == [
        *("Outer a", "Outer b", "Outer c"),
        *("Inner a", "Inner b"),
        "Dot",
    ]
    assert [[point.position for point in curve.points] for curve in curves] == [
        [(0.0, 3.0), (-3.0, 0.0)],
        [(-3.0, 0.0), (0.0, -3.0)],
        [(0.0, -3.0), (3.0, 0.0), (0.0, 3.0)],
        [(-1.5, 0.0), (0.0, -1.5)],
        [(0.0, -1.5), (1.5, 0.0), (0.0, 1.5), (-1.5, 0.0)],
        [(5.0, 0.0), (6.0, -1.0), (7.0, 0.0), (6.0, 1.0), (5.0, 0.0)],
    ]
    assert not any(curve.closed for curve in curves)
    assert [curve.shape for curve in curves] == [*5 * ["O"], ""]
    assert letter.status.startswith("Split at 6 points into 6 curves: shape kept, largest change ")
    assert undo_text(letter) == "Split 1 shape and 1 curve"
    # All of it is still edited, and its ends can be dragged apart.
    assert letter.session.selected.active_curves == set(range(6))
    letter.trigger("undo")
    assert letter.session.document == document


def test_an_open_curve_is_split_at_inner_points_only(letter):
    letter.session.commit(
        Document((make_curve([(-4.0, 0.0), (-2.0, 1.0), (0.0, 0.0), (2.0, 1.0)], name="Wave"),)),
        "Begin",
        active=0,
    )
    letter.session.selected.activate(0)
    letter.settle()
    before = letter.session.active_view
    letter.key(Key.Key_A, CTRL)
    letter.key(Key.Key_B, SHIFT)
    assert [view.source.name for view in letter.session.views] == ["Wave a", "Wave b", "Wave c"]
    for k, view in enumerate(letter.session.views):
        t = np.linspace(*before.parameters[k : k + 2], 20)
        assert view.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=1e-12)
    assert undo_text(letter) == "Split Wave"


# No point selected: all points of the shape are meant


def test_the_panel_counts_the_points_of_all_contours(letter):
    """It said “All 4 points”."""
    letter.trigger("openTransform")
    label = letter.window.findChild(QLabel, "transformWhat")
    assert label.text() == "All 8 points in 2 curves"


def test_a_typed_width_scales_both_contours(letter):
    letter.trigger("openTransform")
    before = positions(letter)[:2, :, 0]
    retype(letter.window.findChild(QLineEdit, "transformWidth"), "90")
    assert letter.window.canvas.tools.box.bounds.size[0] == pytest.approx(90)
    factors = np.diff(positions(letter)[:2, :, 0]) / np.diff(before)
    assert factors == pytest.approx(factors[0, 0] * np.ones(factors.shape), abs=1e-9)
    assert factors[0, 0] > 1.5


def test_flips_and_quarter_turns_transform_all_contours(letter):
    target = letter.window.canvas.tools.box
    for key, held, linear in (
        (Key.Key_H, Qt.KeyboardModifier.NoModifier, ((-1, 0), (0, 1))),
        (Key.Key_V, SHIFT, ((1, 0), (0, -1))),
        (Key.Key_BracketLeft, CTRL, ((0, -1), (1, 0))),
    ):
        before, centre = positions(letter)[:2], np.array(target.centre)
        letter.key(key, held)
        assert positions(letter)[:2] == pytest.approx(
            (before - centre) @ np.array(linear).T + centre, abs=1e-9
        )


@pytest.mark.parametrize(
    ("key", "typed", "linear", "shift"),
    [
        (Key.Key_G, "7", np.eye(2), (7, 0)),
        (Key.Key_S, "2", 2 * np.eye(2), (0, 0)),
        (Key.Key_R, "180", -np.eye(2), (0, 0)),
    ],
)
def test_g_s_and_r_transform_all_contours(letter, key, typed, linear, shift):
    before, centre = positions(letter), np.array(letter.window.canvas.tools.box.centre)
    letter.hover((4, 4))
    letter.key(key)
    letter.type_amount(typed)
    assert letter.status.startswith("All 8 points in 2 curves: ")
    letter.key(Key.Key_Return)
    wanted = (before[:2] - centre) @ linear + centre + shift
    assert positions(letter)[:2] == pytest.approx(wanted, abs=1e-9)
    letter.trigger("undo")
    assert positions(letter) == pytest.approx(before, abs=0)


def test_reverse_opening_and_the_family_are_of_all_contours_where_no_point_is_selected(letter):
    before = positions(letter)
    letter.key(Key.Key_R, CTRL)
    after = positions(letter)
    assert [{*map(tuple, each)} for each in after] == [{*map(tuple, each)} for each in before]
    assert [(one == other).all() for one, other in zip(after, before, strict=True)] == [False, False, True]
    letter.trigger("closeCurve")
    assert [curve.closed for curve in letter.session.document.curves] == [False, False, True]
    letter.trigger("undo")
    letter.trigger("familyLagrange")
    families = [curve.family.name for curve in letter.session.document.curves]
    assert families == ["lagrange", "lagrange", "hermite"]
    letter.trigger("undo")
    letter.click((0, 3))
    reversed_ = positions(letter)
    letter.key(Key.Key_R, CTRL)
    assert (positions(letter)[1] == reversed_[1]).all()
    assert (positions(letter)[0] != reversed_[0]).any()
