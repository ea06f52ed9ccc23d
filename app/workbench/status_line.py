"""Status line: hints and messages at the left; position, t and Lebesgue constant at the right."""

from __future__ import annotations

import math
from collections.abc import Callable

from PySide6.QtCore import QTimer
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QStatusBar, QStyle, QStyleOption, QWidget

from ..appearance.theme import theme_of
from ..document.model import Vector
from ..document.words import number
from ..qt.labels import set_tip
from ..qt.overrides import SafeOverrides
from ..tasks.task import DelayedCall
from ..view_model.curve.curve_view import CurveView
from ..widgets.controls import named
from ..widgets.elided_label import ElidedLabel, SteadyLabel

_MESSAGE_MS = 6000
_READ_MS = 1500
"""Least time of a message before a new hint may replace it, in milliseconds."""

_SOON_MS = 33
"""Delay of texts that change with every move, in milliseconds."""


class StatusLine(SafeOverrides, QStatusBar):
    """Status line with a sentence at the left and numbers at the right.

    The sentence is one of four, the first that there is: how far a gesture has come; the tip of the menu
    entry or button under the pointer; the last message; the hint about a press.

    Attributes
    ----------
    readouts
        The numbers.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("statusLine")
        self.setSizeGripEnabled(False)
        self._label = ElidedLabel("hint")
        self._label.setContentsMargins(6, 0, 6, 0)
        # A long hint is elided; it never widens the window.
        self._label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        # A permanent widget: Qt hides others during a tip, forever if the button disappears meanwhile.
        self.addPermanentWidget(self._label, 1)
        self.messageChanged.connect(self._follow_tip)
        self.readouts = Readouts(self)
        self._progress = self._tip = self._message = self._hint = self._refusal = ""
        # Whether the message is about the next press of a tool.
        self._is_hint = False
        self._soon = DelayedCall(self, _SOON_MS, self._render)
        self._timer = DelayedCall(self, _MESSAGE_MS, self.clear_message)
        # It runs until the end of the event that has shown the message.
        self._fresh = QTimer(self, singleShot=True, interval=0)

    @property
    def text(self) -> str:
        """The sentence at the left."""
        return self._progress or self._tip or self._message or self._hint

    @property
    def is_refusal(self) -> bool:
        """Whether the sentence is a refusal, which has an icon and a colour."""
        return bool(self._refusal) and self.text == self._refusal

    @property
    def hint(self) -> str:
        """Hint about a press at the pointer, whether or not it is displayed."""
        return self._hint

    def _render(self) -> None:
        self._soon.stop()
        self._label.colour = theme_of(self.palette()).warning if self.is_refusal else None
        self._label.setText(f"⚠ {self.text}" if self.is_refusal else self.text)
        self.readouts.catch_up()

    def show_hint(self, text: str) -> None:
        """Show the hint about a press; a recent message stays in front.

        A refusal, or a hint about the next press, stays until the hint is another one.
        """
        is_new, self._hint = text != self._hint, text
        could_be_read = self._timer.remainingTime() < _MESSAGE_MS - _READ_MS
        if is_new and text:
            self.clearMessage()
        if text and could_be_read and (is_new or not (self._refusal or self._is_hint)):
            self._message = self._refusal = ""
        self._render()

    def show_progress(self, text: str) -> None:
        """Show the progress of a gesture in place of earlier messages; empty at its end."""
        self._progress = text
        if not text:
            self._render()
            return
        self._message = ""
        self.clearMessage()
        self._soon.start_if_idle()

    def show_tip(self, text: str) -> None:
        """Show the tip of the entry under the pointer; empty when the pointer has left it."""
        self.showMessage(text)

    def _follow_tip(self, text: str) -> None:
        # Qt passes the tips of menus, buttons and actions on to the status line.
        self._tip = text
        self._render()

    def paintEvent(self, event: QPaintEvent) -> None:
        # Without the text that Qt would write over the label.
        option = QStyleOption()
        option.initFrom(self)
        with QPainter(self) as painter:
            self.style().drawPrimitive(QStyle.PrimitiveElement.PE_PanelStatusBar, option, painter, self)

    def say(self, text: str, *, is_hint: bool = False) -> None:
        """Show a message for some seconds; a hint about the next press, until another tool is used."""
        self._message, self._is_hint = text, is_hint
        self.clearMessage()
        self._timer.start()
        self._fresh.start()
        self._render()

    def refuse(self, text: str) -> None:
        """Show a refusal for some seconds, or until a gesture in flight goes on."""
        self._refusal, self._progress = text, ""
        self.say(text)

    def clear_earlier(self) -> None:
        """Remove the message at a press, or when others are selected, but not one of the same event."""
        self.clearMessage()
        if not self._fresh.isActive():
            self.clear_message()

    def leave_tool(self) -> None:
        """Remove a hint about the next press of the tool that was in use."""
        if self._is_hint:
            self.clear_message()

    def clear_message(self) -> None:
        """Remove the message."""
        self._message, self._refusal, self._is_hint = "", "", False
        self._timer.stop()
        self._render()

    def unsay(self, text: str) -> None:
        """Remove a message that is no longer true, if it is still displayed."""
        if text and self._message == text:
            self.clear_message()

    def reset(self) -> None:
        """Remove all texts, after another document was opened."""
        self._progress = self._hint = ""
        self.clearMessage()
        self.readouts.show_t(None)
        self.clear_message()


_LEBESGUE_TIP = (
    "Lebesgue constant: the factor by which errors of the points can grow on the curve, "
    "including the velocities and accelerations estimated from them"
)
_HOLDS_TIP = "; it holds for small errors in x or y, whichever grows more, and depends on the points"

"""Milliseconds after which numbers are written that change with every move: nobody reads faster."""


class Readouts:
    """Numbers of a status line: position, t and Lebesgue constant.

    Attributes
    ----------
    unit
        What is written behind the place.
    pixel_size, view
        Return the size of a pixel of the canvas, and the curve of t.
    """

    def __init__(self, line: QStatusBar) -> None:
        self._position_label = SteadyLabel("pointerPlace")
        self._t_label = SteadyLabel("pointerT")
        self._lebesgue_label = named(SteadyLabel(), "lebesgueConstant", tip=_LEBESGUE_TIP)
        for label in (self._position_label, self._t_label, self._lebesgue_label):
            line.addPermanentWidget(label)
        self._position: Vector | None = None
        self._t_here: float | None = None
        self._t_scrub: float | None = None
        self._lebesgue: float | None = math.nan
        self._lebesgue_holds = ""
        self.unit = ""
        self.pixel_size: Callable[[], float] = lambda: 0.0
        self.view: Callable[[], CurveView]
        self._soon = DelayedCall(line, _SOON_MS, self.render)

    def show_unit(self, unit: str) -> None:
        """Set the unit of the position."""
        self.unit = unit
        self._soon.start_if_idle()

    def show_position(self, position: Vector | None) -> None:
        """Show the position of the pointer on the canvas."""
        self._position = position
        self._soon.start_if_idle()

    def show_t(self, t: float | None) -> None:
        """Show the t under the pointer; None when the pointer is elsewhere."""
        if t != self._t_here:
            self._t_here = t
            self._soon.start_if_idle()

    def show_scrub(self, t: float | None) -> None:
        """Show the t of the scrub line in place of that under the pointer; None without one.

        At once: rail, plots and motion bar show the same t in the same frame.
        """
        self._t_scrub = t
        self.render()

    def show_lebesgue(self, constant: float | None, holds: str = "") -> None:
        """Show the Lebesgue constant of the points; NaN without a curve, None while it changes.

        `holds` tells where the constant holds, if it depends on the points.
        """
        if (constant, holds) != (self._lebesgue, self._lebesgue_holds):
            self._lebesgue, self._lebesgue_holds = constant, holds
            set_tip(self._lebesgue_label, _LEBESGUE_TIP + _HOLDS_TIP * bool(holds))
            self._soon.start_if_idle()

    def catch_up(self) -> None:
        """Write delayed numbers now, together with the text beside them."""
        if self._soon.isActive():
            self.render()

    def render(self) -> None:
        """Write the numbers now."""
        self._soon.stop()
        self._position_label.setText(self._position_text())
        t = self._t_here if self._t_scrub is None else self._t_scrub
        self._t_label.setText("" if t is None else f"t {self.view().t_text(t)}")
        self._lebesgue_label.setText(self._lebesgue_text())

    def _position_text(self) -> str:
        if self._position is None:
            return ""
        x, y = (number(coordinate, step=self.pixel_size()) for coordinate in self._position)
        unit = f" {self.unit}" if self.unit else ""
        return f"x {x}{unit}   y {y}{unit}"

    def _lebesgue_text(self) -> str:
        if self._lebesgue is None:
            return "Λ …"
        if math.isnan(self._lebesgue):
            return ""
        constant = "∞" if math.isinf(self._lebesgue) else number(self._lebesgue, 3)
        return f"Λ {constant} {self._lebesgue_holds}".rstrip()
