"""The list of curves as tests see it."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.features.curve_list.commands import CurveListCommands
from app.features.curve_list.panel import CurveListView
from app.features.curve_list.rows import Spot, spot_rect
from app.testing import Editor


def view_of(editor: Editor) -> CurveListView:
    """Return the list."""
    return editor.window.commands[CurveListCommands].panel.view


def rows(editor: Editor) -> list[str]:
    """Return the texts of the rows from the top, each as deep as it is drawn."""
    model = view_of(editor).curves
    return ["  " * entry.node.depth + model.index(row).data() for row, entry in enumerate(model.entries)]


def heard(editor: Editor, place: int) -> str:
    """Return what a screen reader says of the row of a curve, or of what it is in while that is folded."""
    model = view_of(editor).curves
    return str(model.data(model.index(model.row_of(place)), Qt.ItemDataRole.AccessibleTextRole))


def open_row_menu(editor: Editor, row: int) -> None:
    """Open the menu of a row with the right button."""
    view = view_of(editor)
    port, place = view.viewport(), view.parts.entry_rect(row).center()
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, place, port.mapToGlobal(place))
    QApplication.sendEvent(port, event)
    editor.settle()


def row_named(editor: Editor, name: str) -> int:
    """Return the row of this name, however deep."""
    return [text.strip() for text in rows(editor)].index(name)


def place_in(editor: Editor, name: str, spot: Spot = Spot.NAME) -> QPoint:
    """Return the middle of a part of a row."""
    return spot_rect(view_of(editor).parts.entry_rect(row_named(editor, name)), spot).center()


def click_row(
    editor: Editor,
    name: str,
    keys: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier,
    spot: Spot = Spot.NAME,
) -> None:
    """Click a part of a row, with keys held."""
    place = place_in(editor, name, spot)
    QTest.mouseClick(view_of(editor).viewport(), Qt.MouseButton.LeftButton, keys, place)
    editor.settle()
