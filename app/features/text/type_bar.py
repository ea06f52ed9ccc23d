"""What is asked of texts that are chosen, all at once: their font and size."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QToolButton, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...qt.glyphs import Face
from ...qt.keys import ENTER
from ...qt.labels import Label
from ...widgets.boxes import column_of, row_of
from ...widgets.choice_style import choice_style
from ...widgets.overlay_frame import OverlayFrame
from ...widgets.tool_buttons import tool_button
from .font_box import FontBox
from .size_box import SizeBox

_ABOVE = 12
"""Pixels between it and the upper side of what it lies over."""


class TypeBar(OverlayFrame):
    """A small frame above the canvas that has no words of its own.

    Signals
    -------
    font_asked, font_looked_at
        All letters shall be of a family, or are to be seen so; of their own where that is empty.
    switched
        All shall have a look: the field of a run, and whether.
    sized
        All shall have a size.
    closed
        It is not wanted any more.
    """

    font_asked = Signal(str)
    font_looked_at = Signal(str)
    switched = Signal(str, bool)
    sized = Signal(float)
    closed = Signal()

    def __init__(self, below: QWidget, family: str) -> None:
        super().__init__("typeBar", below)
        self.setAccessibleName("Font and size of the chosen texts")
        self.font_box, self.size_box = FontBox(family), SizeBox()
        self.font_box.picked.connect(self.font_asked)
        self.font_box.pointed_at.connect(self.font_looked_at)
        self.size_box.sized.connect(self.sized)
        self._remark = Label(name="typeRemark", wordWrap=True)
        self.size_box.refused.connect(self.remark)
        self.size_box.left.connect(lambda: self.remark(""))
        self._subject = Label(name="typeSubject")
        self.bold, self.italic = self._switch("bold", "B"), self._switch("italic", "I")
        self._close = tool_button("closeType", "Close", "Put this bar away", flat=True)
        self._close.clicked.connect(self.closed)
        row = row_of(
            self._subject, self.font_box, self.bold, self.italic, self.size_box, self._close, spacing=6
        )
        column_of(row, self._remark, margins=(10, 6, 6, 6), spacing=4, parent=self)
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        self.remark("")
        self.hide()
        self.follow_theme()

    def _switch(self, name: str, letter: str) -> QToolButton:
        title = name.capitalize()
        button = tool_button(f"type{title}", title, f"{title} letters in all chosen texts", text=letter)
        font = button.font()
        font.setBold(name == "bold")
        font.setItalic(name == "italic")
        button.setFont(font)
        button.setCheckable(True)
        button.clicked.connect(lambda is_on: self.switched.emit(name, is_on))
        return button

    def show_texts(self, subject: str, faces: Sequence[Face], sizes: Sequence[float]) -> None:
        """Show what letters of texts have; several fonts or sizes are told of, and the first is shown."""
        first, families = faces[0], [each.family for each in faces]
        self._subject.setText(subject)
        self.font_box.take(first.family)
        self.size_box.show_size(sizes[0])
        self.bold.setChecked(first.bold)
        self.italic.setChecked(first.italic)
        several = [
            word for word, found in (("fonts", families), ("sizes", sizes)) if len(dict.fromkeys(found)) > 1
        ]
        self.remark(f"There are several {' and '.join(several)} among them." if several else "")

    def remark(self, text: str) -> None:
        """Say something below; nothing where that is empty."""
        self._remark.setText(text)
        self._remark.setVisible(bool(text))
        self.place()

    def place(self) -> None:
        if self.isHidden():
            return
        if (layout := self.layout()) is not None:
            layout.activate()
        below, hint = self.below.size(), self.sizeHint()
        width = min(hint.width(), below.width())
        self.setGeometry((below.width() - width) // 2, _ABOVE, width, hint.height())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
        elif event.key() not in ENTER:
            # With that the canvas below would edit what is chosen.
            super().keyPressEvent(event)

    def set_theme(self, theme: Theme) -> None:
        self._close.setIcon(icon("close", theme))
        self.set_sheet(choice_style(theme))
