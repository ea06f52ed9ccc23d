"""Words at the right of the status line: the pointer's place, t and the Lebesgue constant."""

from __future__ import annotations

import math

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QStatusBar

from ..document.model import Vector
from ..document.words import number
from ..qt.labels import set_tip
from ..widgets.controls import named
from ..widgets.elided_label import SteadyLabel

_LEBESGUE_TIP = (
    "Lebesgue constant: how much errors in the points can grow on the curve, "
    "with the velocities and accelerations that are estimated from them"
)
_HOLDS_TIP = "; it is that of small errors in x or y, whichever grow more, and another one for other points"

_SOON_MS = 33
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
