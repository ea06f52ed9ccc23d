"""Shapes with holes and groups: made, opened in the list, chosen and taken apart; real mouse and keys."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from app.actions.menus import CURVE_MENU
from app.appearance.theme import LIGHT
from app.cli import main
from app.document.model import Document, make_curve
from app.document.style import FillRule, Style
from app.families import HERMITE
from app.features.curve_list.row_drag import OPENS_MS
from app.features.curve_list.rows import Spot, spot_rect
from app.workbench.context import bar_menu
from tests.gui.curve_rows import click_row, heard, place_in, row_named, rows, view_of
from tests.gui.editor_facts import undo_text
from tests.waiting import until

CTRL = Qt.KeyboardModifier.ControlModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier
NO_KEYS = Qt.KeyboardModifier.NoModifier
LEFT = Qt.MouseButton.LeftButton
RING = Style(stroke="none", fill="#cc3311")


def diamond(size, name, x=0.0, style=RING):
    points = [(x + size, 0.0), (x, size), (x - size, 0.0), (x, -size)]
    return replace(make_curve(points, name=name, family=HERMITE), closed=True, style=style)


@pytest.fixture
def rings(editor):
    """Outer and Inner run the same way around the origin, Side lies beside; Outer is active, and filled."""
    curves = (
        diamond(3.0, "Outer"),
        diamond(1.5, "Inner", style=Style()),
        diamond(1.0, "Side", x=6.0, style=Style(fill="#0072b2")),
    )
    editor.session.commit(Document(curves), "Begin", active=0)
    editor.session.selected.activate(0)
    editor.show_dock("curvesDock")
    editor.fit()
    return editor


def fold(editor, name):
    view = view_of(editor)
    place = view.parts.opener_rect(row_named(editor, name)).center()
    QTest.mouseClick(view.viewport(), LEFT, pos=place)
    editor.settle()


def key_in_list(editor, *keys):
    view = view_of(editor)
    view.setFocus()
    for key in keys:
        QTest.keyClick(view, key)
        editor.settle()


def ctrl_in_list(editor, key):
    view_of(editor).setFocus()
    QTest.keyClick(view_of(editor), key, CTRL)
    editor.settle()


def drag_row(editor, name, to, right=0):
    """Drag a row by its name to a height of the list, and to the right by pixels."""
    port, start = view_of(editor).viewport(), place_in(editor, name)
    QTest.mousePress(port, LEFT, pos=start)
    for y in ((start.y() + to) // 2, to):
        QTest.mouseMove(port, QPoint(start.x() + right, y))
    QTest.mouseRelease(port, LEFT, pos=QPoint(start.x() + right, to))
    editor.settle()


def top_of(editor, name):
    return view_of(editor).parts.entry_rect(row_named(editor, name)).top()


def row_colours(editor, name):
    """The colours along the middle of a row's name."""
    view, rect = (
        view_of(editor),
        spot_rect(view_of(editor).parts.entry_rect(row_named(editor, name)), Spot.NAME),
    )
    image, line = view.viewport().grab(rect).toImage(), rect.height() // 2
    return [image.pixelColor(x, line).name() for x in range(image.width())]


def names(editor):
    return [curve.name for curve in editor.session.document.curves]


def shapes(editor):
    return [curve.shape for curve in editor.session.document.curves]


def groups(editor):
    return [curve.groups for curve in editor.session.document.curves]


def selected_names(editor):
    return {editor.session.document.curves[place].name for place in editor.session.selected.curves}


@pytest.fixture
def ring(rings):
    """The same with Outer and Inner combined, and Side edited."""
    *parts, side = rings.session.document.curves
    style = replace(RING, fill_rule=FillRule.EVENODD)
    combined = [replace(each, shape="Shape 1", style=style) for each in parts]
    rings.session.commit(Document((*combined, side)), "Combine 2 curves", active=2)
    rings.settle()
    return rings


@pytest.fixture
def group(rings):
    """The same with Inner and Side in a group, and Outer edited."""
    outer, *others = rings.session.document.curves
    grouped = [replace(each, groups=("Group 1",)) for each in others]
    rings.session.commit(Document((outer, *grouped)), "Group 2 curves", active=0)
    rings.settle()
    return rings


# Combine and Break Apart


def test_combined_curves_are_one_shape_with_a_hole(rings):
    click_row(rings, "Inner", CTRL)
    rings.key(Qt.Key.Key_K, CTRL)
    assert (shapes(rings), undo_text(rings)) == (["Shape 1", "Shape 1", ""], "Combine 2 curves")
    assert rings.status == "“Shape 1” is a shape of 2 curves; the even-odd rule keeps its holes open."
    assert {curve.style for curve in rings.session.document.curves[:2]} == {
        replace(RING, fill_rule=FillRule.EVENODD)
    }
    assert selected_names(rings) == {"Outer", "Inner"}
    rings.trigger("undo")
    assert shapes(rings) == ["", "", ""]


