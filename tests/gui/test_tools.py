"""A tool is one file: shown by one that only these tests have."""

from __future__ import annotations

import re
import textwrap
from types import ModuleType

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QComboBox, QLabel, QMenu, QSpinBox, QWidget

from app.document import point_edits, rule_edits
from app.document.limits import EditError
from app.document.model import Point
from app.document.words import NamedEnum
from app.testing import Editor
from app.tools import canvas as canvas_tools
from app.tools import tool
from app.tools.canvas.select import SELECT
from app.tools.marks import Marks, Ruler
from app.tools.pointer import Cursor, Hint
from app.tools.tool import TOOLS, Drag, Gesture, GestureRow, Tool, ToolRecord
from app.view_model.settings import ChoiceSetting, SwitchSetting
from app.view_model.settings import Count as WholeCount
from app.window.preferences_dialog import PreferencesDialog
from tests.gui.editor_facts import transform

HINT = "Drag to put a point above where you pressed"


class Count(NamedEnum):
    """How many points are put above the press."""

    ONE = "one", "One point"
    TWO = "two", "Two points"


class Place(NamedEnum):
    """More choices than a menu has room for."""

    A, B, C, D, E, F, G, H, I = ((letter, f"Place {letter}") for letter in "abcdefghi")  # noqa: E741


COUNT = ChoiceSetting("raiseBox", "Raise", Count.ONE, "Points above the press", "raise/count")
LOUD = SwitchSetting("raiseLoud", "Say where", True, tip="Say where the point is")
STEPS = WholeCount("raiseSteps", "Steps", 3, limits=(1, 12))
PLACE = ChoiceSetting("raisePlace", "Place", Place.B)


class Raise(Drag, kw_only=True):
    """A drag that appends a point to the curve, straight above the press."""

    curve: int
    foot: tuple[float, float]

    keys = "No keys"

    def head(self, pointer):
        return (self.foot[0], pointer.position[1])

    def undo_text(self, pointer):
        return "Raise point"

    def amount(self, pointer):
        return f"Raised to {pointer.position[1]:.1f}"

    def document_at(self, pointer):
        if pointer.position[1] < 0:
            raise EditError("The point cannot be below zero.")
        count = len(self.document.curves[self.curve].points)
        return point_edits.insert_points(self.document, self.curve, count, [Point(*self.head(pointer))])

    def marks(self, event):
        return Marks(ruler=Ruler(self.foot, self.head(event.pointer), "up"))


class RaiseTool(Tool):
    """Puts a point straight above the press."""

    cursor = Cursor.HIGHER

    def press(self, event):
        session = event.session
        return Raise(document=session.document, curve=session.active_index, foot=event.pointer.position)

    def hover(self, event):
        return Hint(HINT)


RAISE = ToolRecord(
    name="raise",
    make=RaiseTool,
    hint="Drag upwards.",
    doing="raising points",
    gestures=(GestureRow("Drag upwards", "put a point above"),),
    action="raiseTool",
    title="Raise Points",
    key="Ctrl+Alt+F8",
    icon="move",
    tip="Put points above others",
    settings=(COUNT, LOUD, STEPS, PLACE),
)
FOOT, HEAD = (2.0, 1.0), (2.5, 3.0)


@pytest.fixture
def raising(qtbot):
    """A window with the tool, chosen by its key."""
    with TOOLS.with_record(RAISE):
        editor = Editor(qtbot)
    editor.window.activateWindow()
    editor.settle()
    held = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier
    editor.key(Qt.Key.Key_F8, held)
    return editor


def ink(editor):
    """How much of the ruler's colour there is beside its foot."""
    canvas = editor.window.canvas
    picture, place = canvas.grab().toImage(), canvas.viewport().mapTo(canvas, canvas.to_pixel(2.0, 2.0))
    accent = canvas.layers.theme.accent
    near = (picture.pixelColor(place.x() + dx, place.y()) for dx in range(-3, 4))
    return min(abs(each.red() - accent.red()) + abs(each.blue() - accent.blue()) for each in near)


def test_a_tool_is_in_the_menu_and_the_palette_and_has_a_key(raising):
    assert raising.action("raiseTool").isChecked()
    assert raising.window.findChild(QLabel, "hint").text() == RAISE.hint
    assert raising.find_command("raise po")[0] == "Raise Points"
    menus = raising.window.menuBar().findChildren(QMenu)
    tools = next(menu for menu in menus if menu.title().replace("&", "") == "Tools")
    assert raising.action("raiseTool") in tools.actions()


def test_the_sheet_of_keys_and_mouse_begins_with_the_tool_in_use(raising):
    raising.trigger("showShortcuts")
    sheet = raising.window.findChild(QWidget, "shortcutSheet")
    words = [label.text() for label in sheet.findChildren(QLabel)]
    assert words[1:4] == ["<b>Now: raising points</b>", "Drag upwards", "put a point above"]
    assert words.index("return to Select") < words.index("<b>Otherwise</b>")
    assert any("select both ends" in each for each in words[words.index("<b>Otherwise</b>") :])


