"""Progress of long work, and a button to take it back."""

from __future__ import annotations

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from ...qt.labels import Label
from ...widgets.boxes import row_of
from ...widgets.controls import ThinProgress, tool_button


class JobBar(QWidget):
    """A line with a word, a bar and a button; it shows what it is told."""

    def __init__(self, cancel: QAction) -> None:
        super().__init__()
        self.setObjectName("jobBar")
        self._word = Label(name="jobWord")
        self.bar = ThinProgress("jobProgress", "How far it has come")
        words = cancel.text(), cancel.toolTip()
        self.button = tool_button("cancelJobButton", *words, text="Stop", icon_size=14, flat=True)
        self.button.clicked.connect(cancel.trigger)
        self._cancel = cancel
        # No higher than the labels beside it: the drawing must not move when the line appears.
        self.button.setFixedHeight(self.fontMetrics().height() + 4)
        row_of(self._word, self.bar, self.button, margins=(6, 0, 6, 0), spacing=8, parent=self)
        self.hide()

    @property
    def text(self) -> str:
        """Words about the work."""
        return self._word.text()

    def begin(self, title: str) -> None:
        """Show the line with a bar that is empty."""
        self._word.setText(title)
        self.bar.setValue(0)
        self.button.setIcon(self._cancel.icon())  # tinted for the theme of the moment
        self.show()