def colour_at(editor, x, y):
    """The colour of the canvas at a place of the plane."""
    canvas = editor.window.canvas
    editor.settle()
    return QColor(canvas.viewport().grab().toImage().pixel(canvas.to_pixel(x, y))).name()


@pytest.mark.parametrize("edited", ["Outer", "Inner", "Side"])
def test_the_hole_is_visible_whichever_curve_is_edited(ring, edited):
    fold(ring, "Shape 1")
    click_row(ring, edited)
    assert (colour_at(ring, 2.2, 0.3), colour_at(ring, 0.3, 0.2)) == ("#cc3311", LIGHT.paper.name())
    ring.trigger("breakApart") if edited != "Side" else ring.trigger("undo")
    assert colour_at(ring, 0.3, 0.2) == "#cc3311"


def test_the_hole_stays_a_hole_in_pictures_and_the_shape_is_one_path_in_svg(ring, tmp_path):
    saved = tmp_path / "ring.curve.json"
    ring.session.save(saved)
    png, svg = tmp_path / "ring.png", tmp_path / "ring.svg"
    assert [main(["render", str(saved), "-o", str(path)]) for path in (png, svg)] == [0, 0]
    picture = QImage(str(png))
    scale = picture.height() / 7.2

    def colour(x, y):
        return QColor(picture.pixel(int((x + 3.6) * scale), int((3.6 - y) * scale))).name()

    # The ring is 6 high, and the margin a tenth of that; Inner and Outer cross y = 0 at 1.5 and 3.
    assert [colour(x, 0.1) for x in (-2.9, -1.6, 1.6, 2.9)] == ["#cc3311"] * 4
    assert "#cc3311" not in {colour(x, 0.1) for x in (-3.1, -1.4, 0.0, 1.4, 3.1)}
    text = svg.read_text()
    assert (text.count("<path"), text.count('fill-rule="evenodd"')) == (2, 1)


def test_a_reversed_curve_keeps_its_fill_rule(rings):
    click_row(rings, "Inner")
    rings.trigger("reverseCurve")
    click_row(rings, "Outer", CTRL)
    rings.trigger("combineCurves")
    assert rings.curve.style.fill_rule is FillRule.NONZERO


def test_a_single_curve_is_not_combined_and_a_plain_curve_not_broken_apart(rings):
    assert not rings.action("combineCurves").isEnabled()
    assert not rings.action("breakApart").isEnabled()
    assert not rings.action("ungroupCurves").isEnabled()


def test_one_curve_is_grouped_and_ungrouped(rings):
    """A group of one takes others in later; it was refused."""
    name = rings.curve.name
    rings.trigger("groupCurves")
    assert rings.curve.groups == ("Group 1",)
    assert rings.status == "“Group 1” has 1 curve."
    rings.trigger("ungroupCurves")
    assert (rings.curve.name, rings.curve.groups) == (name, ())


def test_without_a_selection_combine_and_group_are_disabled(ring):
    ring.session.selected.select_whole({0})
    assert ring.action("breakApart").isEnabled()
    assert ring.action("groupCurves").isEnabled()
    ring.session.selected.select_whole(())
    for name in ("combineCurves", "breakApart", "groupCurves", "ungroupCurves"):
        assert not ring.action(name).isEnabled()


def test_a_shape_is_broken_apart_and_its_curves_are_selected(ring):
    click_row(ring, "Shape 1")
    assert not ring.action("combineCurves").isEnabled()
    ring.key(Qt.Key.Key_K, CTRL | SHIFT)
    assert (shapes(ring), selected_names(ring)) == (["", "", ""], {"Outer", "Inner"})
    assert (rows(ring), undo_text(ring)) == (["Side", "Inner", "Outer"], "Break Shape 1 apart")


def test_more_is_combined_with_a_shape(ring):
    click_row(ring, "Shape 1", CTRL)
    ring.trigger("combineCurves")
    assert shapes(ring) == ["Shape 1"] * 3


# The entry that opens


def test_a_shape_is_one_entry_that_opens_and_folds(ring):
    assert rows(ring) == ["Side", "Shape 1"]
    fold(ring, "Shape 1")
    assert rows(ring) == ["Side", "Shape 1", "  Inner", "  Outer"]
    assert ring.curve.name == "Side"
    fold(ring, "Shape 1")
    assert rows(ring) == ["Side", "Shape 1"]


