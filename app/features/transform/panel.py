"""Panel of transforms in numbers: position, size and rotation of the selection, and its pivot."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import msgspec
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QButtonGroup, QToolButton, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...document.model import Vector
from ...document.transforms import Reference
from ...qt.labels import MUTED, Label
from ...qt.overrides import SafeOverrides
from ...view_model.boxes import NINE, Bounds, position_name
from ...widgets.boxes import Part, column_of, grid_of, row_of
from ...widgets.controls import ICON, action_button, choice_box, named, tool_button
from ...widgets.fields import FieldForm, NumberEdit, read_number
from ...widgets.number_text import read_length

_ROTATE_TIP = "Degrees, counterclockwise; each Enter rotates"
_SKEW = "Degrees; moves the top right, or the right side up. Enter skews horizontally"

_CERTAIN = 12
"""Digits of the largest number of the box that are no rounding."""


class TransformValues(msgspec.Struct, frozen=True):
    """Subject of the transforms.

    Attributes
    ----------
    what
        Label of the selection.
    bounds
        Its bounds; None of nothing.
    pivot
        Position of the pivot in the plane: the displayed X and Y.
    pivot_position
        The pivot position; None for another pivot.
    angle
        Rotation since the selection, in degrees.
    unit
        That of the document.
    problem
        Reason why it cannot be changed; empty where it can.
    """

    what: str
    bounds: Bounds | None
    pivot: Vector
    pivot_position: tuple[int, int] | None
    angle: float
    unit: str
    problem: str


class PanelActions(msgspec.Struct, frozen=True):
    """The actions that stand in the panel: rows of buttons, and a switch."""

    transforms: Sequence[QAction]
    aligning: Sequence[Sequence[QAction]]
    proportions: QAction


class TransformPanel(FieldForm):
    """Form with position, size and angle of the selection.

    Signals
    -------
    moved, sized
        Move the pivot, or resize the box, along an axis to a value.
    turned_to, turned_by
        Rotate to this angle; rotate by this angle.
    skewed
        Skew along an axis by this angle.
    pivot_picked
        One of nine positions: −1, 0 or 1 across, and up.
    reference_picked
        The reference for aligning curves.
    """

    moved = Signal(int, float)
    sized = Signal(int, float)
    turned_to = Signal(float)
    turned_by = Signal(float)
    skewed = Signal(int, float)
    pivot_picked = Signal(int, int)
    reference_picked = Signal(object)

    def __init__(self, actions: PanelActions, parent: QWidget | None = None) -> None:
        super().__init__("transformPanel", "transformProblem", parent)
        self._values: TransformValues | None = None
        self._turn_by, self._skew_by = 90.0, 15.0
        self.what = Label(name="transformWhat")
        self.chooser = PivotChooser()
        self.x_edit = self._length("X", "x of the pivot, about which the selection is resized", 0)
        self.y_edit = self._length("Y", "y of the pivot, about which the selection is resized", 1)
        self.width_edit = self._length("Width", "Width", 2)
        self.height_edit = self._length("Height", "Height", 3)
        self.angle_edit = _angle("transformAngle", "Angle", "Rotation since the selection, in degrees")
        self.turn_edit = _angle("transformTurn", "Rotate by", _ROTATE_TIP)
        self.turn_button = tool_button(
            "transformTurnButton", "Rotate", "Rotate by this angle about the pivot", icon_size=ICON
        )
        self.skew_edit = _angle("transformSkew", "Skew by", _SKEW)
        self.skew_buttons = (_skew_button("Across", "horizontally"), _skew_button("Up", "vertically"))
        self.proportions = action_button(actions.proportions, name="panelProportions", flat=True)
        self.reference = choice_box(
            "alignReference",
            "Align to",
            "Reference for aligning selected curves; points are aligned to each other",
            (reference.label for reference in Reference),
            (reference.tip for reference in Reference),
        )
        self._units = Label(role=MUTED)
        self._lay_out(actions)
        self._connect()
        self.follow_theme()

    def _length(self, label: str, tip: str, index: int) -> NumberEdit:
        """Return the field of one of `_numbers`."""
        tip = f"{tip}: a number or an expression, with or without a unit, or +10% (Enter to set)"
        return NumberEdit(
            f"transform{label}", label, tip, partial(self._read, lambda: self._numbers()[index])
        )

    def _read(self, now: Callable[[], float], text: str) -> float:
        unit = self._values.unit if self._values is not None else ""
        return read_length(text, unit, now())

    def _lay_out(self, actions: PanelActions) -> None:
        fields = grid_of(6, 6, stretched=[1, 3])
        rows: tuple[tuple[str, QWidget, str, QWidget], ...] = (
            ("X", self.x_edit, "Y", self.y_edit),
            ("W", self.width_edit, "H", self.height_edit),
        )
        for row, (left, first, right, second) in enumerate(rows):
            for column, part in enumerate((Label(left), first, Label(right), second)):
                fields.addWidget(part, row, column)
        fields.addWidget(self._units, 0, 4)
        fields.addWidget(self.proportions, 1, 4)
        turn = row_of(
            "Angle", (self.angle_edit, 1), "Rotate by", (self.turn_edit, 1), self.turn_button, spacing=6
        )
        align = row_of("Align to", (self.reference, 1), spacing=6)
        rest = [row_of(*map(_button, row), spacing=0) for row in actions.aligning]
        top = row_of((self.chooser, Qt.AlignmentFlag.AlignVCenter), (fields, 1), spacing=12)
        parts: list[Part] = [
            self.what,
            top,
            turn,
            row_of(
                "Skew", (self.skew_edit, 1), *self.skew_buttons, *map(_button, actions.transforms), spacing=6
            ),
            align,
            row_of(*rest, 1, spacing=8),
            self.problem,
            1,
        ]
        column_of(*parts, margins=12, spacing=10, parent=self)

    def _connect(self) -> None:
        edits = (self.x_edit, self.y_edit, self.width_edit, self.height_edit, self.angle_edit)
        self.watch(*edits, self.turn_edit, self.skew_edit)
        self.x_edit.entered.connect(partial(self.moved.emit, 0))
        self.y_edit.entered.connect(partial(self.moved.emit, 1))
        self.width_edit.entered.connect(partial(self.sized.emit, 0))
        self.height_edit.entered.connect(partial(self.sized.emit, 1))
        self.angle_edit.entered.connect(self.turned_to.emit)
        self.turn_edit.entered.connect(self._keep_turn)
        # Enter rotates again by the same angle: five leaves take Enter four times.
        self.turn_edit.is_pressed_again = self.skew_edit.is_pressed_again = True
        self.turn_edit.returnPressed.connect(self._turn)
        self.turn_button.clicked.connect(self._turn)
        self.skew_edit.entered.connect(self._keep_skew)
        self.skew_edit.returnPressed.connect(partial(self._skew, 0))
        for axis, button in enumerate(self.skew_buttons):
            button.clicked.connect(partial(self._skew, axis))
        self.chooser.picked.connect(self.pivot_picked)
        self.reference.activated.connect(lambda at: self.reference_picked.emit(list(Reference)[at]))

    # Rendering: nothing here writes back

    def _numbers(self) -> tuple[float, float, float, float]:
        """Return x and y, width and height, without the digits that are rounding."""
        values = self._values
        if values is None or values.bounds is None:
            return (0.0, 0.0, 0.0, 0.0)
        largest = max(map(abs, (*values.bounds.low, *values.bounds.high, *values.pivot, 1e-300)))
        decimals = _CERTAIN - 1 - math.floor(math.log10(largest))
        x, y, width, height = (round(value, decimals) + 0.0 for value in (*values.pivot, *values.bounds.size))
        return (x, y, width, height)

    def render_values(self, values: TransformValues) -> None:
        """Show the values of the selection."""
        if self._values is None or values.what != self._values.what:
            self.clear_refusal()
        self._values = values
        bounds, is_there = values.bounds, values.bounds is not None and not values.problem
        self.what.setText(values.what)
        self._units.show_text(values.unit)
        edits = (self.x_edit, self.y_edit, self.width_edit, self.height_edit)
        for edit, value in zip(edits, self._numbers(), strict=True):
            if bounds is None:
                edit.show_text("")
            else:
                edit.show_length(value)
        grows = [length > 0.0 for length in bounds.size] if bounds is not None else [False, False]
        for edit, can_be in zip(edits, (True, True, *grows), strict=True):
            edit.setEnabled(is_there and can_be)
        self.angle_edit.show_angle(values.angle)
        self.turn_edit.show_angle(self._turn_by)
        self.skew_edit.show_angle(self._skew_by)
        turns = self.angle_edit, self.turn_edit, self.turn_button, self.skew_edit, *self.skew_buttons
        for part in (*turns, self.chooser):
            part.setEnabled(is_there)
        self.chooser.render_pivot(values.pivot_position if bounds is not None else None)
        self.show_problem(values.problem)

    def render_reference(self, reference: Reference) -> None:
        """Show the reference for aligning curves."""
        self.reference.setCurrentIndex(list(Reference).index(reference))

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.turn_button.setIcon(icon("rotate", theme))
        for button, name in zip(self.skew_buttons, ("skew", "skew-vertically"), strict=True):
            button.setIcon(icon(name, theme))

    # Input of the user

    def _keep_turn(self, degrees: float) -> None:
        self._turn_by = degrees

    def _turn(self) -> None:
        self.turn_edit.enter()
        # Invalid input stays in the field.
        if not self.turn_edit.isModified():
            self.turned_by.emit(self._turn_by)

    def _keep_skew(self, degrees: float) -> None:
        self._skew_by = degrees

    def _skew(self, axis: int) -> None:
        self.skew_edit.enter()
        if not self.skew_edit.isModified():
            self.skewed.emit(axis, self._skew_by)


def _angle(name: str, label: str, tip: str) -> NumberEdit:
    return NumberEdit(name, label, tip, lambda text: read_number(text.rstrip(" °")))


def _skew_button(name: str, direction: str) -> QToolButton:
    tip = f"Skew {direction} by this angle, about the pivot"
    return tool_button(f"transformSkew{name}", f"Skew {direction}", tip, icon_size=ICON)


def _button(action: QAction) -> QToolButton:
    return action_button(action, flat=True)


_SIDE = 17


class PivotChooser(SafeOverrides, QWidget):
    """Nine buttons for the pivot; the one at the pivot is down, none for another pivot.

    Tab leads to that one, and the arrows from there to the others.

    Signals
    -------
    picked
        A position was picked: −1, 0 or 1 for left, middle, right, and for bottom, middle, top.
    """

    picked = Signal(int, int)

    def __init__(self) -> None:
        super().__init__()
        named(self, "pivotChooser", "Pivot")
        grid = grid_of(3, 3, margins=0, parent=self)
        self._group = QButtonGroup(self)
        self._buttons: dict[tuple[int, int], QToolButton] = {}
        for rank, at in enumerate(NINE):
            words = position_name(*at)
            name = "pivot" + "".join(word.capitalize() for word in words.split())
            tip = f"Pivot: {words} of the box, the centre of transforms. X and Y give its position"
            button = named(QToolButton(), name, f"Pivot: {words}", tip)
            button.setCheckable(True)
            button.setFixedSize(_SIDE, _SIDE)
            button.clicked.connect(partial(self.picked.emit, *at))
            grid.addWidget(button, *divmod(rank, 3))
            self._group.addButton(button)
            self._buttons[at] = button

    def render_pivot(self, position: tuple[int, int] | None) -> None:
        """Show the pivot position; None for another pivot."""
        # An exclusive group does not allow to uncheck all buttons.
        self._group.setExclusive(False)
        for at, button in self._buttons.items():
            button.setChecked(at == position)
            stops = at == (position or (0, 0))
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus if stops else Qt.FocusPolicy.NoFocus)
        self._group.setExclusive(True)
