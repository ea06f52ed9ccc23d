"""The status line: what a press would do at the left, where the pointer is at the right."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QLabel, QSizePolicy, QStatusBar, QToolButton, QWidget

from app.document.model import Vector
from app.view_model.basis_view import BasisView

_SAID_MS = 6000
_READ_MS = 1500
"""How long a sentence stays in any case, before a new hint may take its place."""


class StatusLine(QStatusBar):
    """Shows hints, sentences, the pointer's place and the Lebesgue constant."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("statusLine")
        self.setSizeGripEnabled(False)
        self._label = QLabel()
        self._label.setObjectName("hint")
        # A long hint is cut, it never widens the window.
        self._label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._place, self._t, self._lebesgue = QLabel(), QLabel(), QLabel()
        self._place.setObjectName("pointerPlace")
        self._t.setObjectName("pointerT")
        self._lebesgue.setObjectName("lebesgueConstant")
        self._lebesgue.setToolTip("Lebesgue constant: how much errors in the points can grow on the curve")
        self._offer = QToolButton()
        self._offer.setObjectName("offeredAction")
        self._offer.setAccessibleName("What can be done about it")
        self._offer.setToolTip("What can be done about it")
        self._offer.setAutoRaise(True)
        self._offer.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self._offer.setIconSize(QSize(14, 14))
        self._offer.hide()
        self.addWidget(self._offer)
        self.addWidget(self._label, 1)
        for label in (self._place, self._t, self._lebesgue):
            self.addPermanentWidget(label)
        self._hint = self._said = ""
        self.unit = ""
        self._timer = QTimer(self, singleShot=True, interval=_SAID_MS)
        self._timer.timeout.connect(self._forget_said)

    @property
    def text(self) -> str:
        """The sentence at the left."""
        return self._label.text()

    @property
    def hint(self) -> str:
        """What a press at the pointer would do, whatever has been said since."""
        return self._hint

    def show_hint(self, text: str) -> None:
        """Show what a press would do; a sentence just said stays in front."""
        is_new, self._hint = text != self._hint, text
        could_be_read = self._timer.remainingTime() < _SAID_MS - _READ_MS
        if not self._said or (is_new and text and could_be_read):
            self._said = ""
            self._label.setText(text)

    def show_progress(self, text: str) -> None:
        """Show how far a gesture has come, in front of whatever has been said; empty leaves it to others."""
        if text:
            self._timer.stop()
            self._said = ""
            self._label.setText(text)

    def say(self, text: str) -> None:
        """Show a sentence for some seconds."""
        self._said = text
        self._label.setText(text)
        self._offer.hide()
        self._timer.start()

    def offer(self, text: str, action: QAction) -> None:
        """Show a sentence, and a button for what can be done about it."""
        self.say(text)
        self._offer.setDefaultAction(action)
        self._offer.setAccessibleName(action.text())
        self._offer.show()

    def _forget_said(self) -> None:
        self._said = ""
        self._offer.hide()
        self._label.setText(self._hint)

    def show_place(self, place: Vector | None) -> None:
        """Show where the pointer is on the canvas."""
        unit = f" {self.unit}" if self.unit else ""
        text = "" if place is None else f"x {place[0]:.4g}{unit}   y {place[1]:.4g}{unit}"
        self._place.setText(text.replace("-", "−"))

    def show_t(self, t: float | None) -> None:
        """Show the t under the pointer or the scrub line."""
        self._t.setText("" if t is None else f"t {t:.4g}".replace("-", "−"))

    def show_lebesgue(self, basis: BasisView | None) -> None:
        """Show the Lebesgue constant of the functions on screen."""
        self._lebesgue.setText("" if basis is None else f"Λ {basis.lebesgue_constant:.3g}")