def test_left_and_right_open_and_fold_and_walk(ring):
    click_row(ring, "Shape 1")
    key_in_list(ring, Qt.Key.Key_Right)
    assert rows(ring) == ["Side", "Shape 1", "  Inner", "  Outer"]
    key_in_list(ring, Qt.Key.Key_Right)
    assert selected_names(ring) == {"Inner"}
    key_in_list(ring, Qt.Key.Key_Down)
    assert selected_names(ring) == {"Outer"}
    key_in_list(ring, Qt.Key.Key_Left)
    assert selected_names(ring) == {"Inner", "Outer"}
    key_in_list(ring, Qt.Key.Key_Left)
    assert rows(ring) == ["Side", "Shape 1"]
    key_in_list(ring, Qt.Key.Key_Up)
    assert selected_names(ring) == {"Side"}


def test_an_entry_stays_open_through_changes_and_another_name(ring):
    fold(ring, "Shape 1")
    click_row(ring, "Side", spot=Spot.EYE)
    ring.trigger("duplicateCurve")
    assert rows(ring)[-2:] == ["  Inner", "  Outer"]
    view = view_of(ring)
    QTest.mouseDClick(view.viewport(), LEFT, pos=place_in(ring, "Shape 1"))
    editor = view.viewport().findChild(object, "curveNameEditor")
    assert editor.accessibleName() == "Name of the shape"
    ring.type_text(editor, "R")
    QTest.keyClick(editor, Qt.Key.Key_Return)
    ring.settle()
    assert (shapes(ring)[:2], undo_text(ring)) == (["R", "R"], "Rename shape")
    assert rows(ring)[-3:] == ["R", "  Inner", "  Outer"]


def test_a_curve_of_a_shape_can_be_renamed(ring):
    fold(ring, "Shape 1")
    click_row(ring, "Inner")
    key_in_list(ring, Qt.Key.Key_F2)
    editor = view_of(ring).viewport().findChild(object, "curveNameEditor")
    editor.selectAll()
    ring.type_text(editor, "Counter")
    QTest.keyClick(editor, Qt.Key.Key_Return)
    ring.settle()
    assert rows(ring) == ["Side", "Shape 1", "  Counter", "  Outer"]
    assert shapes(ring) == ["Shape 1", "Shape 1", ""]


def test_a_name_in_use_is_refused(ring):
    ring.trigger("selectAllCurves")
    ring.trigger("groupCurves")
    view = view_of(ring)
    fold(ring, "Group 1")
    model = view.curves
    model.setData(model.index(row_named(ring, "Shape 1")), "Group 1")
    assert ring.status == "Another shape or group is called “Group 1”. Enter another name."


def test_a_screen_reader_hears_of_shapes(ring):
    model = view_of(ring).curves
    text = model.index(1).data(Qt.ItemDataRole.AccessibleTextRole)
    assert text == "Shape 1, shape of 2 curves, folded"
    fold(ring, "Shape 1")
    assert model.index(1).data(Qt.ItemDataRole.AccessibleTextRole) == "Shape 1, shape of 2 curves, open"
    view = view_of(ring)
    assert view.parts.tip_at(view.parts.opener_rect(1).center()) == "Fold “Shape 1” (Left, Right)"


# Whole shapes


@pytest.mark.parametrize("folded", [True, False])
def test_actions_on_a_shape_change_all_its_curves(ring, folded):
    if not folded:
        fold(ring, "Shape 1")
    click_row(ring, "Shape 1", spot=Spot.EYE)
    click_row(ring, "Shape 1", spot=Spot.LOCK)
    assert [(curve.visible, curve.locked) for curve in ring.session.document.curves] == [
        (False, True),
        (False, True),
        (True, False),
    ]
    assert undo_text(ring) == "Lock Shape 1"


def test_commands_act_on_the_whole_shape_of_the_edited_curve(ring):
    ring.session.selected.activate(0)
    ring.trigger("raiseCurve")
    assert names(ring) == ["Side", "Outer", "Inner"]
    assert (ring.curve.name, undo_text(ring)) == ("Outer", "Raise Shape 1")
    assert not ring.action("raiseCurve").isEnabled()
    ring.trigger("duplicateCurve")
    assert names(ring) == ["Side", "Outer", "Inner", "Outer copy", "Inner copy"]
    assert shapes(ring) == ["", "Shape 1", "Shape 1", "Shape 1 copy", "Shape 1 copy"]
    ring.session.selected.activate(3)
    ring.trigger("deleteCurve")
    assert (names(ring), undo_text(ring)) == (["Side", "Outer", "Inner"], "Delete Shape 1 copy")


