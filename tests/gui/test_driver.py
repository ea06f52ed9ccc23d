"""The test driver does what a person can do, and says why not where there is no such thing."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtWidgets import QLabel, QMessageBox

from app.testing import ImpossibleError


def impossible(reason):
    return pytest.raises(ImpossibleError, match=reason)


def test_what_no_person_can_do_is_refused_with_the_reason(editor):
    session, canvas = editor.session, editor.window.canvas
    before = session.document
    with impossible(r"'undo' \(.*\) is disabled"):
        editor.trigger("undo")
    with impossible("is disabled"):
        editor.trigger("redo")
    x_min, y_min, x_max, _ = canvas.pixel_map.box
    outside = (x_max + 0.5 * (x_max - x_min), y_min)
    for gesture in (
        lambda: editor.click(outside),
        lambda: editor.hover(outside),
        lambda: editor.drag(outside, editor.point(0)),
        lambda: editor.wheel(outside, 1),
        lambda: editor.open_menu(outside),
    ):
        with impossible("lies outside canvas"):
            gesture()
    # With the button held the mouse may leave the window.
    editor.drag(editor.point(1), outside)
    assert editor.point(1) == pytest.approx(outside, abs=2 * editor.pixel)
    editor.trigger("undo")
    assert session.document is before


def test_what_is_hidden_or_covered_cannot_be_reached(editor):
    label = QLabel("Over it", editor.window.canvas.viewport())
    label.setObjectName("overIt")
    label.setGeometry(200, 200, 50, 20)
    label.show()
    with impossible("lies overIt"):
        editor.click(editor.window.canvas.to_plane(QPoint(210, 210)))
    label.deleteLater()
    editor.trigger("toggleBasis")
    for gesture in (
        lambda: editor.drag_parameter(1, 0.3),
        lambda: editor.rail.click(1),
        lambda: editor.rail.type(1, "0.3"),
        lambda: editor.scrub(0.5),
    ):
        with impossible("is not shown"):
            gesture()
    with impossible("is not shown"):
        editor.type_text(editor.window.central["plotPanel"], "x")
    editor.window.canvas.setEnabled(False)
    with impossible("is disabled"):
        editor.key(Qt.Key.Key_A)
    editor.window.canvas.setEnabled(True)


def test_nothing_is_reached_under_a_dialog_that_waits(editor):
    box = QMessageBox(editor.window)
    box.setObjectName("question")
    box.open()
    editor.settle()
    for gesture in (
        lambda: editor.trigger("selectAll"),
        lambda: editor.click(editor.point(0)),
        lambda: editor.key(Qt.Key.Key_A),
        lambda: editor.drag_parameter(1, 0.3),
        lambda: editor.wheel((1.0, 1.0), 1),
        lambda: editor.choose_parametrization("uniform"),
        lambda: editor.send(editor.window.canvas, QEvent.Type.MouseButtonRelease, QPoint(9, 9), held=False),
    ):
        with impossible("waits for an answer"):
            gesture()
    box.close()
    editor.trigger("selectAll")
    assert len(editor.session.selection) == len(editor.curve.points)
