"""The strip of colours below the canvas, and palettes from files."""

from __future__ import annotations

import colorsys

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QFileDialog, QListWidget, QMenu

from app.document.style_edits import colours_of
from app.storage.files import StorageError
from app.storage.gimp_palette import read_gimp_palette
from app.view_model.look.palettes import PALETTES

GPL = """GIMP Palette
Name: House
Columns: 2
# two colours
255   0   0\tLoud red
  0 128 255 Sky
"""


@pytest.fixture
def drawn(editor):
    """A drawing with one rectangle, chosen."""
    editor.trigger("newDrawing")
    editor.trigger("rectangleTool")
    editor.drag((20, 20), (90, 90))
    editor.trigger("selectTool")
    editor.session.selected.choose({0})
    show(editor, "Open Color")
    return editor


def strip(editor):
    return editor.window.findChild(QListWidget, "paletteSwatches")


def at(swatches, words):
    """Return where a colour is, by what a screen reader says."""
    said = [swatches.item(row).data(Qt.ItemDataRole.AccessibleTextRole) for row in range(swatches.count())]
    item = swatches.item(next(row for row, each in enumerate(said) if each.startswith(words)))
    swatches.scrollToItem(item)
    return swatches.visualItemRect(item).center()


def click(swatches, words, modifiers=Qt.KeyboardModifier.NoModifier, button=Qt.MouseButton.LeftButton):
    QTest.mouseClick(swatches.viewport(), button, modifiers, at(swatches, words))


def style(editor):
    return editor.session.document.curves[0].style


def show(editor, title):
    box = editor.window.findChild(QComboBox, "paletteBox")
    box.setCurrentText(title)
    box.activated.emit(box.currentIndex())


def test_it_is_shown_in_drawings_and_switched_by_its_action(editor):
    # Where another test has had a drawing in this window, it is made already.
    assert strip(editor) is None or not strip(editor).isVisible()
    editor.trigger("newDrawing")
    assert strip(editor).isVisible()
    editor.trigger("togglePalette")
    assert not strip(editor).isVisible()
    editor.trigger("togglePalette")
    assert strip(editor).isVisible()
    editor.trigger("newSketch")
    assert not strip(editor).isVisible()


def test_after_a_click_the_keys_are_the_canvas_s(drawn):
    """Enter painted once more, the fill with what the stroke was painted with."""
    canvas = drawn.window.canvas
    canvas.setFocus()
    had = QApplication.focusWidget()
    click(strip(drawn), "Red, ")
    click(strip(drawn), "None", Qt.KeyboardModifier.ShiftModifier)
    assert (style(drawn).fill, style(drawn).stroke) == ("#fa5252", "none")
    assert QApplication.focusWidget() is had is not None
    QTest.keyClick(had, Qt.Key.Key_Return)
    drawn.settle()
    assert style(drawn).fill == "#fa5252"
    assert drawn.session.selected.is_editing


def test_a_click_paints_the_fill_and_shift_click_the_stroke_one_step_each(drawn):
    swatches, steps = strip(drawn), drawn.session.undo_stack.count()
    before = style(drawn).stroke
    click(swatches, "Red, ")
    assert (style(drawn).fill, style(drawn).stroke) == ("#fa5252", before)
    click(swatches, "Dark teal", Qt.KeyboardModifier.ShiftModifier)
    assert (style(drawn).fill, style(drawn).stroke) == ("#fa5252", "#087f5b")
    assert drawn.session.undo_stack.count() == steps + 2
    assert drawn.session.undo_stack.undoText().startswith("Stroke")
    click(swatches, "None")
    assert style(drawn).fill == "none"
    drawn.trigger("undo")
    drawn.trigger("undo")
    drawn.trigger("undo")
    assert style(drawn).stroke == before


def test_the_right_button_offers_both(drawn, qtbot):
    swatches = strip(drawn)
    place = at(swatches, "Lime")
    QTest.mouseClick(swatches.viewport(), Qt.MouseButton.RightButton, pos=place)
    from PySide6.QtGui import QContextMenuEvent
    from PySide6.QtWidgets import QApplication

    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, place, swatches.viewport().mapToGlobal(place))
    QApplication.sendEvent(swatches.viewport(), event)
    menu = swatches.findChild(QMenu, "swatchMenu")
    qtbot.waitUntil(menu.isVisible)
    assert [each.text() for each in menu.actions()] == ["Set Fill", "Set Stroke"]
    QTest.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(menu.actions()[1]).center())
    assert style(drawn).stroke == "#82c91e"