def test_a_title_distinguishes_a_shape_from_a_contour(ring):
    titles = [ring.action(name) for name in ("deleteCurve", "duplicateCurve")]
    ring.session.selected.activate(0)
    assert [each.text() for each in titles] == ["Delete Shape", "Duplicate Shape"]
    ring.session.selected.select_whole(())
    fold(ring, "Shape 1")
    click_row(ring, "Inner")
    assert [each.text() for each in titles] == ["Delete Contour", "Duplicate Contour"]
    ring.trigger("deleteCurve")
    assert (names(ring), undo_text(ring)) == (["Outer", "Side"], "Delete Inner")
    click_row(ring, "Side")
    assert titles[0].text() == "Delete Curve"


def test_a_new_curve_does_not_tear_a_shape(ring):
    ring.session.selected.activate(0)
    ring.trigger("newCurve")
    assert names(ring) == ["Outer", "Inner", "Side", "Curve 1"]
    assert shapes(ring) == ["Shape 1", "Shape 1", "", ""]


def test_a_curve_of_an_opened_shape_is_selected_and_deleted_alone(ring):
    """The canvas shows a box around it and not around its shape, and every key is about that."""
    ring.session.selected.select_whole(())
    fold(ring, "Shape 1")
    click_row(ring, "Inner")
    assert (ring.session.selected.is_editing, ring.session.selected.whole_curves) == (False, {1})
    before = ring.session.document
    ring.drag((0.5, 0.3), (0.5, 0.8))
    after = ring.session.document
    assert [after.curves[at] is before.curves[at] for at in range(3)] == [True, False, True]
    assert undo_text(ring) == "Move Inner"
    ring.key(Qt.Key.Key_Delete)
    assert names(ring) == ["Outer", "Side"]
    ring.trigger("undo")
    ring.click((2.2, 0.3))
    assert ring.session.selected.whole_curves == {0, 1}


def test_a_folded_entry_marks_selected_curves_inside(ring):
    """By a fainter mark with a dot, and in words; not the one that is opened, and not where all of it is."""
    image = [row_colours(ring, "Shape 1")]
    fold(ring, "Shape 1")
    ring.session.selected.select_whole(())
    click_row(ring, "Inner")
    assert heard(ring, 1).endswith(", selected")
    fold(ring, "Shape 1")
    assert heard(ring, 1) == "Shape 1, shape of 2 curves, folded, contains selected curves"
    image.append(row_colours(ring, "Shape 1"))
    click_row(ring, "Shape 1")
    assert heard(ring, 1) == "Shape 1, shape of 2 curves, folded, selected"
    image.append(row_colours(ring, "Shape 1"))
    dots = [[each == LIGHT.accent.name() for each in row].count(True) for row in image]
    assert [dot > 2 for dot in dots] == [False, True, False]
    assert len({row[-1] for row in image}) == 3


@pytest.mark.parametrize("how", ["key", "menu"])
def test_a_curve_is_deleted_alone_from_the_opened_entry(ring, how):
    fold(ring, "Shape 1")
    click_row(ring, "Inner")
    if how == "key":
        key_in_list(ring, Qt.Key.Key_Delete)
    else:
        ring.trigger("deleteContour")
    assert (names(ring), shapes(ring), undo_text(ring)) == (["Outer", "Side"], ["", ""], "Delete Inner")
    assert rows(ring) == ["Side", "Outer"]
    ring.trigger("undo")
    assert shapes(ring) == ["Shape 1", "Shape 1", ""]


def test_delete_on_a_folded_entry_deletes_all_its_curves(ring):
    ring.session.selected.activate(1)
    key_in_list(ring, Qt.Key.Key_Delete)
    assert names(ring) == ["Side"]


def test_a_split_curve_of_a_shape_stays_in_the_shape(ring):
    ring.session.selected.activate(0)
    ring.select([2])
    ring.trigger("splitCurve")
    ring.select([1])
    ring.trigger("splitCurve")
    assert shapes(ring) == ["Shape 1", "Shape 1", "Shape 1", ""]


# Order


def test_a_shape_is_dragged_whole(ring):
    fold(ring, "Shape 1")
    drag_row(ring, "Shape 1", top_of(ring, "Side") + 1)
    assert (names(ring), rows(ring)[0]) == (["Side", "Outer", "Inner"], "Shape 1")
    assert undo_text(ring) == "Reorder Shape 1"


