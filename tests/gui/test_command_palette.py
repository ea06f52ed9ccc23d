"""The command palette: whatever can be done can be found by a few letters."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLineEdit

from app.actions.keymap import action_name, full_name_of
from app.document.derivatives import DERIVATIVES
from app.document.model import ParametrizationKind
from app.families import HERMITE, QUINTIC_HERMITE
from app.window.command_palette import CommandPalette
from app.window.connect import all_actions
from app.window.fuzzy import fitness


@pytest.fixture
def palette(editor):
    # It is built when it is first opened.
    editor.trigger("commandPalette")
    palette = editor.window.findChild(CommandPalette)
    palette.close_and_return()
    return palette


def press(palette, key):
    QTest.keyClick(palette.search, key)


def test_the_key_opens_the_palette_and_escape_restores_the_focus(editor, palette):
    editor.window.canvas.setFocus()
    held = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_P, held)
    assert palette.isVisible()
    assert palette.search.hasFocus()
    press(palette, Qt.Key.Key_Escape)
    assert not palette.isVisible()
    assert editor.window.canvas.hasFocus()


def test_enter_runs_the_first_match(editor, palette):
    editor.run_command("hermite")
    assert editor.curve.family is HERMITE
    assert not palette.isVisible()
    editor.run_command("quint")
    assert editor.curve.family is QUINTIC_HERMITE


def test_letters_typed_into_the_palette_trigger_no_keys(editor):
    family = editor.curve.family
    editor.find_command("23pv")
    assert editor.curve.family is family
    assert not editor.action("addTool").isChecked()


LETTERS = {
    "sa": "Save As…",
    "side": "Side Panel",
    "sidp": "Side Panel",
    "frz": "Freeze Parameters",
    "export": "Export…",
    "param cheb": "Chebyshev (2nd Kind) Parameters",
    "examples letter": "Letter S",
    "dark": "Theme: Dark",
    "panels history": "History Panel",
}


def test_a_few_letters_find_a_command(editor):
    found = {typed: editor.find_command(typed)[:3] for typed in LETTERS}
    assert {typed: names for typed, names in found.items() if LETTERS[typed] not in names} == {}


def test_the_palette_finds_all_actions_and_all_menu_entries(editor, palette, tmp_path):
    path = tmp_path / "of yesterday.curve.json"
    editor.session.save(path)
    editor.window.open_file(path)
    found = set(editor.find_command(""))
    for each in all_actions():
        if each.name != "commandPalette":
            assert full_name_of(editor.action(each.name)) in found
    assert "of yesterday.curve.json" in found
    assert {"Centripetal Parameters", "Letter S", "Points Panel"} <= found
    editor.window.preferences.clear_recent_files()
    editor.window.menus.recent.aboutToShow.emit()


def test_a_dynamic_action_is_done(editor):
    editor.run_command("centripetal parameters")
    assert editor.curve.parametrization.kind is ParametrizationKind.CENTRIPETAL
    editor.session.files.give_up_changes()
    editor.run_command("runge uniform")
    assert len(editor.curve.points) > 8


def test_up_and_down_move_the_selection_and_wrap_around(editor, palette):
    names = editor.find_command("theme")
    assert len(names) >= 3
    press(palette, Qt.Key.Key_Down)
    assert palette.list.currentIndex().row() == 1
    press(palette, Qt.Key.Key_Up)
    press(palette, Qt.Key.Key_Up)
    assert palette.list.currentIndex().row() == len(names) - 1


def test_a_click_runs_a_command(editor, palette):
    names = editor.find_command("lagrange hermite quintic")
    assert names == []
    names = editor.find_command("hermite")
    row = names.index("Quintic Hermite")
    rect = palette.list.visualRect(palette.list.model().index(row, 0))
    QTest.mouseClick(palette.list.viewport(), Qt.MouseButton.LeftButton, pos=rect.center())
    assert editor.curve.family is QUINTIC_HERMITE
    assert not palette.isVisible()


def test_a_disabled_command_explains_its_reason(editor, palette):
    assert editor.find_command("redo")[0] == "Redo"
    press(palette, Qt.Key.Key_Return)
    assert palette.isVisible()
    assert palette.findChild(type(palette._note), "paletteNote").text() == "Nothing to redo."


def test_a_click_elsewhere_closes_the_palette(editor, palette):
    editor.find_command("sa")
    editor.click((-1.0, -0.2))
    assert not palette.isVisible()


def test_better_fits_come_first():
    names = ["Select All", "Save As…", "Save", "Side Panel", "Presentation"]
    rated = {name: fitness("sa", name) for name in names}
    assert rated["Save"] > rated["Save As…"] > rated["Select All"] > (rated["Presentation"] or 0)
    assert fitness("zzz", "Save") is None
    assert fitness("", "Save") is not None
    assert fitness("save file", "Save", "File") is not None


def test_actions_that_only_show_submenus_are_not_listed(editor):
    found = editor.find_command("")
    assert "Open Recent" not in found
    assert "File" not in found
    assert isinstance(editor.action("undo"), QAction)


def test_a_deleted_action_leaves_the_list(editor, palette, tmp_path):
    """File > Open Recent fills itself anew when it opens: the palette painted actions that were gone."""
    recent = editor.window.menus.recent
    editor.window.preferences.add_recent_file(tmp_path / "a.curve.json")
    recent.aboutToShow.emit()
    editor.trigger("commandPalette")
    listed = len(palette.matches)
    recent.aboutToShow.emit()
    palette.list.viewport().repaint()
    assert len(palette.matches) == listed - 1
    palette.search.setText("a")
    palette.close_and_return()


PEOPLE_TYPE = {
    "akima": "Velocities: Akima",
    "pchip": "Velocities: Monotone (PCHIP)",
    "simplify": "Simplify Paths",
    "reduce": "Fit to Fewer Points…",
    "knot": "Insert Point at the Scrub Line",
    "insert knot": "Insert Point at the Scrub Line",
    "elevate degree": "Insert Point at the Scrub Line",
    "floater": "Barycentric rational",
    "bspline": "B-spline",
}


def test_common_synonyms_find_the_commands(editor):
    """None of these was found, or by letters scattered over something else."""
    assert {typed: editor.find_command(typed)[0] for typed in PEOPLE_TYPE} == PEOPLE_TYPE


def test_the_palette_finds_a_degree_and_leads_to_its_field(editor):
    assert "Barycentric Rational: Blended Degree…" in editor.find_command("degree")
    editor.key(Qt.Key.Key_Escape)
    assert not editor.action("familyFloaterHormannDegree").isEnabled()
    editor.choose_family("floater_hormann")
    editor.run_command("blended degree")
    field = editor.window.findChild(QLineEdit, "settingDegree")
    assert field.hasFocus()
    field.selectAll()
    QTest.keyClicks(field, "5")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert dict(editor.curve.settings) == {"degree": 5}


def paste_command(editor, text):
    """Do what the palette finds first for a text that is pasted: typed, it is looked for at each letter."""
    editor.find_command("")
    editor.paste_text(text)
    search = editor.window.findChild(CommandPalette).search
    QTest.keySequence(search, QKeySequence.StandardKey.Paste)
    assert search.text() == text
    QTest.keyClick(search, Qt.Key.Key_Return)
    editor.settle()


@pytest.mark.parametrize("of", DERIVATIVES, ids=lambda of: of.name)
def test_the_palette_finds_every_tangent_rule_and_the_history_names_the_rule(editor, of):
    editor.choose_family("septic_hermite")
    editor.show_dock("curveDock")
    box = editor.window.findChild(QComboBox, f"{of.name}Rule")
    for place, rule in enumerate(reversed(of.rules)):
        paste_command(editor, f"{of.plural}: {rule.label}")
        assert getattr(editor.curve, of.rule_field) is rule
        assert box.currentText() == rule.label
        assert box.toolTip().endswith(f"{rule.label}: {rule.tip}")
        tip = box.itemData(box.currentIndex(), Qt.ItemDataRole.ToolTipRole)
        assert tip == rule.tip != ""
        action = editor.action(action_name(f"{of.name}Rule", rule))
        assert action.isChecked()
        assert rule.tip in action.toolTip()
        assert editor.session.undo_stack.undoText() == f"Choose {of.name} rule “{rule.label}”", place
    editor.choose_family("lagrange")
    assert not action.isEnabled()
    assert not action.isChecked()
