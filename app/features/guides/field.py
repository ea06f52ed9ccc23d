"""The field on the canvas into which place and angle of a guide are typed."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QWidget

from ...document.expression import ExpressionError, parse_number
from ...document.guide import Axis, Guide, guide_at
from ...document.readings import PLAIN, Readings
from ...document.value import Vector
from ...qt.labels import Label
from ...widgets.controls import named
from ...widgets.entry_field import EntryEdit, EntryField
from ...widgets.number_text import angle_text, decimal_mark, field_text, typed_text
from ...widgets.tool_buttons import tool_button
from .places import read_place

_TIP = "Where the guide lies: a number or an expression, with a unit if you like, such as 20, 1/3 or 1 in"
_ANGLE_TIP = "Degrees from the x axis, {}: 0 is level, 90 upright"
_ANGLE_WIDTH = 55


class GuideField(EntryField):
    """A small frame beside a ruler, in which the place of one guide and its angle are typed.

    Signals
    -------
    entered
        A guide shall be there.
    """

    entered = Signal(object)

    def __init__(self, below: QWidget) -> None:
        self._axis, self._unit, self._readings = Axis.X, "", PLAIN
        self._guide: Guide | None = None
        self._degrees = 0.0
        self._middle: Vector = (0.0, 0.0)
        turn = tool_button("guideAxis", "Coordinate of the guide", "Upright (x) or level (y)", text="x =")
        edit = named(EntryEdit(), "guidePlace", "Place of the guide", _TIP)
        self.angle = named(EntryEdit(), "guideAngle", "Angle of the guide", _ANGLE_TIP.format(PLAIN.sense))
        self.angle.setFixedWidth(_ANGLE_WIDTH)
        super().__init__("guideField", "Guide", below, turn, edit, self.angle, Label("°"))

    def open_for(
        self,
        guide: Guide | None,
        axis: Axis,
        unit: str,
        readings: Readings,
        corner: Callable[[Axis], QPoint],
        middle: Vector,
    ) -> None:
        """Ask for the place of a guide, or of a new one of this axis, at a corner of the canvas.

        It is typed as `readings` tell it.
        One that is level or upright so far is turned about its point beside the `middle`.
        """
        self._guide, self._axis, self._unit, self._middle = guide, axis, unit, middle
        self._readings = readings
        self.angle.setToolTip(_ANGLE_TIP.format(readings.sense))
        self._turn.setEnabled(guide is None)
        about, place = "", ""
        if guide is not None:
            other = guide.axis.other
            across = readings.shown_at(other.coordinate, guide.across)
            about = f"at {other.value} = {field_text(across)}" if guide.lean else ""
            place = typed_text(readings.shown_at(axis.coordinate, guide.position))
        self._show_angle(readings.line_angle(guide.angle) if guide is not None else _angle_of(axis))
        self.ask(place, f"{unit} {about}".strip(), lambda: corner(self._axis))

    def _kind(self) -> str:
        return f"{self._axis.value} ="

    def _other_kind(self) -> None:
        self._axis = self._axis.other
        self._show_angle(_angle_of(self._axis))

    def _show_angle(self, degrees: float) -> None:
        self._degrees = degrees
        self.angle.setText(angle_text(degrees))

    def _take(self, text: str) -> Callable[[], object]:
        readings, guide = self._readings, self._guide
        now = readings.shown_at(guide.axis.coordinate, guide.position) if guide is not None else 0.0
        typed = read_place(text, self._unit, now)
        axis = typed.axis or self._axis
        if axis is not self._axis and guide is not None:
            raise ExpressionError(f"This guide holds {self._axis.value}; type that.")
        entered = self._typed_guide(axis, readings.meant_at(axis.coordinate, typed.position))
        return lambda: self.entered.emit(entered)

    def _read_angle(self, plain: float) -> float:
        """Return the angle that was typed, `plain` for none; the one that is shown short is meant whole."""
        text = self.angle.text().strip()
        if text == angle_text(self._degrees):
            return self._degrees
        return parse_number(text, decimal_mark()) if text else plain

    def _typed_guide(self, axis: Axis, position: float) -> Guide:
        """Return the guide at the place that was typed, at the angle beside it."""
        plain = _angle_of(self._axis)
        angle = self._read_angle(plain)
        if angle % 180.0 == plain:
            return Guide(axis, position)
        across = self._middle[axis.other.coordinate]
        if self._guide is not None and self._guide.lean:
            across = self._guide.across
        point = (position, across) if axis is Axis.X else (across, position)
        return guide_at(point, self._readings.line_angle(angle))


def _angle_of(axis: Axis) -> float:
    """Return the degrees from the x axis to a level or an upright guide."""
    return Guide(axis, 0.0).angle
