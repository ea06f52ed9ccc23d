"""Layers as in Inkscape: what is drawn comes into the present one, empty ones stay; real mouse and keys."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel

from app.actions.strips import CURVE_LIST_MENU
from app.document.layers import layer_of, with_layer_looks
from app.document.shape_edits import moved_into
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.features.curve_list.row_parts import Spot, spot_rect
from app.storage.format import decode, encode
from app.tools.canvas.select import SELECT
from app.workbench.strip_menu import strip_menu
from tests.gui.curve_rows import rows, view_of

LEFT = Qt.MouseButton.LeftButton
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier

SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60" height="40" viewBox="0 0 60 40"'
    ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    ' xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd">'
    '<g inkscape:groupmode="layer" inkscape:label="Back">'
    '<path id="ground" d="M0 0H60V40H0Z" fill="#eee"/></g>'
    '<g inkscape:groupmode="layer" inkscape:label="Sketch" style="display:none"/>'
    '<g inkscape:groupmode="layer" inkscape:label="Art"><g inkscape:groupmode="layer" inkscape:label="Inner"'
    ' sodipodi:insensitive="true"/><path id="left" d="M5 5H20V20H5Z" fill="#00aa00"/>'
    '<path id="right" d="M40 5H55V20H40Z" fill="#aa0000"/></g>'
    '<g inkscape:groupmode="layer" inkscape:label="Notes"></g></svg>'
)
ORDER = ("Back", "Sketch", "Art", "Inner", "Notes")


@pytest.fixture
def layered(editor):
    """Layers Back and Art, Sketch (empty, hidden), Notes (empty), and in Art Inner (empty, locked)."""
    document = replace(read_svg(SVG.encode()).document, unit="", page=None)
    editor.session.commit(document, "Begin", active=1)
    editor.session.selected.choose((1,))
    editor.show_dock("curvesDock")
    editor.fit()
    return editor


def layer_now(editor):
    """What the status line says of the layer; empty where it says nothing."""
    editor.settle()
    label = editor.window.findChild(QLabel, "layerNow")
    return label.text() if not label.isHidden() else ""


def click_row(editor, name, spot=Spot.NAME):
    view, row = view_of(editor), [each.strip() for each in rows(editor)].index(name)
    QTest.mouseClick(view.viewport(), LEFT, pos=spot_rect(view.parts.entry_rect(row), spot).center())
    editor.settle()


def drag_row(editor, row, end):
    view = view_of(editor)
    QTest.mousePress(view.viewport(), LEFT, pos=view.parts.entry_rect(row).center())
    QTest.mouseMove(view.viewport(), end + QPoint(0, 8))
    QTest.mouseMove(view.viewport(), end)
    QTest.mouseRelease(view.viewport(), LEFT, pos=end)
    editor.settle()


def layers(editor):
    document = editor.session.document
    return {curve.name: layer_of(document, place) for place, curve in enumerate(document.curves)}


def draw(editor, tool, start, to):
    editor.trigger(tool)
    editor.drag(start, to)
    editor.settle()


def newest(editor):
    return editor.session.document.curves[editor.session.active_index]


def test_whatever_is_new_comes_to_the_front_of_the_present_layer(layered, qtbot):
    """It came in front of all layers, and in none of them."""
    editor, session = layered, layered.session
    assert layer_now(editor) == "Layer: Art"
    draw(editor, "rectangleTool", (25, -5), (35, -15))
    # Behind what is in front of its layer, had there been anything.
    assert [curve.name for curve in session.document.curves] == ["ground", "left", "right", "Rectangle 1"]
    assert newest(editor).groups == ("Art",)
    click_row(editor, "Back")
    assert layer_now(editor) == "Layer: Back"
    draw(editor, "ellipseTool", (26, -4), (36, -14))
    assert session.active_index == 1
    assert newest(editor).groups == ("Back",)
    click_row(editor, "Notes")
    assert session.selected.marked == frozenset()
    editor.trigger("addTool")
    editor.click((3, -33))
    editor.click((10, -30))
    editor.key(Qt.Key.Key_Return)
    assert newest(editor).groups == ("Notes",)
    assert len(newest(editor).points) == 2
    draw(editor, "pencilTool", (3, -25), (20, -28))
    qtbot.waitUntil(lambda: newest(editor).name == "Curve 2")
    assert newest(editor).groups == ("Notes",)
    assert layer_now(editor) == "Layer: Notes"
    # Choosing a curve makes its layer the present one, and choosing nothing leaves it.
    editor.trigger("selectTool")
    editor.escape()
    editor.escape()
    editor.click((47, -12))
    assert layer_now(editor) == "Layer: Art"
    editor.trigger("copyPoints")
    click_row(editor, "Notes")
    editor.trigger("pasteInPlace")
    assert newest(editor).groups == ("Notes",)
    assert newest(editor).name == "right copy"
    session.selected.choose((session.document.curves.index(newest(editor)), 2))
    editor.trigger("duplicateCurve")
    copies = [curve for curve in session.document.curves if "copy" in curve.name]
    assert sorted(curve.groups for curve in copies) == [("Art",), ("Notes",), ("Notes",)]
    assert session.document.layers == ORDER


def test_a_layer_stays_the_present_one_through_tools_and_escape(layered):
    """A tool that is taken edits the active curve, and Escape chooses what was chosen before."""
    editor = layered
    click_row(editor, "Notes")
    editor.trigger("addTool")
    assert layer_now(editor) == "Layer: Notes"
    editor.trigger("rectangleTool")
    editor.press((25, -5))
    editor.move((30, -9))
    assert "Notes" in layers(editor).values()
    editor.escape()
    editor.release((30, -9))
    assert "Notes" not in layers(editor).values()
    assert layer_now(editor) == "Layer: Notes"


def test_nothing_is_drawn_in_a_layer_that_is_hidden_or_locked(layered):
    editor = layered
    before = editor.session.document
    for name, why in (("Sketch", "hidden; show it"), ("Art", "locked; unlock it")):
        if name == "Art":
            click_row(editor, name, Spot.LOCK)
            before = editor.session.document
            assert [curve.locked for curve in before.curves] == [False, True, True]
        click_row(editor, name)
        for tool in ("rectangleTool", "pencilTool", "addTool"):
            draw(editor, tool, (25, -25), (35, -35))
            assert f"The layer “{name}” is {why}" in editor.status
            assert editor.session.document is before
    click_row(editor, "Sketch", Spot.EYE)
    assert editor.session.undo_stack.undoText() == "Show Sketch"
    click_row(editor, "Sketch")
    draw(editor, "rectangleTool", (25, -25), (35, -35))
    assert newest(editor).groups == ("Sketch",)
    assert editor.session.active_index == 1


def test_empty_layers_stay_in_the_list_and_in_files(layered):
    """They were lost when a drawing came in, and a layer went with its last curve."""
    editor, session = layered, layered.session
    assert rows(editor) == ["Notes", "Art", "Sketch", "Back"]
    click_row(editor, "Back")
    editor.trigger("selectAllInLayer")
    editor.trigger("deleteSelection")
    assert rows(editor) == ["Notes", "Art", "Sketch", "Back"]
    document = session.document
    assert [each.name for each in document.empty_layers] == ["Back", "Sketch", "Inner", "Notes"]
    assert decode(encode(document)) == document
    text = svg_of(document, Options()).text
    again = read_svg(text.encode()).document
    assert (again.layers, again.empty_layers) == (document.layers, document.empty_layers)
    places = [text.index(f'"{name}"') for name in ("Back", "Sketch", "Art", "left", "Inner", "Notes")]
    assert places == sorted(places)
    assert text.count("insensitive") == text.count("display:none") == 1
    editor.trigger("undo")
    assert session.document.curves[0].groups == ("Back",)
    assert [each.name for each in session.document.empty_layers] == ["Sketch", "Inner", "Notes"]


def test_layers_are_made_named_stepped_and_deleted(layered):
    editor, session = layered, layered.session
    editor.key(Qt.Key.Key_L, CTRL | SHIFT)
    assert layer_now(editor) == "Layer: Layer 1"
    assert session.document.layers == ("Back", "Sketch", "Art", "Inner", "Layer 1", "Notes")
    editor.trigger("lowerLayer")
    editor.trigger("lowerLayer")
    assert rows(editor) == ["Notes", "Art", "Sketch", "Layer 1", "Back"]
    editor.trigger("raiseLayer")
    click_row(editor, "Layer 1")
    QTest.keyClick(view_of(editor), Qt.Key.Key_F2)
    field = QApplication.focusWidget()
    field.selectAll()
    editor.type_text(field, "Ink")
    QTest.keyClick(field, Qt.Key.Key_Return)
    editor.settle()
    assert rows(editor) == ["Notes", "Art", "Ink", "Sketch", "Back"]
    assert layer_now(editor) == "Layer: Ink"
    # The whole of Art, behind Ink; what is in it goes along.
    click_row(editor, "Art")
    editor.trigger("lowerLayer")
    assert rows(editor) == ["Notes", "Ink", "Art", "Sketch", "Back"]
    editor.trigger("lowerLayer")
    editor.trigger("lowerLayer")
    assert rows(editor) == ["Notes", "Ink", "Sketch", "Back", "Art"]
    assert [curve.name for curve in session.document.curves] == ["left", "right", "ground"]
    assert not editor.action("lowerLayer").isEnabled()
    # Delete in the list takes an empty layer, and one with what is in it.
    click_row(editor, "Ink")
    QTest.keyClick(view_of(editor), Qt.Key.Key_Delete)
    assert rows(editor) == ["Notes", "Sketch", "Back", "Art"]
    click_row(editor, "Art")
    QTest.keyClick(view_of(editor), Qt.Key.Key_Delete)
    assert session.document.layers == ("Back", "Sketch", "Notes")
    assert [curve.name for curve in session.document.curves] == ["ground"]
    assert editor.session.undo_stack.undoText() == "Delete Art"


def test_the_name_of_a_new_layer_is_typed_at_once(layered):
    """Its row was not the current one: Enter renamed another, and letters took tools."""
    editor, session, view = layered, layered.session, view_of(layered)
    editor.show_dock("styleDock")
    dock = editor.window.findChild(QDockWidget, "curvesDock")
    assert dock.visibleRegion().isEmpty()
    editor.window.canvas.setFocus()
    editor.key(Qt.Key.Key_L, CTRL | SHIFT)
    editor.settle()
    assert not dock.visibleRegion().isEmpty()
    field = QApplication.focusWidget()
    assert field.objectName() == "curveNameEditor"
    assert field.text() == field.selectedText() == "Layer 1"
    QTest.keyClicks(field, "pen")
    QTest.keyClick(field, Qt.Key.Key_Return)
    editor.settle()
    assert editor.window.store.state.tool is SELECT
    assert rows(editor) == ["Notes", "pen", "Art", "Sketch", "Back"]
    assert rows(editor)[view.current] == "pen"
    assert layer_now(editor) == "Layer: pen"
    # In a folded one; Escape keeps what it is called.
    session.selected.set_layer("Inner")
    view.curves.open(2, False)
    editor.key(Qt.Key.Key_L, CTRL | SHIFT)
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_X)
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Escape)
    editor.settle()
    assert rows(editor)[2:5] == ["Art", "  Layer 1", "  Inner"]
    assert rows(editor)[view.current] == "  Layer 1"
    QTest.keyClick(view, Qt.Key.Key_Delete)
    assert "Layer 1" not in session.document.layers


def test_the_only_object_of_a_layer_is_chosen_by_its_own_name_and_delete_takes_it_alone(layered):
    """A ring alone in a layer was called by the name of that."""
    ring = SVG.replace('d="M0 0H60V40H0Z"', 'fill-rule="evenodd" d="M0 0H60V40H0ZM25 5H35V20H25Z"')
    document = replace(read_svg(ring.encode()).document, unit="", page=None)
    layered.session.commit(document, "Ring", active=2)
    layered.session.selected.choose(())
    layered.show_dock("transformDock")
    layered.fit()
    layered.click((30.0, min(point.y for point in document.curves[0].points) + 3.0))
    layered.settle()
    assert layered.session.selected.chosen == {0, 1}
    name = document.curves[0].shape
    assert layered.window.findChild(QLabel, "transformWhat").text() == name != "Back"
    layered.window.canvas.setFocus()
    layered.key(Qt.Key.Key_Delete)
    assert layered.session.undo_stack.undoText() == f"Delete {name}"
    assert "Back" in layered.session.document.layers


def test_a_layer_has_a_short_menu_of_its_own(layered):
    """It had the whole menu of curves, taller than the window."""
    editor, session, view = layered, layered.session, view_of(layered)

    def menu_on(name):
        view.scrollToTop()
        place = view.parts.entry_rect([each.strip() for each in rows(editor)].index(name)).center()
        where = view.viewport().mapToGlobal(place)
        QApplication.sendEvent(
            view.viewport(), QContextMenuEvent(QContextMenuEvent.Reason.Mouse, place, where)
        )
        menu = QApplication.activePopupWidget()
        return menu, {each.objectName(): each for each in menu.actions() if not each.isSeparator()}

    menu, entries = menu_on("Notes")
    assert list(entries) == [
        "renameLayer",
        "layerVisible",
        "layerLocked",
        "newLayer",
        "raiseLayer",
        "lowerLayer",
        "selectAllInLayer",
        "deleteLayer",
    ]
    assert entries["renameLayer"].isEnabled()
    QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(entries["layerLocked"]).center())
    assert session.undo_stack.undoText() == "Lock Notes"
    menu, entries = menu_on("Art")
    QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(entries["layerVisible"]).center())
    assert [curve.visible for curve in session.document.curves] == [True, False, False]
    menu, entries = menu_on("Back")
    QTest.mouseClick(menu, LEFT, pos=menu.actionGeometry(entries["renameLayer"]).center())
    assert QApplication.focusWidget().text() == "Back"
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Escape)
    view.curves.open(rows(editor).index("Back"), True)
    menu, entries = menu_on("ground")
    assert "renameCurve" in entries
    assert not {"raiseLayer", "lowerLayer", "deleteLayer"} & set(entries)
    menu.close()


def test_what_is_chosen_moves_to_the_layer_above_or_below(layered):
    editor, session = layered, layered.session
    editor.key(Qt.Key.Key_PageUp, SHIFT)
    assert "The layer “Inner” is locked" in editor.status
    session.change("Unlock", lambda document: with_layer_looks(document, "Inner", locked=False))
    editor.window.activateWindow()
    for name in ("Inner", "Notes"):
        editor.key(Qt.Key.Key_PageUp, SHIFT)
        assert layers(editor)["left"] == name
        assert session.undo_stack.undoText() == f"Move left to layer {name}"
        assert {session.document.curves[place].name for place in session.selected.chosen} == {"left"}
        assert layer_now(editor) == f"Layer: {name}"
    assert not editor.action("moveToLayerAbove").isEnabled()
    assert session.document.layers == ORDER
    for name in ("Inner", "Art"):
        editor.key(Qt.Key.Key_PageDown, SHIFT)
        assert layers(editor)["left"] == name
    assert [curve.name for curve in session.document.curves] == ["ground", "right", "left"]
    editor.key(Qt.Key.Key_PageDown, SHIFT)
    assert "The layer “Sketch” is hidden" in editor.status


def test_a_curve_is_dragged_into_an_empty_layer(layered):
    editor, view = layered, view_of(layered)
    view.curves.open(1, True)
    editor.settle()
    assert rows(editor) == ["Notes", "Art", "  Inner", "  right", "  left", "Sketch", "Back"]
    drag_row(editor, 3, view.parts.entry_rect(0).center())
    assert editor.session.undo_stack.undoText() == "Move right to layer Notes"
    assert layers(editor) == {"ground": "Back", "left": "Art", "right": "Notes"}


def test_a_row_falls_into_the_layer_on_the_lower_half_of_whose_last_row_it_is_dropped(layered):
    """It fell behind all layers, and into none."""
    editor, view = layered, view_of(layered)
    view.curves.open(rows(editor).index("Back"), True)
    view.curves.open(rows(editor).index("Art"), True)
    editor.settle()
    right, ground = (rows(editor).index(f"  {name}") for name in ("right", "ground"))
    low = view.parts.entry_rect(ground).center() + QPoint(0, view.parts.entry_rect(ground).height() // 2 - 3)
    drag_row(editor, right, low)
    assert layers(editor) == {"right": "Back", "ground": "Back", "left": "Art"}
    # And one that is in no layer.
    editor.session.change("Take out", lambda d: moved_into(d, {2}, 3, left=d.layers).document)
    editor.settle()
    assert layers(editor)["left"] == ""
    last = rows(editor).index("  right")
    low = view.parts.entry_rect(last).center() + QPoint(0, view.parts.entry_rect(last).height() // 2 - 3)
    drag_row(editor, rows(editor).index("left"), low)
    assert layers(editor)["left"] == "Back"


def test_without_layers_nothing_tells_of_them_until_there_is_one(editor):
    editor.show_dock("curvesDock")
    assert layer_now(editor) == ""
    draw(editor, "rectangleTool", (1, 1), (2, 2))
    assert newest(editor).groups == ()
    editor.session.new()
    editor.key(Qt.Key.Key_L, CTRL | SHIFT)
    assert rows(editor) == ["Layer 1", "Curve 1"]
    # The curve that a new document begins with is drawn where new curves are.
    editor.trigger("addTool")
    editor.click((0.1, 0.1))
    editor.click((0.4, 0.3))
    document = editor.session.document
    assert [(curve.name, curve.groups, len(curve.points)) for curve in document.curves] == [
        ("Curve 1", ("Layer 1",), 2)
    ]
    assert document.empty_layers == ()


@pytest.mark.parametrize("delete", ["deleteSelection", "deleteCurve"])
def test_with_everything_deleted_the_next_drawing_comes_into_the_same_layer(layered, delete):
    assert layer_now(layered) == "Layer: Art"
    before, order = layered.session.document, layered.session.document.layers
    layered.session.selected.choose(range(3))
    layered.session.selected.set_layer("Art")
    layered.trigger(delete)
    assert (layer_now(layered), layered.session.document.layers) == ("Layer: Art", order)
    # What is left is the empty curve that is drawn next.
    assert list(layers(layered).values()) == ["Art"]
    draw(layered, "rectangleTool", (10, -10), (20, -20))
    assert list(layers(layered).values()) == ["Art"]
    assert len(layered.curve.points) > 1
    layered.trigger("undo")
    layered.trigger("undo")
    assert layered.session.document == before


def test_all_in_a_layer_is_chosen_and_nothing_locked_or_of_another_layer(layered):
    session = layered.session
    layered.trigger("selectAllInLayer")
    assert {session.document.curves[at].name for at in session.selected.chosen} == {"left", "right"}
    assert session.selected.layer == "Art"
    click_row(layered, "Back")
    layered.trigger("selectAllInLayer")
    assert {session.document.curves[at].name for at in session.selected.chosen} == {"ground"}
    click_row(layered, "Sketch")
    before = session.selected.choice
    layered.trigger("selectAllInLayer")
    assert layered.status == "“Sketch” has no curve that is seen and not locked."
    assert session.selected.choice == before


def test_a_click_on_the_row_of_a_layer_chooses_nothing_in_it(layered):
    """It chose all of it, so that a swatch or a key hit the whole layer."""
    session, before = layered.session, layered.session.document
    click_row(layered, "Art")
    assert (layer_now(layered), session.selected.marked) == ("Layer: Art", frozenset())
    assert not layered.action("cutPoints").isEnabled()
    QTest.keyClick(view_of(layered), Qt.Key.Key_Down)
    assert session.selected.marked == frozenset()
    assert layer_now(layered) == "Layer: Sketch"
    assert session.document == before


def test_delete_on_the_row_of_a_layer_says_what_it_deletes_and_of_another_row_takes_that(layered):
    session, before = layered.session, layered.session.document
    click_row(layered, "Art")
    QTest.keyClick(view_of(layered), Qt.Key.Key_Delete)
    assert [curve.name for curve in session.document.curves] == ["ground"]
    assert layered.status == "Deleted layer “Art” with 2 curves."
    layered.trigger("undo")
    assert session.document == before
    click_row(layered, "Notes")
    QTest.keyClick(view_of(layered), Qt.Key.Key_Delete)
    assert layered.status == "Deleted layer “Notes”, which was empty."
    assert len(session.document.curves) == 3


def test_the_menu_of_a_row_has_the_submenus_of_the_canvas(layered):
    """Order stood there entry by entry, layers and looks not at all."""
    menu = strip_menu(layered.window.context, CURVE_LIST_MENU)
    submenus = {each.text(): each.menu() for each in menu.actions() if each.menu()}
    assert list(submenus) == ["Order", "Paths", "Layer"]
    names = {each.objectName() for each in menu.actions()}
    assert "raiseCurve" not in names
    of_layers = {each.objectName() for each in submenus["Layer"].actions()} - {""}
    assert of_layers == {"moveToLayerAbove", "moveToLayerBelow"}
    assert {"raiseCurve", "lowerToBottom"} <= {each.objectName() for each in submenus["Order"].actions()}


def test_all_that_is_hidden_is_shown_and_all_that_is_locked_is_freed_layers_too(layered):
    session = layered.session
    session.selected.choose(())
    layered.click_in_list(0, Spot.EYE)
    layered.click_in_list(2, Spot.LOCK)
    assert not session.document.curves[0].visible
    assert session.document.curves[2].locked
    layered.trigger("showAll")
    assert all(curve.visible for curve in session.document.curves)
    assert all(layer.visible for layer in session.document.empty_layers)
    assert session.undo_stack.undoText() == "Show all"
    layered.trigger("showAll")
    assert layered.status == "Nothing is hidden."
    layered.trigger("unlockAll")
    assert not any(part.locked for part in (*session.document.curves, *session.document.empty_layers))
    layered.trigger("unlockAll")
    assert layered.status == "Nothing is locked."
    layered.trigger("undo")
    layered.trigger("undo")
    assert [layer.name for layer in session.document.empty_layers if not layer.visible] == ["Sketch"]
    assert not session.document.curves[0].visible
    assert session.document.curves[2].locked