def test_a_curve_is_dragged_into_a_shape_and_out_of_the_shape(ring):
    fold(ring, "Shape 1")
    drag_row(ring, "Side", top_of(ring, "Outer"))
    assert rows(ring) == ["Shape 1", "  Inner", "  Side", "  Outer"]
    assert ring.session.document.curves[1].style == ring.session.document.curves[0].style
    assert ring.curve.name == "Side"
    drag_row(ring, "Inner", top_of(ring, "Shape 1") + 1)
    assert rows(ring) == ["Inner", "Shape 1", "  Side", "  Outer"]


def test_at_the_end_of_an_open_entry_the_horizontal_position_decides(ring):
    fold(ring, "Shape 1")
    last = view_of(ring).parts.entry_rect(3)
    drag_row(ring, "Side", last.bottom())
    assert rows(ring) == ["Shape 1", "  Inner", "  Outer", "  Side"]
    ring.trigger("undo")
    drag_row(ring, "Side", last.bottom(), right=-14)
    assert rows(ring) == ["Shape 1", "  Inner", "  Outer", "Side"]


@pytest.mark.parametrize("folded", [True, False])
def test_a_curve_dropped_on_an_entry_goes_into_the_shape(ring, folded):
    if not folded:
        fold(ring, "Shape 1")
    drag_row(ring, "Side", view_of(ring).parts.entry_rect(row_named(ring, "Shape 1")).center().y())
    assert (names(ring), shapes(ring)) == (["Outer", "Inner", "Side"], ["Shape 1"] * 3)
    assert ring.curve.name == "Side"


def test_a_group_cannot_be_dropped_into_itself(group):
    fold(group, "Group 1")
    document = group.session.document
    drag_row(group, "Group 1", top_of(group, "Inner"))
    assert group.session.document is document
    assert group.status == "A shape or group cannot be moved into itself."


# Groups


def test_selected_curves_become_a_group_by_a_key(rings):
    click_row(rings, "Inner")
    click_row(rings, "Side", CTRL)
    rings.key(Qt.Key.Key_G, CTRL)
    assert groups(rings) == [(), ("Group 1",), ("Group 1",)]
    assert (rows(rings), undo_text(rings)) == (["Group 1", "Outer"], "Group 2 curves")


def test_a_group_has_an_entry_that_selects_all(group):
    assert rows(group) == ["Group 1", "Outer"]
    click_row(group, "Group 1")
    assert selected_names(group) == {"Inner", "Side"}
    fold(group, "Group 1")
    assert rows(group) == ["Group 1", "  Side", "  Inner", "Outer"]
    group.key(Qt.Key.Key_G, CTRL | SHIFT)
    assert (groups(group), selected_names(group)) == ([(), (), ()], {"Inner", "Side"})
    assert (group.status, undo_text(group)) == ("Ungrouped Group 1.", "Ungroup Group 1")


def test_groups_contain_groups_and_shapes(group):
    group.trigger("selectAllCurves")
    group.trigger("groupCurves")
    fold(group, "Group 2")
    assert rows(group) == ["Group 2", "  Group 1", "  Outer"]
    group.trigger("ungroupCurves")
    assert rows(group) == ["Group 1", "Outer"]


def test_a_copy_of_a_group_is_a_group(group):
    click_row(group, "Group 1")
    group.trigger("duplicateCurve")
    assert rows(group) == ["Group 1 copy", "Group 1", "Outer"]


# As it is in the file


def test_shapes_and_groups_are_saved(group, tmp_path):
    click_row(group, "Group 1")
    group.trigger("combineCurves")
    group.trigger("groupCurves")
    document = group.session.document
    group.session.save(tmp_path / "r.curve.json")
    group.session.open(tmp_path / "r.curve.json")
    assert group.session.document == document
    assert rows(group) == ["Group 2", "Outer"]


# What is filled is pressed within


def test_a_press_within_a_fill_is_a_press_on_the_filled_curve(ring):
    ring.click((2.2, 0.3))
    assert ring.session.document.curves[ring.session.active_index].shape == "Shape 1"
    ring.session.selected.activate(2)
    ring.click((0.2, 0.1))
    assert ring.curve.name == "Side"


def test_a_press_hits_the_topmost_fill_only(rings):
    covered = diamond(1.0, "Covered", x=1.2, style=Style())
    rings.session.commit(Document((covered, *rings.session.document.curves)), "Cover", active=3)
    rings.session.selected.activate(3)
    rings.click((2.2, 0.0))
    assert rings.curve.name == "Outer"


@pytest.mark.parametrize("how", [Spot.EYE, Spot.LOCK])
def test_a_hidden_or_locked_fill_receives_no_clicks(ring, how):
    click_row(ring, "Shape 1", spot=how)
    ring.click((2.2, 0.3))
    assert ring.curve.name == "Side"


