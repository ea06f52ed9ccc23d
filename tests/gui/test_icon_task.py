"""An icon of another program recoloured, aligned and copied by keys and clicks, and how many it takes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from extents import sampled_bounds
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialog, QMessageBox, QToolButton

from app.exchange.svg.reader import read_svg
from app.features.import_export.commands import ImportCommands
from app.workbench.document_files import DocumentFiles

ICON = Path(__file__).parents[1] / "data" / "svg" / "lucide_leaf.svg"

IN_INKSCAPE = 7
"""Of the same by the manual of Inkscape 1.3, from the file dialog of Import on, a key with modifiers as one.

OK of the import; Shift and a click on a colour of the palette; Ctrl+Shift+A, the choice what to align to, and
the button in the dialog; Ctrl+C; Ctrl+V in the other window.
"""


OTHER = '<svg xmlns="http://www.w3.org/2000/svg" width="48" height="48"><path d="M1 1H40V40Z"/></svg>'


@pytest.mark.usefixtures("drawings_read_here")
def test_an_icon_is_recoloured_aligned_and_pasted_into_another_svg(editor, tmp_path, monkeypatch):
    editor.session.new()
    editor.settle()
    editor.show_dock("styleDock")
    editor.window.commands[ImportCommands].import_files([ICON])
    editor.wait_for_work()
    dialog = editor.window.findChild(QDialog, "importDrawingDialog")
    QTest.keyClick(dialog, Qt.Key.Key_Return)
    editor.settle()
    # Without a window manager nobody gives the keyboard back.
    editor.window.activateWindow()
    assert QTest.qWaitForWindowActive(editor.window)
    session = editor.session
    editor.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    steps = ["Return", "Ctrl+A"]
    assert session.selected.curves == frozenset(range(4))
    swatch = editor.window.findChild(QToolButton, "strokePaint_Vermillion")
    QTest.mouseClick(swatch, Qt.MouseButton.LeftButton)
    editor.settle()
    assert {curve.style.stroke for curve in session.document.curves} == {"#d55e00"}
    assert {curve.style.width for curve in session.document.curves} == {2.0}
    editor.key(Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    align = editor.window.findChild(QToolButton, "alignCentreButton")
    QTest.mouseClick(align, Qt.MouseButton.LeftButton)
    editor.settle()
    steps += ["a click on a colour", "Ctrl+Shift+M", "a click on Centre"]
    middles = [np.mean(sampled_bounds(editor, place), axis=0)[0] for place in range(4)]
    assert middles == pytest.approx([middles[0]] * 4, abs=1e-6)
    # The key led to the field of the width, which has nothing selected any more.
    field = editor.window.focusWidget()
    assert field.objectName() == "transformWidth"
    QTest.keyClick(field, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    editor.wait_for_work()
    steps += ["Ctrl+C", "Ctrl+V there"]
    assert len(steps) <= IN_INKSCAPE
    check_copied()
    monkeypatch.setattr(DocumentFiles, "_ask_about_changes", lambda _: QMessageBox.StandardButton.Discard)
    path = tmp_path / "other.svg"
    path.write_text(OTHER, encoding="utf-8")
    editor.window.context.files.open(path)
    editor.wait_for_work()
    assert editor.window.findChild(QDialog, "importDrawingDialog") is None
    editor.settle()
    editor.window.activateWindow()
    assert QTest.qWaitForWindowActive(editor.window)
    editor.window.canvas.setFocus()
    for letter in (Qt.Key.Key_V, Qt.Key.Key_S):
        editor.key(letter, Qt.KeyboardModifier.ControlModifier)
        editor.wait_for_work()
    saved = read_svg(path.read_bytes()).document
    assert [curve.style.stroke for curve in saved.curves] == ["none", *["#d55e00"] * 4]
    assert '<path d="M1 1H40V40Z"/>' in path.read_text(encoding="utf-8")


def check_copied():
    """The four curves are on the clipboard, in their new colour."""
    data = QGuiApplication.clipboard().mimeData()
    copied = read_svg(bytes(data.data("image/svg+xml").data())).document
    assert [(curve.style.stroke, curve.style.width) for curve in copied.curves] == [("#d55e00", 2.0)] * 4
