"""Labels whose text changes during a drag.

Why not a ``QLabel`` as it is: whatever text it is given, it has the whole window laid out anew, which costs a
drag more than drawing the curve.
"""

from __future__ import annotations

import math

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QSizePolicy

from ..qt.labels import INK, Label, set_tip, tip_of
from ..qt.overrides import SafeOverrides

_STEP = 16
"""Pixels by which a label grows, so that one digit more or less moves nothing."""

_SPARE = 3 * _STEP
"""Pixels of unused room that a label keeps."""


class SteadyLabel(SafeOverrides, Label):
    """A line of plain text that changes its size hint only when it must.

    Attributes
    ----------
    colour
        Colour of the text; None for the usual one. To be set before the text.
    """

    def __init__(self, name: str = "", label: str = "", role: QPalette.ColorRole = INK) -> None:
        super().__init__(name=name, label=label, role=role)
        self.colour: QColor | None = None
        self._text = ""
        self._room = 0

    def text(self) -> str:
        """Return the whole text."""
        return self._text

    def setText(self, text: str) -> None:  # noqa: N802
        """Show `text`."""
        if text == self._text:
            return
        self._text = text
        # QLabel's own text is empty: screen readers read the description.
        self.setAccessibleDescription(text)
        self._measure()
        self.update()

    def _measure(self) -> None:
        # Not rounded to whole pixels: a third of a pixel too few would cost a word of the text.
        needed = math.ceil(QFontMetricsF(self.font(), self).horizontalAdvance(self._text))
        if self._text and self._room - _SPARE <= needed <= self._room:
            return
        self._room = _STEP * math.ceil(needed / _STEP)
        if self.sizePolicy().horizontalPolicy() != QSizePolicy.Policy.Ignored:
            self.updateGeometry()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in (QEvent.Type.FontChange, QEvent.Type.StyleChange):
            self._room = 0
            self._measure()

    def sizeHint(self) -> QSize:
        margins = self.contentsMargins()
        return QSize(
            self._room + margins.left() + margins.right(),
            self.fontMetrics().height() + margins.top() + margins.bottom(),
        )

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        if self.colour is not None:
            painter.setPen(self.colour)
        room = self.contentsRect()
        elided = self.fontMetrics().elidedText(self._text, Qt.TextElideMode.ElideRight, room.width())
        painter.drawText(room, int(self.alignment() | Qt.AlignmentFlag.AlignVCenter), elided)
        painter.end()


class ElidedLabel(SteadyLabel):
    """A label that elides its text where there is too little room, and has all of it as tooltip."""

    def __init__(self, name: str = "", label: str = "", role: QPalette.ColorRole = INK) -> None:
        super().__init__(name, label, role)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)

    def minimumSizeHint(self) -> QSize:
        return QSize(0, super().minimumSizeHint().height())

    def setText(self, text: str) -> None:  # noqa: N802
        """Show `text`."""
        super().setText(text)
        set_tip(self, tip_of(text))
