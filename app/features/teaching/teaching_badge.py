"""A badge in the status line: a sign and a word; a click tells what it means and what can be done."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QToolButton, QVBoxLayout, QWidget

from app.appearance.theme import theme_of
from app.qt.labels import Label, tip_of
from app.qt.overrides import Guarded
from app.view_model.analysis.teaching import Warned

_WIDTH = 340


class TeachingBadge(Guarded, QToolButton):
    """A warning that teaches; hidden while there is none.

    Signals
    -------
    laboratory_wanted, explanation_wanted
        The person follows a link.
    dismiss
        The person has seen enough of this warning.
    """

    laboratory_wanted = Signal()
    explanation_wanted = Signal()
    dismiss = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("teachingBadge")
        self.setAutoRaise(True)
        # No higher than the labels beside it: the drawing must not move when the badge appears.
        self.setFixedHeight(self.fontMetrics().height() + 4)
        self._popup = _Popup(self)
        self.clicked.connect(self._open)
        self.hide()
        self._apply_theme()

    @property
    def sentence(self) -> str:
        """Meaning of the badge; empty while it is hidden."""
        return "" if self.isHidden() else self._popup.sentence.text()

    def render_warning(self, warned: Warned | None) -> None:
        """Show a warning, or none."""
        self.setVisible(warned is not None)
        if warned is None:
            self._popup.hide()
            return
        self.setText(warned.badge)
        self.setToolTip(tip_of(f"{warned.sentence} Click for what can be done"))
        self.setAccessibleName(f"{warned.badge}. {warned.sentence}")
        self._popup.sentence.setText(warned.sentence)

    def _open(self) -> None:
        popup = self._popup
        popup.adjustSize()
        corner = self.mapToGlobal(QPoint(self.width(), 0))
        popup.move(corner - QPoint(popup.width(), popup.height() + 6))
        popup.show()
        popup.laboratory.setFocus(Qt.FocusReason.PopupFocusReason)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._apply_theme()

    def _apply_theme(self) -> None:
        colour = theme_of(self.palette()).warning.name()
        sheet = f"QToolButton {{ color: {colour}; padding: 0px 8px }}"
        if sheet != self.styleSheet():
            self.setStyleSheet(sheet)


class _Popup(Guarded, QFrame):
    """The sentence, two links and a way to put it away."""

    def __init__(self, badge: TeachingBadge) -> None:
        super().__init__(badge, Qt.WindowType.Popup)
        # Not in the muted colour of the status line, which is its ancestor.
        self.setStyleSheet("QLabel { color: palette(window-text); padding: 0px }")
        self.setObjectName("teachingPopup")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setFixedWidth(_WIDTH)
        self.sentence = Label()
        self.sentence.setObjectName("teachingSentence")
        self.sentence.setWordWrap(True)
        self.laboratory = self._button(
            "openLaboratory", "Open the laboratory", "Compute with few digits and see what gets lost"
        )
        self.explain = self._button(
            "openExplanation", "Show a cure", "Explain the widest swing, and try cures"
        )
        self.away = self._button(
            "putBadgeAway", "Put away", "Say no more of this until there is a new reason"
        )
        for button, signal in (
            (self.laboratory, badge.laboratory_wanted),
            (self.explain, badge.explanation_wanted),
            (self.away, badge.dismiss),
        ):
            button.clicked.connect(self.hide)
            button.clicked.connect(signal)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 10, 12, 10)
        layout.addWidget(self.sentence)
        row = QHBoxLayout()
        for button in (self.laboratory, self.explain, self.away):
            row.addWidget(button)
        layout.addLayout(row)

    @staticmethod
    def _button(name: str, text: str, tip: str) -> QPushButton:
        button = QPushButton(text)
        button.setObjectName(name)
        button.setAutoDefault(False)
        button.setAccessibleName(text)
        button.setToolTip(tip)
        return button

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
            return
        super().keyPressEvent(event)