def test_hint_and_cursor_of_a_tool_are_displayed(raising):
    raising.hover(HEAD)
    assert raising.window.findChild(QLabel, "hint").text() == HINT
    assert raising.window.canvas.viewport().cursor().shape() == Qt.CursorShape.SizeVerCursor


def test_a_drag_is_one_step_and_its_marks_are_drawn(raising):
    session, canvas = raising.session, raising.window.canvas
    before, steps = session.document, session.undo_stack.count()
    raising.press(FOOT)
    for height in (1.5, 2.0, 3.0):
        raising.move((2.5, height))
    assert raising.status.startswith("Raised to 3.0 · No keys")
    assert canvas.marks.ruler.text == "up"
    assert ink(raising) < 60
    raising.release(HEAD)
    assert raising.point(-1) == pytest.approx((FOOT[0], HEAD[1]), abs=raising.pixel)
    assert session.undo_stack.count() == steps + 1
    assert session.undo_stack.undoText() == "Raise point"
    assert canvas.marks == Marks()
    raising.trigger("undo")
    assert session.document == before


def test_a_drag_whose_last_move_is_refused_ends_with_the_last_good_document_and_the_reason(raising):
    steps = raising.session.undo_stack.count()
    raising.press(FOOT)
    raising.move(HEAD)
    raising.move((2.5, -0.5))
    assert raising.status == "The point cannot be below zero."
    raising.release((2.5, -0.5))
    assert raising.session.undo_stack.count() == steps + 1
    assert raising.point(-1) == pytest.approx((FOOT[0], HEAD[1]), abs=raising.pixel)
    assert raising.status == "The point cannot be below zero."


@pytest.mark.parametrize("way_out", ["escape", "right button"])
def test_a_drag_of_a_tool_can_be_cancelled(raising, way_out):
    session, canvas = raising.session, raising.window.canvas
    before, steps = session.document, session.undo_stack.count()
    raising.press(FOOT)
    raising.move(HEAD)
    assert session.document != before
    if way_out == "escape":
        raising.escape()
    else:
        pixel = canvas.to_pixel(*HEAD)
        raising.send(canvas, QEvent.Type.MouseButtonPress, pixel, button=Qt.MouseButton.RightButton)
    raising.release(HEAD)
    assert (session.document, session.undo_stack.count()) == (before, steps)
    assert canvas.marks == Marks()


def test_transforms_and_arrows_work_with_any_tool_and_escape_returns_to_select(raising):
    canvas, session = raising.window.canvas, raising.session
    raising.select([1])
    x, y = raising.point(1)
    raising.key(Qt.Key.Key_Right)
    nudged = raising.point(1)[0]
    assert x < nudged < x + 6 * raising.pixel
    transform(raising, "G", "2")
    assert raising.point(1) == pytest.approx((nudged + 2, y), rel=1e-12)
    assert canvas.tools.record is RAISE
    raising.escape()
    assert canvas.tools.record is SELECT
    assert session.selection == {1}


def test_a_setting_of_a_tool_has_an_action_a_field_in_the_preferences_and_is_remembered(raising):
    with TOOLS.with_record(RAISE):
        window = raising.window
        event = window.canvas.tools.event
        assert (event.value(COUNT), event.value(LOUD)) == (Count.ONE, True)
        assert raising.action("raiseOne").isChecked()
        raising.trigger("raiseTwo")
        assert window.canvas.tools.event.value(COUNT) is Count.TWO
        assert raising.status == "Raise Points: Two points."
        assert raising.action("raiseTwo").isChecked()
        QTest.keyClick(window.canvas, Qt.Key.Key_Comma, Qt.KeyboardModifier.ControlModifier)
        dialog = window.findChild(PreferencesDialog)
        assert dialog.findChild(QComboBox, "raiseBox").currentText() == "Two points"
        check = dialog.findChild(QCheckBox, "raiseLoud")
        assert check.isChecked()
        check.click()
        assert not window.canvas.tools.event.value(LOUD)
        assert not window.preferences.tool_settings.value(LOUD)
        assert window.preferences.file.text("raise/count") == "two"
        assert window.preferences.file.text("tools/raise/raiseLoud") == "off"
        dialog.hide()


