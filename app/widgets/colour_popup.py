"""A popup to choose a colour in, with a live preview."""

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
    # The eye dropper would grab the mouse from the popup.
    QColorDialog.ColorDialogOption.NoEyeDropperButton,
)


class ColourPopup(SafeOverrides, QFrame):
    """Qt's colour dialog as a popup: Enter or a click elsewhere chooses the colour.

    Signals
    -------
    colour_changed
        Another colour is previewed, "#rrggbb".
    chosen
        The popup was closed with another colour than the initial one.
    cancelled
        The popup was closed with Escape, or with the initial colour.
    """

    colour_changed = Signal(str)
    chosen = Signal(str)
    cancelled = Signal()

    def __init__(self, name: str, colour: str, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        named(self, name, "Choose a colour")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self._initial, self._is_cancelled = QColor(colour).name(), False
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
        """The previewed colour, "#rrggbb"."""
        return self._choice.currentColor().name()

    def open_at(self, position: QPoint) -> None:
        """Open the popup at a position of the screen, or as near as it fits."""
        self.adjustSize()
        room = self.screen().availableGeometry()
        x = max(room.left(), min(position.x(), room.right() - self.width()))
        y = max(room.top(), min(position.y(), room.bottom() - self.height()))
        self.move(x, y)
        self.show()
        self._choice.setFocus()

    def cancel(self) -> None:
        """Close the popup without choosing a colour."""
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
        if self._is_cancelled or self.colour == self._initial:
            self.cancelled.emit()
        else:
            self.chosen.emit(self.colour)
