"""The zoom in the status line: a field to type it into, and a button with a menu of what is usual."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from ...widgets.boxes import row_of
from ...widgets.controls import named
from ...widgets.field_edit import NumberEdit
from ...widgets.tool_buttons import tool_button
from .zoom import per_cent_text, read_zoom

_SOON_MS = 33
"""Milliseconds after which a zoom is written: a wheel is quicker than an eye."""

_PADDING = 4
_WIDEST = "88888888 %"


class ZoomField(QWidget):
    """Shows the zoom, and takes another one.

    Signals
    -------
    zoom_entered
        Another zoom was typed, 1.0 for 100 %.
    refused
        Why what was typed is no zoom.
    """

    zoom_entered = Signal(float)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("zoomReadout")
        self._share, self._about = 1.0, ""
        self.edit = NumberEdit("zoomField", "Zoom", "Zoom", read_zoom)
        self.edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.edit.setFrame(False)
        self.edit.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.edit.entered.connect(self._enter)
        self.edit.refused.connect(self.refused)
        self._choices = tool_button("zoomChoices", "Choose a zoom", "Choose a zoom", flat=True)
        self._choices.setArrowType(Qt.ArrowType.UpArrow)
        self._choices.clicked.connect(self._open_menu)
        self._menu = named(QMenu(self._choices), "zoomMenu")
        # No taller than the words beside it: the status line would grow.
        for part in (self.edit, self._choices):
            part.setMaximumHeight(self.fontMetrics().height() + _PADDING)
        row_of(self.edit, self._choices, margins=0, spacing=0, parent=self)
        self._soon = QTimer(self, singleShot=True, interval=_SOON_MS)
        self._soon.timeout.connect(self._write)

    def offer(self, groups: Sequence[Sequence[QAction]]) -> None:
        """Offer actions in the menu, in groups."""
        for place, group in enumerate(groups):
            if place:
                self._menu.addSeparator()
            self._menu.addActions(list(group))

    def _open_menu(self) -> None:
        # By hand: a menu of the button's own has the style draw a second arrow.
        self._menu.popup(self.mapToGlobal(QPoint(0, -self._menu.sizeHint().height())))

    def show_zoom(self, share: float, about: str) -> None:
        """Show a zoom soon, and in the tip what 100 % means."""
        if share != self._share or about != self._about:
            self._share, self._about = share, about
            if not self._soon.isActive():
                self._soon.start()

    def _write(self) -> None:
        self._soon.stop()
        edit, text = self.edit, per_cent_text(self._share)
        edit.show_text(text)
        edit.setToolTip(f"Zoom: type one, such as 250 %. {self._about}")
        width = max(edit.fontMetrics().horizontalAdvance(each) for each in (text, _WIDEST)) + 14
        if width != edit.width():
            edit.setFixedWidth(width)

    def _enter(self, share: float) -> None:
        self.zoom_entered.emit(share)
        # Also where nothing has changed: what was typed is written as the others are.
        self._write()
