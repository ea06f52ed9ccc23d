"""A popup in which a colour is chosen, seen at once where it is used."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QCloseEvent, QColor, QKeyEvent
from PySide6.QtWidgets import QColorDialog, QFrame, QPushButton, QWidget

from ..qt.overrides import ENTER, SafeOverrides
from .boxes import column_of
from .controls import named

_OPTIONS = (
    QColorDialog.ColorDialogOption.DontUseNativeDialog,
    QColorDialog.ColorDialogOption.NoButtons,
    # It takes the mouse, which is the popup's.
    QColorDialog.ColorDialogOption.NoEyeDropperButton,
)


class ColourPopup(SafeOverrides, QFrame):
    """Qt's choice of colours without a dialog around it: Enter or a click elsewhere takes the colour.

    Signals
    -------
    colour_changed
        Another colour is looked at, "#rrggbb".
    chosen
        It is closed with another colour than it began with.
    cancelled
        It is closed with Escape, or with the colour that it began with.
    """

    colour_changed = Signal(str)
    chosen = Signal(str)
    cancelled = Signal()

    def __init__(self, name: str, colour: str, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        named(self, name, "Choice of a colour")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self._began_with, self._is_cancelled = QColor(colour).name(), False
        self._choice = QColorDialog(QColor(colour))
        self._choice.setWindowFlags(Qt.WindowType.Widget)
        for option in _OPTIONS:
            self._choice.setOption(option)
        for button in self._choice.findChildren(QPushButton):
            button.setAutoDefault(False)
        column_of(self._choice, margins=2, parent=self)
        self._choice.currentColorChanged.connect(lambda now: self.colour_changed.emit(now.name()))
        self._choice.rejected.connect(self.cancel)
        self._choice.show()

    @property
    def colour(self) -> str:
        """The colour that is looked at, "#rrggbb"."""
        return self._choice.currentColor().name()

    def open_below(self, widget: QWidget) -> None:
        """Open it below a widget, or wherever it fits on the screen."""
        self.open_at(widget.mapToGlobal(QPoint(0, widget.height())))

    def open_at(self, place: QPoint) -> None:
        """Open it at a place of the screen, or where it fits beside that."""
        self.adjustSize()
        room = self.screen().availableGeometry()
        x = max(room.left(), min(place.x(), room.right() - self.width()))
        y = max(room.top(), min(place.y(), room.bottom() - self.height()))
        self.move(x, y)
        self.show()
        self._choice.setFocus()

    def cancel(self) -> None:
        """Close it, and nothing was chosen."""
        self._is_cancelled = True
        self.close()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in ENTER:
            self.close()
        elif event.key() == Qt.Key.Key_Escape:
            self.cancel()
        else:
            super().keyPressEvent(event)

    def closeEvent(self, event: QCloseEvent) -> None:
        super().closeEvent(event)
        if self._is_cancelled or self.colour == self._began_with:
            self.cancelled.emit()
        else:
            self.chosen.emit(self.colour)
