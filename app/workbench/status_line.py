"""The status line: what a press would do at the left, where the pointer is at the right."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QSizePolicy, QStatusBar, QWidget

from app.appearance.theme import theme_of
from app.document.model import Vector
from app.document.words import number
from app.widgets.elided_label import ElidedLabel, SteadyLabel

_SAID_MS = 6000
_READ_MS = 1500
"""Least time that a sentence stays before a new hint may take its place."""

_LEBESGUE_TIP = (
    "Lebesgue constant: how much errors in the points can grow on the curve, "
    "with the velocities and accelerations that are estimated from them"
)

_SOON_MS = 33

_SAME_PRESS_MS = 200
"""A sentence this young was said by the press that begins a gesture: the focus left a field, for instance."""


class StatusLine(QStatusBar):
    """Shows hints, sentences, the pointer's place and the Lebesgue constant.

    At the left stands one of four things, the first that there is: how far a gesture has come; the tip of the
    menu entry or button under the pointer; what has been said; what a press would do.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("statusLine")
        self.setSizeGripEnabled(False)
        self._label = ElidedLabel()
        self._label.setObjectName("hint")
        self._label.setContentsMargins(6, 0, 6, 0)
        # A long hint is cut, it never widens the window.
        self._label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._place, self._t, self._lebesgue = SteadyLabel(), SteadyLabel(), SteadyLabel()
        self._place.setObjectName("pointerPlace")
        self._t.setObjectName("pointerT")
        self._lebesgue.setObjectName("lebesgueConstant")
        self._lebesgue.setToolTip(_LEBESGUE_TIP)
        self.addWidget(self._label, 1)
        for label in (self._place, self._t, self._lebesgue):
            self.addPermanentWidget(label)
        self._progress = self._tip = self._said = self._hint = self._refusal = ""
        self._place_now: Vector | None = None
        self._t_here: float | None = None
        self._t_scrub: float | None = None
        self._growth: float | None = math.nan
        self.unit = ""
        self._soon = QTimer(self, singleShot=True, interval=_SOON_MS)
        self._soon.timeout.connect(self._render)
        self._timer = QTimer(self, singleShot=True, interval=_SAID_MS)
        # A coarse timer would not know a press's own sentence from an older one.
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self.clear_message)

    @property
    def text(self) -> str:
        """The sentence at the left."""
        return self._progress or self._tip or self._said or self._hint

    @property
    def is_refusal(self) -> bool:
        """Whether that sentence tells that something was not done; a sign and a colour mark it."""
        return bool(self._refusal) and self.text == self._refusal

    @property
    def hint(self) -> str:
        """Hint about a press at the pointer, whatever has been said since."""
        return self._hint

    def _render(self) -> None:
        self._soon.stop()
        self._label.colour = theme_of(self.palette()).warning if self.is_refusal else None
        self._label.setText(f"⚠ {self.text}" if self.is_refusal else self.text)
        self._place.setText(self._place_text())
        self._t.setText(self._t_text())
        self._lebesgue.setText(self._lebesgue_text())

    def _render_soon(self) -> None:
        """Write what changes with every move, but not each time: nobody reads that fast."""
        if not self._soon.isActive():
            self._soon.start()

    def show_hint(self, text: str) -> None:
        """Show what a press would do; a sentence just said stays in front."""
        is_new, self._hint = text != self._hint, text
        could_be_read = self._timer.remainingTime() < _SAID_MS - _READ_MS
        if is_new and text:
            self._tip = ""
            if could_be_read:
                self._said = self._refusal = ""
        self._render()

    def show_progress(self, text: str) -> None:
        """Show how far a gesture has come, in place of what was said before it; empty when it has ended."""
        self._progress = text
        if not text:
            self._render()
            return
        self._said = self._tip = ""
        self._render_soon()

    def show_tip(self, text: str) -> None:
        """Show what the entry under the pointer does; empty when the pointer has left it."""
        self._tip = text
        self._render()

    def say(self, text: str) -> None:
        """Show a sentence for some seconds."""
        self._said, self._tip = text, ""
        self._timer.start()
        self._render()

    def refuse(self, text: str) -> None:
        """Show for some seconds that something was not done, and why."""
        self._refusal = text
        self.say(text)

    def begin_gesture(self) -> None:
        """Put away what was said before this press."""
        self._tip = ""
        if self._timer.remainingTime() < _SAID_MS - _SAME_PRESS_MS:
            self.clear_message()

    def clear_message(self) -> None:
        """Put away what was said: it has stood long enough."""
        self._said = self._refusal = ""
        self._timer.stop()
        self._render()

    def unsay(self, text: str) -> None:
        """Put a sentence away before its time, if it still stands: it is true no longer."""
        if text and self._said == text:
            self.clear_message()

    def forget(self) -> None:
        """Put away all sentences: they were about a document that is another one now."""
        self._progress = self._tip = self._hint = ""
        self._t_here = None
        self.clear_message()

    def show_place(self, place: Vector | None) -> None:
        """Show where the pointer is on the canvas."""
        self._place_now = place
        self._render_soon()

    def _place_text(self) -> str:
        if self._place_now is None:
            return ""
        x, y = self._place_now
        unit = f" {self.unit}" if self.unit else ""
        return f"x {number(x)}{unit}   y {number(y)}{unit}"

    def show_t(self, t: float | None) -> None:
        """Show the t under the pointer; None when the pointer is elsewhere."""
        self._t_here = t
        self._render_soon()

    def show_scrub(self, t: float | None) -> None:
        """Show the t of the scrub line while the pointer is elsewhere; None without one."""
        self._t_scrub = t
        self._render_soon()

    def _t_text(self) -> str:
        t = self._t_scrub if self._t_here is None else self._t_here
        return "" if t is None else f"t {number(t)}"

    def show_lebesgue(self, constant: float) -> None:
        """Show the Lebesgue constant of the points; NaN without a curve."""
        self._growth = constant
        self._render_soon()

    def wait_for_lebesgue(self) -> None:
        """Show that the Lebesgue constant changes."""
        self._growth = None
        self._render_soon()

    def _lebesgue_text(self) -> str:
        if self._growth is None:
            return "Λ …"
        if math.isnan(self._growth):
            return ""
        return f"Λ {'∞' if math.isinf(self._growth) else number(self._growth, 3)}"
