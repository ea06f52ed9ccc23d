"""A panel over the canvas that offers what was not saved when the program last ended."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QPixmap
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QScrollArea, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...document.words import count_of
from ...qt.labels import Label, tip_of
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import push_button, tool_button
from ...widgets.elided_label import ElidedLabel
from ...widgets.frames import OverlayFrame
from .offers import Offer
from .thumbnail import thumbnail

_WIDEST, _SIDE, _BELOW = 640, 40, 44
_PICTURE = (88, 56)
_AROUND_TEXT = 26


class RecoveryBar(OverlayFrame):
    """Lies over the lower part of its parent and takes no room from it; work goes on behind it.

    Signals
    -------
    restore_asked, discard_asked, later_asked
        The person has decided about the offer with this index.
    closed
        Everything that is still there is to be decided later.
    """

    restore_asked = Signal(int)
    discard_asked = Signal(int)
    later_asked = Signal(int)
    closed = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__("recoveryBar", parent)
        self.setAccessibleName("Unsaved work")
        self._offers: tuple[Offer, ...] = ()
        self._pictures: list[Label] = []
        self._title = Label(name="recoveryTitle", wordWrap=True)
        self._note = Label(name="recoveryNote", wordWrap=True)
        tip = "Decide later; the next start asks again"
        self._close = tool_button("closeRecovery", "Decide later", tip, flat=True)
        self._close.clicked.connect(self.closed)
        self._rows = QScrollArea()
        self._rows.setObjectName("recoveryRows")
        self._rows.setFrameShape(QFrame.Shape.NoFrame)
        self._rows.setWidgetResizable(True)
        self._rows.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        words = column_of(self._title, self._note, margins=(0, 4, 0, 0))
        head = row_of((words, 1), (self._close, Qt.AlignmentFlag.AlignTop))
        column_of(head, self._rows, margins=(14, 6, 8, 12), spacing=8, parent=self)
        self.follow_theme()

    def render(self, offers: Sequence[Offer], note: str = "") -> None:  # type: ignore[override]
        """Show `offers`, and above them `note`; hide where there is neither.

        The name is that of every panel; QWidget's own `render`, which paints into a device, is not used.
        """
        self._offers = tuple(offers)
        number = "A document" if len(offers) == 1 else count_of(len(offers), "document")
        self._title.setText(f"{number} with unsaved work from last time:")
        self._title.setVisible(bool(offers))
        self._note.setText(note)
        self._note.setVisible(bool(note))
        self._build_rows()
        self.setVisible(bool(offers or note))
        if offers or note:
            self.place()
            self.raise_()

    @property
    def text(self) -> str:
        """The sentences at the top; empty while the panel is hidden."""
        shown = [label.text() for label in (self._title, self._note) if not label.isHidden()]
        return "" if self.isHidden() else "\n".join(shown)

    def _build_rows(self) -> None:
        content = QWidget()
        self._pictures.clear()
        rows = [self._row(index, offer) for index, offer in enumerate(self._offers)]
        column_of(*rows, 1, margins=(0, 0, 6, 0), spacing=8, parent=content)
        self._paint_pictures()
        self._rows.setWidget(content)
        content.setAutoFillBackground(False)
        self._rows.viewport().setAutoFillBackground(False)
        self._rows.setVisible(bool(self._offers))

    def _row(self, index: int, offer: Offer) -> QHBoxLayout:
        picture = Label(name=f"recoveryPicture{index}", label=f"Picture of {offer.name}")
        self._pictures.append(picture)
        picture.setFixedSize(*_PICTURE)
        name, told = ElidedLabel(), ElidedLabel()
        name.setText(offer.name)
        font = name.font()
        font.setBold(True)
        name.setFont(font)
        told.setText(offer.told)
        told.setObjectName("recoveryTold")
        name.setToolTip(tip_of(offer.tip or offer.name))
        words = column_of(1, name, told, 1, spacing=2)
        return row_of(picture, (words, 1), *self._buttons(index, offer.name), spacing=10)

    def _buttons(self, index: int, name: str) -> Iterator[QPushButton]:
        for key, text, tip, asked in (
            ("restoreWork", "Restore", f"Open the unsaved work on {name}", self.restore_asked),
            ("discardWork", "Discard", f"Delete the unsaved work on {name} for good", self.discard_asked),
            ("laterWork", "Later", f"Keep the unsaved work on {name} for the next start", self.later_asked),
        ):
            button = push_button(f"{key}{index}", text, tip_of(tip), tip)
            button.setFixedWidth(button.fontMetrics().horizontalAdvance(text) + _AROUND_TEXT)
            button.clicked.connect(lambda _checked=False, asked=asked: asked.emit(index))
            yield button

    def place(self) -> None:
        """Lie at the bottom, in the middle; half of the parent stays free, the rows scroll."""
        below = self.below
        width = min(below.width() - 2 * _SIDE, _WIDEST)
        content = self._rows.widget()
        wanted = content.sizeHint().height() if self._offers and content is not None else 0
        self._rows.setFixedHeight(min(wanted, max(below.height() // 2, _PICTURE[1])))
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        top = max(below.height() - height - _BELOW, 0)
        self.setGeometry((below.width() - width) // 2, top, width, height)

    def take_focus(self) -> None:
        """Put the keyboard's focus on the first button."""
        button = self.findChild(QPushButton, "restoreWork0") or self._close
        button.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
            return
        super().keyPressEvent(event)

    def set_theme(self, theme: Theme) -> None:
        self._close.setIcon(icon("close", theme))
        self.set_sheet(
            "#recoveryTitle { font-weight: bold }"
            f"#recoveryNote {{ color: {theme.warning.name()} }}"
            f"#recoveryTold {{ color: {theme.muted.name()} }}"
        )
        self._paint_pictures()

    def _paint_pictures(self) -> None:
        ratio = self.devicePixelRatioF()
        for picture, offer in zip(self._pictures, self._offers, strict=True):
            image = thumbnail(offer.document, *_PICTURE, self.theme, ratio)
            picture.setPixmap(QPixmap.fromImage(image))
