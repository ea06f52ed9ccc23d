"""What keys and mouse do, as a sheet beside the window."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QLabel, QScrollArea, QVBoxLayout, QWidget

_MOUSE = (
    ("Drag a point", "move it; Shift keeps to one axis, Escape cancels"),
    ("Alt+drag a point", "pull out its velocity handle"),
    ("Drag a handle", "set velocity (square) or acceleration (diamond)"),
    ("Click a curve, adding", "insert a point between its neighbours"),
    ("Press and drag, adding", "add a point and set its velocity"),
    ("Drag a tick of the t-rail", "change t; the parameters become manual"),
    ("Drag in the basis panel", "scrub: every point shows its weight at t"),
    ("Wheel", "zoom at the pointer"),
    ("Middle button, Space+drag", "pan"),
    ("Click another curve", "edit it"),
    ("Right button, Menu key", "what can be done there"),
)


class ShortcutSheet(QDialog):
    """Lists the shortcuts of the moment and the gestures; not modal."""

    def __init__(self, shortcuts: Sequence[tuple[str, str]], parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Tool)
        self.setObjectName("shortcutSheet")
        self.setWindowTitle("Keys and mouse")
        text = QLabel(_table("Mouse", _MOUSE) + _table("Keys", shortcuts))
        text.setTextFormat(Qt.TextFormat.RichText)
        text.setAlignment(Qt.AlignmentFlag.AlignTop)
        text.setMargin(14)
        area = QScrollArea()
        area.setWidget(text)
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(area)
        self.resize(460, 620)


def _table(title: str, rows: Sequence[tuple[str, str]]) -> str:
    cells = "".join(
        f"<tr><td style='padding-right: 18px'><b>{escape(key)}</b></td><td>{escape(what)}</td></tr>"
        for key, what in rows
    )
    return f"<h3>{title}</h3><table cellpadding='2'>{cells}</table>"