def test_within_the_shape_that_is_edited_a_rubber_band_begins(ring):
    ring.session.selected.activate(0)
    ring.drag((2.0, -0.5), (3.5, 0.5))
    assert ring.session.selection == {0}
    assert ring.curve.name == "Outer"


@pytest.mark.parametrize("how", ["pen", "pencil", "paste"])
def test_drawn_and_pasted_curves_are_in_front(ring, how):
    ring.session.selected.activate(0)
    if how == "pen":
        ring.trigger("addTool")
        ring.click((4.2, 2.0))
    elif how == "pencil":
        ring.trigger("pencilTool")
        ring.press((4.2, -2.0))
        for y in (-1.0, 0.0, 1.0, 2.0):
            ring.move((4.2 + 0.1 * y * y, y))
        ring.release((4.6, 2.0))
        until(lambda: len(names(ring)) == 4)
    else:
        ring.paste_text("0 5\n1 6\n2 5")
        ring.trigger("pasteAsCurve")
    assert shapes(ring) == ["Shape 1", "Shape 1", "", ""]
    assert names(ring)[3] == "Curve 1"


# Whole shapes and groups on the canvas


@pytest.fixture
def whole(rings):
    """Outer and Inner a shape, with Side in a group; none is edited, and none chosen."""
    rings.session.selected.select_whole({0, 1})
    rings.trigger("combineCurves")
    rings.session.selected.select_whole({0, 1, 2})
    rings.trigger("groupCurves")
    rings.session.selected.select_whole(())
    rings.settle()
    return rings


def chosen_as_wholes(editor):
    return {editor.session.document.curves[place].name for place in editor.session.selected.whole_curves}


ALL = {"Outer", "Inner", "Side"}


def test_a_click_selects_the_whole_group_and_a_double_click_enters_the_group(whole):
    whole.hover((6.0, 0.3))
    assert "move “Group 1”" in whole.window.status_line.hint
    assert "click to select it, double-click to edit it" in whole.window.status_line.hint
    whole.click((6.0, 0.3))
    assert (chosen_as_wholes(whole), whole.status) == (ALL, "“Group 1” is selected.")
    whole.double_click((6.0, 0.3))
    assert (whole.session.selected.is_editing, whole.curve.name) == (True, "Side")


def test_with_ctrl_a_click_passes_over_the_group(whole):
    whole.click((6.0, 0.3), keys=CTRL)
    assert chosen_as_wholes(whole) == {"Side"}
    # Now the group is entered.
    whole.click((2.2, 0.3))
    assert (chosen_as_wholes(whole), whole.status) == ({"Outer", "Inner"}, "“Shape 1” is selected.")
    whole.click((4.2, 2.5))
    whole.click((2.2, 0.3))
    assert chosen_as_wholes(whole) == ALL


def test_shift_click_adds_and_removes_whole_shapes(whole):
    whole.trigger("selectAllCurves")
    whole.trigger("ungroupCurves")
    whole.session.selected.select_whole(())
    for at, expected in (((6.0, 0.3), {"Side"}), ((2.2, 0.3), ALL), ((2.2, 0.3), {"Side"})):
        whole.click(at, keys=SHIFT)
        assert chosen_as_wholes(whole) == expected


def test_a_drag_within_a_fill_moves_all_of_the_group(whole):
    before = [point.position for curve in whole.session.document.curves for point in curve.points]
    whole.drag((2.2, 0.3), (2.2, 1.3))
    after = [point.position for curve in whole.session.document.curves for point in curve.points]
    ways = np.subtract(after, before)
    assert np.ptp(ways, axis=0) == pytest.approx((0, 0), abs=1e-12)
    assert ways[0] == pytest.approx((0, 1), abs=2 * whole.pixel)
    assert undo_text(whole) == "Move Group 1"


def test_shift_drag_over_a_fill_is_a_rubber_band(whole):
    whole.drag((6.5, 0.2), (6.6, 0.4), keys=SHIFT)
    assert (chosen_as_wholes(whole), undo_text(whole)) == (set(), "Group 1 shape and 1 curve")
    whole.session.selected.select_whole({2})
    whole.trigger("ungroupCurves")
    whole.session.selected.select_whole(())
    whole.drag((4.5, -1.5), (7.5, 1.5), keys=SHIFT)
    assert chosen_as_wholes(whole) == {"Side"}


