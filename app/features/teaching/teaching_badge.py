"""A badge in the status line: a sign and a word; a click tells what it means and what can be done."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QPushButton, QToolButton

from ...appearance.theme import FollowsTheme, Theme
from ...qt.labels import Label, set_tip, tip_of
from ...qt.overrides import SafeOverrides
from ...view_model.analysis.warnings import Warned
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import push_button

_WIDTH = 340


class TeachingBadge(FollowsTheme, QToolButton):
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

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("teachingBadge")
        self.setAutoRaise(True)
        # No higher than the labels beside it: the drawing must not move when the badge appears.
        self.setFixedHeight(self.fontMetrics().height() + 4)
        self._popup = _Popup(self)
        self.clicked.connect(self._open)
        self.hide()
        self.follow_theme()

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
        set_tip(self, tip_of(f"{warned.sentence} Click for what can be done"))
        self.setAccessibleName(f"{warned.badge}. {warned.sentence}")
        self._popup.sentence.setText(warned.sentence)

    def _open(self) -> None:
        popup = self._popup
        popup.adjustSize()
        corner = self.mapToGlobal(QPoint(self.width(), 0))
        popup.move(corner - QPoint(popup.width(), popup.height() + 6))
        popup.show()
        popup.laboratory.setFocus(Qt.FocusReason.PopupFocusReason)

    def set_theme(self, theme: Theme) -> None:
        self.setStyleSheet(f"QToolButton {{ color: {theme.warning.name()}; padding: 0px 8px }}")


class _Popup(SafeOverrides, QFrame):
    """The sentence, two links and a way to put it away."""

    def __init__(self, badge: TeachingBadge) -> None:
        super().__init__(badge, Qt.WindowType.Popup)
        # Not in the muted colour of the status line, which is its ancestor.
        self.setStyleSheet("QLabel { color: palette(window-text); padding: 0px }")
        self.setObjectName("teachingPopup")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setFixedWidth(_WIDTH)
        self.sentence = Label(name="teachingSentence", wordWrap=True)
        self.laboratory = _link(
            "openLaboratory", "Open the laboratory", "Compute with few digits and see what gets lost"
        )
        self.explain = _link("openExplanation", "Show a cure", "Explain the widest swing, and try cures")
        self.away = _link("putBadgeAway", "Put away", "Say no more of this until there is a new reason")
        for button, signal in (
            (self.laboratory, badge.laboratory_wanted),
            (self.explain, badge.explanation_wanted),
            (self.away, badge.dismiss),
        ):
            button.clicked.connect(self.hide)
            button.clicked.connect(signal)
        links = row_of(self.laboratory, self.explain, self.away)
        column_of(self.sentence, links, margins=(12, 10, 12, 10), parent=self)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
            return
        super().keyPressEvent(event)


def _link(name: str, text: str, tip: str) -> QPushButton:
    return push_button(name, text, tip, text)