def test_a_tool_can_have_a_whole_number_and_a_choice_that_is_too_long_for_a_menu(raising):
    with TOOLS.with_record(RAISE):
        window = raising.window
        event = window.canvas.tools.event
        assert (event.value(STEPS), event.value(PLACE)) == (3, Place.B)
        assert "raiseB" not in {action.objectName() for action in window.findChildren(QAction)}
        QTest.keyClick(window.canvas, Qt.Key.Key_Comma, Qt.KeyboardModifier.ControlModifier)
        dialog = window.findChild(PreferencesDialog)
        box = dialog.findChild(QSpinBox, "raiseSteps")
        assert (box.value(), box.minimum(), box.maximum(), box.toolTip()) == (3, 1, 12, "Steps")
        box.setFocus()
        box.selectAll()
        QTest.keyClicks(box, "1")
        assert window.canvas.tools.event.value(STEPS) == 3
        QTest.keyClicks(box, "2")
        QTest.keyClick(box, Qt.Key.Key_Return)
        assert window.canvas.tools.event.value(STEPS) == 12
        QTest.keyClick(box, Qt.Key.Key_Down)
        assert window.canvas.tools.event.value(STEPS) == 11
        assert window.preferences.file.text("tools/raise/raiseSteps") == "11"
        places = dialog.findChild(QComboBox, "raisePlace")
        places.setFocus()
        QTest.keyClick(places, Qt.Key.Key_Down)
        assert window.canvas.tools.event.value(PLACE) is Place.C
        window.preferences.file.write("tools/raise/raiseSteps", "13")
        assert window.preferences.tool_settings.value(STEPS) == 3
        assert "“13” is not a whole number from 1 to 12" in window.preferences.complaint
        dialog.hide()


def recipe():
    """The record of the recipe in the docstring of the tools, run as it is printed."""
    text = re.search(r"(    # app/tools/canvas/lift.py\n.*?)\n\n\S", tool.__doc__ or "", re.DOTALL)
    assert text is not None
    module = ModuleType("app.tools.canvas.lift")
    module.__package__ = canvas_tools.__name__
    exec(compile(textwrap.dedent(text[1]), "lift.py", "exec"), module.__dict__)
    return next(value for value in vars(module).values() if isinstance(value, ToolRecord))


@pytest.mark.parametrize("is_manual", [False, True])
def test_the_tool_of_the_recipe_puts_points_above_the_press(qtbot, is_manual):
    record = recipe()
    with TOOLS.with_record(record):
        editor = Editor(qtbot)
    session = editor.session
    if is_manual:
        t = session.active_view.parameters.tolist()
        session.commit(rule_edits.freeze_parameters(session.document, 0, t), "Freeze")
    editor.trigger(record.action)
    count, steps = len(editor.curve.points), session.undo_stack.count()
    editor.press(FOOT)
    editor.move(HEAD)
    assert re.fullmatch(r"Point at [12][.0-9]*, [23][.0-9]* · Escape cancels", editor.status)
    editor.release(HEAD)
    assert editor.point(-1) == pytest.approx((FOOT[0], HEAD[1]), abs=editor.pixel)
    assert (len(editor.curve.points), session.undo_stack.count()) == (count + 1, steps + 1)
    assert session.active_view.is_current
    editor.trigger("showShortcuts")
    words = [label.text() for label in editor.window.findChildren(QLabel)]
    assert f"<b>Now: {record.doing}</b>" in words


class StampTool(Tool):
    """Puts a point where it is clicked, through the one door: there is no drag."""

    def press(self, event):
        session, place = event.session, event.pointer.position

        def stamped(document):
            count = len(document.curves[session.active_index].points)
            return point_edits.insert_points(document, session.active_index, count, [Point(*place)])

        return Gesture(on_click=lambda _release: session.change("Stamp point", stamped))


def test_a_tool_that_only_clicks_does_nothing_when_dragged(raising):
    stamp = ToolRecord(name="stamp", make=StampTool, hint="Click.", doing="stamping")
    session, canvas = raising.session, raising.window.canvas
    canvas.choose_tool(stamp)
    count, steps = len(raising.curve.points), session.undo_stack.count()
    raising.press(FOOT)
    raising.move(HEAD)
    raising.release(HEAD)
    assert (len(raising.curve.points), session.undo_stack.count()) == (count, steps)
    raising.press(FOOT)
    raising.release(FOOT)
    assert raising.point(-1) == pytest.approx(FOOT, abs=raising.pixel)
    assert (len(raising.curve.points), session.undo_stack.undoText()) == (count + 1, "Stamp point")
    raising.trigger("selectTool")


def test_every_tool_has_the_text_of_its_action(editor):
    for record in TOOLS:
        action = editor.action(record.action)
        editor.trigger(record.action)
        assert editor.window.canvas.tools.record is record
        assert action.isChecked()
        assert action.text().replace("&", "") == record.title
        assert action.shortcut().toString() == record.key
        assert record.tip in action.toolTip()
        assert record.hint
        assert record.doing
        assert record.gestures
    editor.trigger(SELECT.action)


@pytest.mark.parametrize(("action", "name"), [("plotSpeed", "plotCanvas"), ("plotHodograph", "hodograph")])
def test_arrow_keys_on_a_plot_move_no_point(editor, action, name):
    """The plots have tools as the canvas has: those that move selected points are not among them."""
    editor.select([1])
    editor.trigger(action)
    before = editor.session.document
    plot = editor.window.findChild(QWidget, name)
    for key in (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Right):
        QTest.keyClick(plot, key)
    editor.settle()
    assert editor.session.document is before
