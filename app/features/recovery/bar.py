"""A panel over the canvas that offers what was not saved when the program last ended."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QPixmap
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from app.appearance.icons import icon
from app.appearance.theme import mix, theme_of
from app.document.words import count_of
from app.features.recovery.offers import Offer
from app.features.recovery.thumbnail import thumbnail
from app.qt.labels import Label, tip_of
from app.qt.overrides import Guarded
from app.widgets.elided_label import ElidedLabel
from app.widgets.tool_buttons import tool_button

_WIDEST, _SIDE, _BELOW = 640, 40, 44
_PICTURE = (88, 56)
_AROUND_TEXT = 26


class RecoveryBar(Guarded, QFrame):
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
        super().__init__(parent)
        self.setObjectName("recoveryBar")
        self.setAccessibleName("Unsaved work")
        self._below = parent
        self._offers: tuple[Offer, ...] = ()
        self._pictures: list[Label] = []
        self._theme = theme_of(QApplication.palette())
        self._title, self._note = Label(), Label()
        self._title.setObjectName("recoveryTitle")
        self._note.setObjectName("recoveryNote")
        for label in (self._title, self._note):
            label.setWordWrap(True)
        tip = "Decide later; the next start asks again"
        self._close = tool_button("closeRecovery", "Decide later", tip, flat=True)
        self._close.clicked.connect(self.closed)
        self._rows = QScrollArea()
        self._rows.setObjectName("recoveryRows")
        self._rows.setFrameShape(QFrame.Shape.NoFrame)
        self._rows.setWidgetResizable(True)
        self._rows.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        words = QVBoxLayout()
        words.setContentsMargins(0, 4, 0, 0)
        words.addWidget(self._title)
        words.addWidget(self._note)
        head = QHBoxLayout()
        head.addLayout(words, 1)
        head.addWidget(self._close, 0, Qt.AlignmentFlag.AlignTop)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(14, 6, 8, 12)
        layout.setSpacing(8)
        layout.addLayout(head)
        layout.addWidget(self._rows)
        parent.installEventFilter(self)
        self._apply_theme()

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
            self._place()
            self.raise_()

    @property
    def text(self) -> str:
        """The sentences at the top; empty while the panel is hidden."""
        shown = [label.text() for label in (self._title, self._note) if not label.isHidden()]
        return "" if self.isHidden() else "\n".join(shown)

    def _build_rows(self) -> None:
        content = QWidget()
        self._pictures.clear()
        layout = QVBoxLayout(content)
        layout.setContentsMargins(0, 0, 6, 0)
        layout.setSpacing(8)
        for index, offer in enumerate(self._offers):
            layout.addLayout(self._row(index, offer))
        layout.addStretch(1)
        self._paint_pictures()
        self._rows.setWidget(content)
        content.setAutoFillBackground(False)
        self._rows.viewport().setAutoFillBackground(False)
        self._rows.setVisible(bool(self._offers))

    def _row(self, index: int, offer: Offer) -> QHBoxLayout:
        picture = Label()
        picture.setObjectName(f"recoveryPicture{index}")
        picture.setAccessibleName(f"Picture of {offer.name}")
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
        words = QVBoxLayout()
        words.setSpacing(2)
        words.addStretch(1)
        words.addWidget(name)
        words.addWidget(told)
        words.addStretch(1)
        row = QHBoxLayout()
        row.setSpacing(10)
        row.addWidget(picture)
        row.addLayout(words, 1)
        for button in self._buttons(index, offer.name):
            row.addWidget(button)
        return row

    def _buttons(self, index: int, name: str) -> list[QPushButton]:
        kinds = (
            ("restoreWork", "Restore", f"Open the unsaved work on {name}", self.restore_asked),
            ("discardWork", "Discard", f"Delete the unsaved work on {name} for good", self.discard_asked),
            ("laterWork", "Later", f"Keep the unsaved work on {name} for the next start", self.later_asked),
        )
        buttons = []
        for key, text, tip, asked in kinds:
            button = QPushButton(text)
            button.setObjectName(f"{key}{index}")
            button.setToolTip(tip_of(tip))
            button.setAccessibleName(tip)
            button.setFixedWidth(button.fontMetrics().horizontalAdvance(text) + _AROUND_TEXT)
            button.clicked.connect(lambda _checked=False, asked=asked: asked.emit(index))
            buttons.append(button)
        return buttons

    def _place(self) -> None:
        """Lie at the bottom, in the middle; half of the parent stays free, the rows scroll."""
        width = min(self._below.width() - 2 * _SIDE, _WIDEST)
        content = self._rows.widget()
        wanted = content.sizeHint().height() if self._offers and content is not None else 0
        self._rows.setFixedHeight(min(wanted, max(self._below.height() // 2, _PICTURE[1])))
        height = max(self.heightForWidth(width), self.minimumSizeHint().height())
        top = max(self._below.height() - height - _BELOW, 0)
        self.setGeometry((self._below.width() - width) // 2, top, width, height)

    def take_focus(self) -> None:
        """Put the keyboard's focus on the first button."""
        button = self.findChild(QPushButton, "restoreWork0") or self._close
        button.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
            return
        super().keyPressEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize and not self.isHidden():
            self._place()
        return super().eventFilter(watched, event)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        # A style sheet of one's own is a change of the palette too.
        if event.type() == QEvent.Type.PaletteChange and theme_of(QApplication.palette()) is not self._theme:
            self._apply_theme()

    def _apply_theme(self) -> None:
        theme = self._theme = theme_of(QApplication.palette())
        line = mix(theme.ink, theme.paper, 0.14).name()
        self._close.setIcon(icon("close", theme))
        self.setStyleSheet(
            f"#recoveryBar {{ background: {theme.surface.name()}; border: 1px solid {line};"
            " border-radius: 8px }"
            "#recoveryTitle { font-weight: bold }"
            f"#recoveryNote {{ color: {theme.warning.name()} }}"
            f"#recoveryTold {{ color: {theme.muted.name()} }}"
        )
        self._paint_pictures()

    def _paint_pictures(self) -> None:
        ratio = self.devicePixelRatioF()
        for picture, offer in zip(self._pictures, self._offers, strict=True):
            image = thumbnail(offer.document, *_PICTURE, self._theme, ratio)
            picture.setPixmap(QPixmap.fromImage(image))
