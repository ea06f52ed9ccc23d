"""Status line: hints and messages at the left; position, t and Lebesgue constant at the right."""

from __future__ import annotations

import math

from PySide6.QtCore import QTimer
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QStatusBar, QStyle, QStyleOption, QWidget

from ..appearance.theme import theme_of
from ..document.model import Vector
from ..document.words import number
from ..qt.labels import set_tip
from ..qt.overrides import SafeOverrides
from ..widgets.controls import named
from ..widgets.elided_label import ElidedLabel, SteadyLabel

_SAID_MS = 6000
_READ_MS = 1500
"""Least time that a sentence stays before a new hint may take its place."""

_SOON_MS = 33
"""Milliseconds after which words are written that change with every move: nobody reads faster."""


class StatusLine(SafeOverrides, QStatusBar):
    """Shows a sentence at the left, numbers at the right.

    The sentence is one of four, the first that there is: how far a gesture has come; the tip of the menu
    entry or button under the pointer; what has been said; what a press would do.

    Attributes
    ----------
    readouts
        The numbers.
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
        # A permanent widget: others Qt hides while there is a tip, for good where a button goes away with it.
        self.addPermanentWidget(self._label, 1)
        self.messageChanged.connect(self._follow_tip)
        self.readouts = Readouts(self)
        self._progress = self._tip = self._said = self._hint = self._refusal = ""
        self._soon = QTimer(self, singleShot=True, interval=_SOON_MS)
        self._soon.timeout.connect(self._render)
        self._timer = QTimer(self, singleShot=True, interval=_SAID_MS)
        self._timer.timeout.connect(self.clear_message)
        # It runs until the event is over in which the sentence was said.
        self._just_said = QTimer(self, singleShot=True, interval=0)

    def put_after(self, widget: QWidget) -> None:
        """Put a widget behind the sentence, before all numbers."""
        self.insertPermanentWidget(1, widget)

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
        self.readouts.catch_up()

    def show_hint(self, text: str) -> None:
        """Show what a press would do; a sentence just said stays in front."""
        is_new, self._hint = text != self._hint, text
        could_be_read = self._timer.remainingTime() < _SAID_MS - _READ_MS
        if is_new and text:
            self.clearMessage()
            if could_be_read:
                self._said = self._refusal = ""
        self._render()

    def show_progress(self, text: str) -> None:
        """Show how far a gesture has come, in place of what was said before it; empty when it has ended."""
        self._progress = text
        if not text:
            self._render()
            return
        self._said = ""
        self.clearMessage()
        if not self._soon.isActive():
            self._soon.start()

    def show_tip(self, text: str) -> None:
        """Show what the entry under the pointer does; empty when the pointer has left it."""
        self.showMessage(text)

    def _follow_tip(self, text: str) -> None:
        # Qt hands the tips of menus, buttons and actions on to the status line by itself.
        self._tip = text
        self._render()

    def paintEvent(self, event: QPaintEvent) -> None:
        # Without what Qt would write over the label.
        option = QStyleOption()
        option.initFrom(self)
        with QPainter(self) as painter:
            self.style().drawPrimitive(QStyle.PrimitiveElement.PE_PanelStatusBar, option, painter, self)

    def say(self, text: str) -> None:
        """Show a sentence for some seconds."""
        self._said = text
        self.clearMessage()
        self._timer.start()
        self._just_said.start()
        self._render()

    def refuse(self, text: str) -> None:
        """Show for some seconds that something was not done, and why, until a gesture in flight goes on."""
        self._refusal, self._progress = text, ""
        self.say(text)

    def begin_gesture(self) -> None:
        """Put away what was said before this press, not what it made a field say that lost the focus."""
        self.clearMessage()
        if not self._just_said.isActive():
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

    def reset(self) -> None:
        """Put away all sentences: they were about a document that is another one now."""
        self._progress = self._hint = ""
        self.clearMessage()
        self.readouts.show_t(None)
        self.clear_message()


_LEBESGUE_TIP = (
    "Lebesgue constant: the factor by which errors of the points can grow on the curve, "
    "including the velocities and accelerations estimated from them"
)
_HOLDS_TIP = "; it holds for small errors in x or y, whichever grow more, and depends on the points"

"""Milliseconds after which numbers are written that change with every move: nobody reads faster."""


class Readouts:
    """The numbers of a status line.

    Attributes
    ----------
    unit
        What is written behind the place.
    """

    def __init__(self, line: QStatusBar) -> None:
        self._place_label = named(SteadyLabel(), "pointerPlace")
        self._t_label = named(SteadyLabel(), "pointerT")
        self._lebesgue_label = named(SteadyLabel(), "lebesgueConstant", tip=_LEBESGUE_TIP)
        for label in (self._place_label, self._t_label, self._lebesgue_label):
            line.addPermanentWidget(label)
        self._place_now: Vector | None = None
        self._t_here: float | None = None
        self._t_scrub: float | None = None
        self._lebesgue: float | None = math.nan
        self._lebesgue_holds = ""
        self.unit = ""
        self._soon = QTimer(line, singleShot=True, interval=_SOON_MS)
        self._soon.timeout.connect(self.render)

    def show_unit(self, unit: str) -> None:
        """Show the place in this unit from now on."""
        self.unit = unit
        self._render_soon()

    def show_place(self, place: Vector | None) -> None:
        """Show where the pointer is on the canvas."""
        self._place_now = place
        self._render_soon()

    def show_t(self, t: float | None) -> None:
        """Show the t under the pointer; None when the pointer is elsewhere."""
        if t != self._t_here:
            self._t_here = t
            self._render_soon()

    def show_scrub(self, t: float | None) -> None:
        """Show the t of the scrub line while the pointer is elsewhere; None without one."""
        self._t_scrub = t
        self._render_soon()

    def show_lebesgue(self, constant: float | None, holds: str = "") -> None:
        """Show the Lebesgue constant of the points; NaN without a curve, None while it changes.

        `holds` says where it holds, if it is another one for other points.
        """
        if (constant, holds) != (self._lebesgue, self._lebesgue_holds):
            self._lebesgue, self._lebesgue_holds = constant, holds
            set_tip(self._lebesgue_label, _LEBESGUE_TIP + _HOLDS_TIP * bool(holds))
            self._render_soon()

    def _render_soon(self) -> None:
        if not self._soon.isActive():
            self._soon.start()

    def catch_up(self) -> None:
        """Write the numbers that wait, together with the words beside them."""
        if self._soon.isActive():
            self.render()

    def render(self) -> None:
        """Write the numbers now."""
        self._soon.stop()
        self._place_label.setText(self._place_text())
        t = self._t_scrub if self._t_here is None else self._t_here
        self._t_label.setText("" if t is None else f"t {number(t)}")
        self._lebesgue_label.setText(self._lebesgue_text())

    def _place_text(self) -> str:
        if self._place_now is None:
            return ""
        x, y = self._place_now
        unit = f" {self.unit}" if self.unit else ""
        return f"x {number(x)}{unit}   y {number(y)}{unit}"

    def _lebesgue_text(self) -> str:
        if self._lebesgue is None:
            return "Λ …"
        if math.isnan(self._lebesgue):
            return ""
        constant = "∞" if math.isinf(self._lebesgue) else number(self._lebesgue, 3)
        return f"Λ {constant} {self._lebesgue_holds}".rstrip()