def test_the_keyboard_reaches_every_colour(drawn):
    swatches = strip(drawn)
    swatches.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(swatches, Qt.Key.Key_Home)
    for _ in range(2):
        QTest.keyClick(swatches, Qt.Key.Key_Right)
    QTest.keyClick(swatches, Qt.Key.Key_Return)
    assert style(drawn).fill == "#ffffff"
    QTest.keyClick(swatches, Qt.Key.Key_Left)
    QTest.keyClick(swatches, Qt.Key.Key_Return, Qt.KeyboardModifier.ShiftModifier)
    assert style(drawn).stroke == "#000000"


def test_without_a_choice_the_next_object_gets_the_colour(editor):
    editor.trigger("newDrawing")
    show(editor, "Open Color")
    editor.trigger("rectangleTool")
    click(strip(editor), "Blue, ")
    editor.drag((20, 20), (90, 90))
    assert style(editor).fill == "#228be6"


def test_the_colours_of_the_document_are_a_palette(drawn):
    click(strip(drawn), "Dark pink")
    show(drawn, "Document’s Colours")
    swatches = strip(drawn)
    tips = [swatches.item(row).toolTip() for row in range(swatches.count())]
    assert [each.split(" (")[0] for each in tips] == ["None", *colours_of(drawn.session.document.curves)]
    count = strip(drawn).count()
    drawn.trigger("undo")
    assert strip(drawn).count() == count - 1


def test_a_palette_of_a_file_is_kept_for_the_next_time(drawn, tmp_path, monkeypatch):
    path = tmp_path / "house.gpl"
    path.write_text(GPL, encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    drawn.trigger("importPalette")
    assert drawn.status == "Imported house.gpl: 2 colours, below the canvas."
    click(strip(drawn), "Sky, #0080ff")
    assert style(drawn).fill == "#0080ff"
    preferences = drawn.window.context.preferences
    assert (preferences.palette_shown, str(path) in preferences.palette_files) == ("House", True)
    # Read again it is there once, with what it holds now.
    path.write_text(GPL + "1 2 3 Third\n", encoding="utf-8")
    drawn.trigger("importPalette")
    box = drawn.window.findChild(QComboBox, "paletteBox")
    assert [box.itemText(row) for row in range(box.count())].count("House") == 1
    assert strip(drawn).count() == 4


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("hello", "It is no GIMP palette"),
        ("GIMP Palette\n1 2\n", "Line 2 is no colour"),
        ("GIMP Palette\n\n1 2 256 x\n", "Line 3 is no colour"),
        ("GIMP Palette\nName: x\n", "It has 0 colours"),
        ("GIMP Palette\n" + "1 2 3\n" * 5000, "It has 5000 colours; a palette has 1 to 4096"),
    ],
)
def test_what_is_no_palette_is_refused_with_the_line(drawn, tmp_path, monkeypatch, text, said):
    path = tmp_path / "bad.gpl"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(StorageError, match=said):
        read_gimp_palette(path)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    drawn.trigger("importPalette")
    assert said in drawn.message
    assert drawn.window.context.preferences.palette_files == ""


def test_names_and_numbers_of_the_palettes_agree():
    """Light shades are lighter than dark ones, greys have no hue, and no colour is twice in a palette."""
    for palette in PALETTES:
        codes = [each.colour for each in palette.swatches]
        assert len(set(codes)) == len(codes)
        assert all(each.name for each in palette.swatches)
        light = {
            each.name: colorsys.rgb_to_hls(*(int(each.colour[at : at + 2], 16) / 255 for at in (1, 3, 5)))
            for each in palette.swatches
        }
        for name, (_, lightness, _) in light.items():
            if name.startswith("Light "):
                assert lightness > light[f"Dark {name.removeprefix('Light ')}"][1]
    assert 40 <= len(PALETTES[0].swatches) <= 44
