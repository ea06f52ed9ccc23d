"""Coincident points: the rules by distance offer the uniform rule."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES

TWICE = ((0.0, 0.0), (1.0, 2.0), (1.0, 2.0), (4.0, 0.0))


def button(editor):
    return editor.window.message_bar.findChild(QToolButton, "offeredAction")


def test_a_click_uses_uniform_parameters(editor):
    for family in FAMILIES:
        editor.session.commit(Document((make_curve(TWICE, family=family),)), "Begin")
        editor.settle()
        assert "1 and 2 coincide" in editor.message, family
        assert button(editor).isVisible(), family
        assert button(editor).text() == "Use Uniform Parameters", family
        QTest.mouseClick(button(editor), Qt.MouseButton.LeftButton)
        editor.settle()
        assert editor.curve.parametrization.kind is ParametrizationKind.UNIFORM, family
        assert editor.session.active_view.is_current, family
        assert editor.message == "", family
        assert editor.session.undo_stack.undoText() == "Use uniform parameters", family
        editor.trigger("undo")
        assert button(editor).isVisible(), family
        # The next one begins without a message.
        editor.trigger("redo")
        assert editor.message == "", family


def test_the_offered_rule_disappears_with_the_problem(editor):
    editor.session.commit(Document((make_curve(TWICE),)), "Begin")
    editor.settle()
    editor.drag_point(1, to=(2, 3))
    assert editor.message == ""
    editor.new()
    assert editor.message.startswith("Click on the canvas")
    assert not button(editor).isVisible()