def test_shapes_and_groups_count_as_one_item(whole):
    """A word and a circle were "15 curves"."""
    whole.session.selected.select_whole({0, 1, 2})
    whole.trigger("ungroupCurves")
    assert whole.action("deleteCurve").text() == "Delete 1 Shape and 1 Curve"
    whole.drag((2.2, 0.3), (2.2, 1.3))
    assert undo_text(whole) == "Move 1 shape and 1 curve"
    whole.trigger("duplicateCurve")
    assert undo_text(whole) == "Duplicate 1 shape and 1 curve"
    assert whole.status.startswith("Copies of 1 shape and 1 curve lie on the originals")
    whole.trigger("groupCurves")
    assert whole.status == "“Group 1” has 1 shape and 1 curve."
    model = view_of(whole).curves
    assert "group of 1 shape and 1 curve" in model.index(row_named(whole, "Group 1")).data(
        Qt.ItemDataRole.AccessibleTextRole
    )
    assert whole.action("deleteCurve").text() == "Delete Group"


def test_a_rubber_band_selects_shapes_and_groups_as_a_whole(whole):
    whole.drag((-2.0, 2.8), (4.3, -2.9))
    assert chosen_as_wholes(whole) == set()
    whole.drag((-3.3, 3.3), (4.5, -3.3))
    assert chosen_as_wholes(whole) == set()
    whole.drag((-3.3, 3.3), (7.3, -3.3))
    assert chosen_as_wholes(whole) == ALL


def test_the_menu_of_a_fill_is_about_the_whole_group(whole):
    whole.open_menu((2.2, 0.3))
    assert chosen_as_wholes(whole) == ALL
    whole.choose("ungroupCurves")
    assert groups(whole) == [()] * 3


# While a curve of a shape is edited


@pytest.fixture
def edited(ring):
    """The ring, whose outer curve is edited."""
    ring.session.selected.activate(0)
    ring.settle()
    return ring


def test_another_curve_of_the_shape_bends_at_once(edited):
    at = tuple(float(x) for x in edited.session.views[1].curve.evaluate(0.1))
    edited.hover(at)
    assert edited.window.status_line.hint.startswith("Drag to bend “Inner” or move one of its points")
    edited.drag(at, (at[0] + 0.3, at[1] + 0.3))
    assert (edited.curve.name, undo_text(edited)[:4]) == ("Inner", "Bend")
    edited.trigger("undo")
    edited.session.selected.activate(0)
    edited.drag((1.5, 0.0), (1.8, 0.4))
    assert edited.session.document.curves[1].points[0].position == pytest.approx(
        (1.8, 0.4), abs=2 * edited.pixel
    )
    assert shapes(edited) == ["Shape 1", "Shape 1", ""]


def test_a_drag_over_the_fill_of_another_curve_is_a_rubber_band_and_a_click_edits_that_curve(edited):
    document = edited.session.document
    edited.hover((6.3, 0.2))
    hint = edited.window.status_line.hint
    assert (
        hint
        == "Click to edit “Side” · Shift+click: add it to the selection · Drag: select with a rubber band"
    )
    edited.drag((6.3, 0.4), (2.5, -0.5))
    assert (edited.curve.name, edited.session.selection) == ("Outer", {0})
    assert edited.session.document is document
    edited.click((6.3, 0.2))
    assert edited.curve.name == "Side"


def test_shift_click_within_a_fill_adds_its_curve(edited):
    edited.click((6.3, 0.2), keys=SHIFT)
    assert selected_names(edited) == {"Outer", "Side"}
    edited.session.selected.activate(2)
    edited.click((2.2, 0.3), keys=SHIFT)
    assert selected_names(edited) == ALL


def test_the_points_of_the_other_curves_of_the_shape_are_visible(edited):
    canvas = edited.window.canvas

    def has_rim():
        """Whether there is something of the accent's blue at the top of the hole, where all else is red."""
        edited.settle()
        image, (x, y) = canvas.viewport().grab().toImage(), canvas.to_pixel(0.0, 1.5).toTuple()
        colours = [QColor(image.pixel(x + dx, y)) for dx in range(-4, 5)]
        return any(colour.blue() - colour.red() > 100 for colour in colours)

    assert has_rim()
    edited.session.selected.activate(2)
    assert not has_rim()


# With what acts on chosen curves


def test_groups_are_aligned_whole(group):
    group.trigger("selectAllCurves")
    before = group.session.document
    group.session.selected.select_whole({0, 1, 2})
    group.trigger("alignLeft")
    ways = [
        np.subtract(new.points[0].position, old.points[0].position)
        for new, old in zip(group.session.document.curves, before.curves, strict=True)
    ]
    # Inner and Side begin at -1.5, Outer at -3.
    assert np.array(ways) == pytest.approx(np.array([(0, 0), (-1.5, 0), (-1.5, 0)]), abs=1e-9)


