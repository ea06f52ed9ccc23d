"""Shift, Ctrl, Alt and E pressed or let go in mid-drag, the mouse at rest: what is shown is what is kept."""

from __future__ import annotations

from itertools import product

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenuBar

from app.document import rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import HERMITE
from app.features.reference_image.commands import ImageCommands
from app.tools.pointer import Part
from tests.gui.editor_facts import picture

Key = Qt.Key
FLAGS = {
    Key.Key_Shift: Qt.KeyboardModifier.ShiftModifier,
    Key.Key_Control: Qt.KeyboardModifier.ControlModifier,
    Key.Key_Alt: Qt.KeyboardModifier.AltModifier,
}
POINTS = ((0.0, 0.0), (1.03, 2.04), (3.07, 2.11), (4.0, 0.0))


@pytest.fixture
def arch(editor):
    """Four points of an arch, snapping to the grid."""
    document = Document((make_curve(POINTS, family=HERMITE),))
    document = rule_edits.set_parametrization(document, 0, ParametrizationKind.UNIFORM, [])
    editor.session.commit(document, "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.trigger("toggleSnap")
    return editor


def hold(editor, key):
    QTest.keyPress(editor.window.canvas, key)
    editor.settle()


def let_go(editor, key):
    QTest.keyRelease(editor.window.canvas, key, FLAGS[key])
    editor.settle()


def gesture_state(editor):
    """Everything a gesture shows: the document, what is selected, what lies over the drawing, the words."""
    session, canvas = editor.session, editor.window.canvas
    return session.document, session.selection, canvas.marks, editor.window.status_line.text


def begin(editor, what):
    """Begin a drag that a key changes; return where the mouse rests."""
    if what == "point":
        start, to = editor.point(1), (2.03, 2.96)
    elif what == "handle":
        editor.select([1])
        start, to = editor.handle(ahead=True).position, (1.97, 3.2)
    elif what == "curve":
        start = tuple(editor.session.active_view.curve.evaluate(0.4).tolist())
        to = (start[0] + 0.4, start[1] + 0.9)
    elif what == "grip":
        editor.select([1, 2])
        editor.hover((0, 4))
        start, to = editor.grip(1, 1), (4.3, 4.4)
    elif what == "band":
        editor.select([0])
        start, to = (0.4, 3.2), (3.6, 1.2)
    elif what == "measure":
        editor.trigger("measureTool")
        start, to = (-1.3, 3.4), (0.04, 4.04)
    elif what == "pen":
        editor.trigger("familyLagrange")
        editor.trigger("addTool")
        start, to = (5.3, 1.3), (5.53, 2.04)
    else:
        editor.trigger("addTool")
        start, to = (5.53, 1.04), (5.9, 2.2)
    editor.press(start)
    editor.move(to)
    return to


DRAGS = [
    ("point", Key.Key_Shift),
    ("point", Key.Key_Control),
    ("handle", Key.Key_Shift),
    ("handle", Key.Key_Alt),
    ("handle", Key.Key_Control),
    ("curve", Key.Key_Alt),
    ("curve", Key.Key_Control),
    ("grip", Key.Key_Shift),
    ("grip", Key.Key_Control),
    ("band", Key.Key_Shift),
    ("measure", Key.Key_Control),
    ("pen", Key.Key_Control),
    ("pen with velocity", Key.Key_Control),
]


def test_a_key_pressed_or_released_counts_at_once_and_the_release_commits_the_preview(arch):
    document = arch.session.document
    for what, key in DRAGS:
        to = begin(arch, what)
        free = gesture_state(arch)
        hold(arch, key)
        changed = gesture_state(arch)
        assert changed != free, (what, key)
        arch.move(to, keys=FLAGS[key])
        assert gesture_state(arch) == changed, (what, key)
        let_go(arch, key)
        assert gesture_state(arch) == free, (what, key)
        hold(arch, key)
        arch.release(to, keys=FLAGS[key])
        assert gesture_state(arch)[:2] == changed[:2], (what, key)
        assert arch.window.canvas.marks.ruler == changed[2].ruler, (what, key)
        let_go(arch, key)
        arch.session.commit(document, "Again")
        arch.trigger("selectTool")
        arch.select([])


def test_a_key_released_just_before_the_button_has_no_effect_on_the_drag(arch):
    document = arch.session.document
    for what, key in DRAGS[::5]:
        to = begin(arch, what)
        free = gesture_state(arch)
        hold(arch, key)
        let_go(arch, key)
        arch.release(to)
        assert gesture_state(arch)[:2] == free[:2], (what, key)
        arch.session.commit(document, "Again")
        arch.trigger("selectTool")
        arch.select([])


def test_escape_cancels_a_drag_while_a_key_is_held(arch):
    document = arch.session.document
    for what, key in dict(DRAGS).items():
        begin(arch, what)
        before = arch.session.committed
        hold(arch, key)
        QTest.keyClick(arch.window.canvas, Key.Key_Escape)
        arch.settle()
        assert arch.session.document is before, (what, key)
        assert what == "measure" or arch.status == "Cancelled.", (what, key)
        let_go(arch, key)
        assert arch.session.document is before, (what, key)
        assert what != "band" or arch.session.selection == {0}, (what, key)
        assert arch.window.canvas.marks.band is arch.window.canvas.marks.ruler is None, (what, key)
        arch.release((0.0, 4.0))
        arch.session.commit(document, "Again")
        arch.trigger("selectTool")
        arch.select([])


TRANSFORMS = [(Key.Key_G, Key.Key_Shift), (Key.Key_G, Key.Key_Control), (Key.Key_R, Key.Key_Shift)]


def test_a_transform_by_keys_hears_modifier_keys(arch):
    document = arch.session.document
    for (key, held), end in product(TRANSFORMS, (Key.Key_Return, Key.Key_Escape)):
        arch.select([1, 2])
        before = arch.session.document
        arch.hover((0, 3))
        arch.key(key)
        arch.move((0.52, 3.94), held=False)
        free = gesture_state(arch)
        hold(arch, held)
        changed = gesture_state(arch)
        assert changed[0] != free[0], (key, held, end)
        arch.move((0.52, 3.94), held=False, keys=FLAGS[held])
        assert gesture_state(arch) == changed, (key, held, end)
        let_go(arch, held)
        assert gesture_state(arch) == free, (key, held, end)
        hold(arch, held)
        arch.key(end)
        assert arch.session.document == (changed[0] if end == Key.Key_Return else before), (key, held, end)
        let_go(arch, held)
        assert arch.session.document == (changed[0] if end == Key.Key_Return else before), (key, held, end)
        arch.session.commit(document, "Again")


def test_a_transform_begun_with_the_pointer_outside_reacts_to_modifier_keys(arch):
    arch.select([1, 2])
    arch.trigger("moveSelection")
    assert arch.window.canvas.marks.snap is not None
    arch.key(Key.Key_Percent)
    assert arch.window.canvas.marks.snap is None
    arch.key(Key.Key_Percent)
    arch.escape()


def test_the_picture_keeps_to_an_axis_at_once(arch, tmp_path):
    arch.window.commands[ImageCommands].trace(picture(tmp_path / "red.png"))
    arch.trigger("moveImage")
    assert Part.IMAGE in arch.window.canvas.tools.tool.hits
    before = arch.session.document.image
    middle = (before.x + before.width / 2, before.y + before.height / 2)
    to = (middle[0] + 1.0, middle[1] + 0.4)
    arch.press(middle)
    arch.move(to)
    assert arch.session.document.image.y != before.y
    hold(arch, Key.Key_Shift)
    kept = arch.session.document.image
    assert (kept.y, kept.x) == (before.y, pytest.approx(before.x + 1.0, abs=2 * arch.pixel))
    arch.release(to, keys=FLAGS[Key.Key_Shift])
    assert arch.session.document.image == kept


# The t-rail


def begin_on_rail(editor):
    panel = editor.window.basis_panel
    start = panel.rail_pixel(editor.parameters[1])
    to = start + QPointF(20, 0)
    editor.send(panel, QEvent.Type.MouseMove, start, held=False)
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    editor.send(panel, QEvent.Type.MouseMove, to)
    editor.settle()
    return panel, to


@pytest.mark.parametrize("keeps", [True, False])
def test_holding_e_moves_the_ticks_at_once(arch, keeps):
    before = arch.session.document
    panel, to = begin_on_rail(arch)
    alone = arch.parameters
    QTest.keyPress(panel, Key.Key_E)
    together = arch.parameters
    assert together[2] > alone[2]
    assert "ticks by" in arch.status
    QTest.keyRelease(panel, Key.Key_E)
    assert arch.parameters == alone
    QTest.keyPress(panel, Key.Key_E)
    if not keeps:
        QTest.keyClick(panel, Key.Key_Escape)
    arch.send(panel, QEvent.Type.MouseButtonRelease, to, held=False)
    arch.settle()
    assert arch.parameters == together if keeps else arch.session.document is before
    QTest.keyRelease(panel, Key.Key_E)


def test_releasing_e_in_another_window_ends_its_effect(arch):
    panel, to = begin_on_rail(arch)
    alone = arch.parameters
    QTest.keyPress(panel, Key.Key_E)
    assert arch.parameters != alone
    arch.window.point_table.setFocus()
    assert arch.parameters == alone
    arch.send(panel, QEvent.Type.MouseButtonRelease, to, held=False)
    assert arch.parameters == alone


# No drag in flight


def test_at_rest_nothing_changes_but_the_hint(arch):
    arch.trigger("addTool")
    arch.hover(tuple(arch.session.active_view.curve.evaluate(0.4).tolist()))
    before, seen = arch.session.document, []
    arch.session.document_changed.connect(seen.append)
    assert arch.window.status_line.hint.startswith("Click to insert a point here")
    hold(arch, Key.Key_Shift)
    assert arch.window.status_line.hint.startswith("Click to add point 4")
    let_go(arch, Key.Key_Shift)
    assert arch.window.status_line.hint.startswith("Click to insert a point here")
    assert (arch.session.document, seen) == (before, [])


def test_after_escape_a_key_does_not_bring_the_drag_back(arch):
    begin(arch, "point")
    before = arch.session.committed
    arch.escape()
    hold(arch, Key.Key_Shift)
    assert arch.session.document is before
    assert arch.status == "Cancelled."


def test_alt_alone_in_mid_drag_leaves_the_keys_to_the_canvas(arch):
    begin(arch, "handle")
    QTest.keyClick(arch.window.canvas, Key.Key_Alt)
    arch.settle()
    assert arch.window.canvas.hasFocus()
    assert arch.window.findChild(QMenuBar).activeAction() is None
    before = arch.session.committed
    QTest.keyClick(arch.window.canvas, Key.Key_Escape)
    assert arch.session.document is before