def test_a_shape_in_a_group_is_copied_whole_and_pasted_as_one_of_its_own(group):
    click_row(group, "Group 1")
    group.trigger("combineCurves")
    group.session.selected.activate(1)
    group.key(Qt.Key.Key_C, CTRL)
    assert group.status == "Copied “Group 1”."
    group.key(Qt.Key.Key_V, CTRL | ALT)
    assert shapes(group) == ["", "Shape 1", "Shape 1", "Shape 1 copy", "Shape 1 copy"]
    assert groups(group) == [(), ("Group 1",), ("Group 1",), ("Group 1 copy",), ("Group 1 copy",)]
    group.key(Qt.Key.Key_X, CTRL)
    assert shapes(group) == ["", "Shape 1", "Shape 1"]


# Many


def test_leaving_a_curve_of_a_shape_selects_the_shape(edited):
    edited.escape()
    assert chosen_as_wholes(edited) == {"Outer", "Inner"}
    assert edited.status.startswith("“Shape 1” is selected as a whole")
    edited.key(Qt.Key.Key_Delete)
    assert (names(edited), edited.status) == (["Side"], "Deleted “Shape 1”.")


def test_a_contour_that_is_highlighted_in_the_list_is_duplicated_and_copied_as_a_curve_of_its_own(ring):
    fold(ring, "Shape 1")
    click_row(ring, "Inner")
    ctrl_in_list(ring, Qt.Key.Key_D)
    assert names(ring) == ["Outer", "Inner", "Inner copy", "Side"]
    assert shapes(ring) == ["Shape 1", "Shape 1", "", ""]
    assert (ring.curve.name, undo_text(ring)) == ("Inner copy", "Duplicate Inner")
    assert ring.curve.style.fill == RING.fill
    ring.trigger("undo")
    click_row(ring, "Inner")
    ctrl_in_list(ring, Qt.Key.Key_C)
    assert ring.status == "Copied “Inner”."
    ctrl_in_list(ring, Qt.Key.Key_V)
    assert len(names(ring)) == 4
    assert shapes(ring).count("Shape 1") == 2
    assert shapes(ring).count("") == 2


def test_cut_removes_a_contour_alone_or_the_whole_shape_by_its_row(ring):
    fold(ring, "Shape 1")
    click_row(ring, "Inner")
    ctrl_in_list(ring, Qt.Key.Key_X)
    assert (names(ring), shapes(ring)) == (["Outer", "Side"], ["", ""])
    assert (ring.status, undo_text(ring)) == ("Cut “Inner”.", "Cut Inner")
    ring.trigger("undo")
    click_row(ring, "Shape 1")
    ctrl_in_list(ring, Qt.Key.Key_D)
    assert shapes(ring) == ["Shape 1", "Shape 1", "Shape 1 copy", "Shape 1 copy", ""]


def test_a_folded_shape_opens_under_a_resting_drag(ring):
    view = view_of(ring)
    port, start, onto = view.viewport(), place_in(ring, "Side"), place_in(ring, "Shape 1")
    QTest.mousePress(port, LEFT, pos=start)
    QTest.mouseMove(port, (start + onto) / 2)
    QTest.mouseMove(port, onto)
    assert rows(ring) == ["Side", "Shape 1"]
    opening = view._drag._opening
    assert opening.interval() == OPENS_MS
    opening.setInterval(0)
    until(lambda: rows(ring) == ["Side", "Shape 1", "  Inner", "  Outer"])
    opening.setInterval(OPENS_MS)
    # On, to a place between its curves.
    between = QPoint(onto.x() + 20, top_of(ring, "Outer"))
    QTest.mouseMove(port, between)
    QTest.mouseRelease(port, LEFT, pos=between)
    ring.settle()
    assert names(ring) == ["Outer", "Side", "Inner"]
    assert shapes(ring) == ["Shape 1"] * 3


def test_style_displays_the_name_of_a_shape_and_the_menu_of_a_curve_opens_style(ring):
    """Style named one of its curves, and said so of points of two."""
    ring.session.selected.activate(0)
    ring.show_dock("styleDock")
    name = ring.session.document.curves[0].shape
    assert ring.window.findChild(QLabel, "styleSubject").text() == name != ring.curve.name
    menu = bar_menu(ring.window.context, CURVE_MENU)
    (order,) = [each.menu() for each in menu.actions() if each.text() == "Order"]
    assert {"raiseCurve", "lowerCurve"} <= {each.objectName() for each in order.actions()}
    assert "groupCurves" in {each.objectName() for each in menu.actions()}
