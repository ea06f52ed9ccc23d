"""The active curve's name, interval and rules, and what there is to know about it."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from functools import partial
from typing import TypeVar

import numpy as np
from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QComboBox, QFormLayout, QHBoxLayout, QVBoxLayout, QWidget

from app.appearance.icons import icon
from app.appearance.theme import theme_of
from app.document import edits
from app.document.model import AccelerationRule, VelocityRule
from app.document.words import NamedEnum, count_of, number
from app.qt.labels import Label
from app.qt.overrides import Guarded
from app.view_model.curve_view import CoreCurve, CurveView
from app.widgets.field_edit import FieldEdit, NumberEdit
from app.widgets.number_text import decimal_mark, exact_text
from app.widgets.tool_buttons import ICON, tool_button

Rule = TypeVar("Rule", bound=StrEnum)


class CurveSettings(Guarded, QWidget):
    """A form that shows a view and reports what is typed or chosen.

    Signals
    -------
    name_edited
        Another name was typed. Who cannot use it, or an interval, calls `refuse`.
    interval_edited
        Another start or end was typed: both.
    velocity_rule_chosen, acceleration_rule_chosen
        A rule was chosen.
    reset_requested
        All derivatives that were set by hand are to be estimated again.
    refused
        Why a text that was typed is no number.
    """

    name_edited = Signal(str)
    interval_edited = Signal(float, float)
    velocity_rule_chosen = Signal(object)
    acceleration_rule_chosen = Signal(object)
    reset_requested = Signal()
    refused = Signal(str)

    def __init__(self, view: CurveView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("curveSettings")
        self._view = view
        # The field that was typed in last.
        self._entry: FieldEdit | None = None
        self._refusal = ""
        self.name_edit = FieldEdit("curveName", "Name of the curve", "Name of the curve (Enter to set)")
        self.start_edit = self._interval_edit(
            "intervalStart", "Start of the interval", "t of the first point"
        )
        self.end_edit = self._interval_edit(
            "intervalEnd",
            "End of the interval",
            "t of the last point (of a closed curve: of its return to the first)",
        )
        self.velocity_box = _rule_box("velocityRule", "Velocity rule", VelocityRule)
        self.acceleration_box = _rule_box("accelerationRule", "Acceleration rule", AccelerationRule)
        self.reset_button = tool_button(
            "resetAllToEstimated",
            "Reset all velocities and accelerations to estimated",
            "Let the rules estimate every velocity and acceleration again",
            text="Reset all to estimated",
            icon_size=ICON,
        )
        self._facts = _note("curveFacts")
        self._problem = _note("curveProblem")
        self._lay_out()
        self._connect()
        self._render_theme()
        self._render()

    @staticmethod
    def _interval_edit(name: str, label: str, what: str) -> NumberEdit:
        tip = f"{label}, the {what}; the curve keeps its shape (a number or an expression, Enter to set)"
        return NumberEdit(name, label, tip)

    def _lay_out(self) -> None:
        interval = QHBoxLayout()
        interval.setSpacing(6)
        interval.addWidget(self.start_edit, 1)
        interval.addWidget(Label("to"))
        interval.addWidget(self.end_edit, 1)
        self._form = QFormLayout()
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self._form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        self._form.setHorizontalSpacing(12)
        self._form.setVerticalSpacing(8)
        self._form.addRow("Name", self.name_edit)
        self._form.addRow("Interval of t", interval)
        self._form.addRow("Velocities", self.velocity_box)
        self._form.addRow("Accelerations", self.acceleration_box)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 12, 12, 12)
        layout.setSpacing(10)
        layout.addLayout(self._form)
        layout.addWidget(self.reset_button, 0, Qt.AlignmentFlag.AlignLeft)
        layout.addWidget(self._problem)
        layout.addWidget(self._facts)
        layout.addStretch(1)

    def _connect(self) -> None:
        self.name_edit.committed.connect(self._rename)
        for edit in (self.start_edit, self.end_edit):
            edit.entered.connect(partial(self._set_interval, edit))
            edit.refused.connect(partial(self._refuse_text, edit))
            edit.left.connect(self._clear_refusal)
        self.name_edit.left.connect(self._clear_refusal)
        self.velocity_box.activated.connect(
            lambda row: self.velocity_rule_chosen.emit(list(VelocityRule)[row])
        )
        self.acceleration_box.activated.connect(
            lambda row: self.acceleration_rule_chosen.emit(list(AccelerationRule)[row])
        )
        self.reset_button.clicked.connect(self.reset_requested)

    # Rendering: nothing here writes back

    def render_view(self, view: CurveView) -> None:
        """Show `view`; hidden, when shown again."""
        if view.source != self._view.source:
            self._refusal = ""  # it was about another curve
        self._view = view
        if self.isVisible():
            self._render()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._render()

    def _render(self) -> None:
        curve, mark = self._view.source, decimal_mark()
        start, end = edits.interval(curve)
        self.name_edit.show_text(curve.name)
        for edit, value in ((self.start_edit, start), (self.end_edit, end)):
            edit.show_text(exact_text(value, mark).removesuffix(f"{mark}0"), number(value, 6, mark))
        self.velocity_box.setCurrentIndex(list(VelocityRule).index(curve.velocity_rule))
        self.acceleration_box.setCurrentIndex(list(AccelerationRule).index(curve.acceleration_rule))
        derivatives = curve.family.derivatives
        self._form.setRowVisible(self.velocity_box, derivatives > 0)
        self._form.setRowVisible(self.acceleration_box, derivatives > 1)
        self.reset_button.setVisible(bool(orders_set(self._view)))
        self._facts.setText(_facts(self._view))
        self._render_problem()

    def _render_problem(self) -> None:
        # Nothing is wrong with a curve that is yet to be begun.
        text = self._refusal or (self._view.problem if self._view.source.points else "")
        self._problem.setText(f"⚠ {text}" if text else "")
        self._problem.setVisible(bool(text))

    def _render_theme(self) -> None:
        theme = theme_of(self.palette())
        self._facts.setStyleSheet(f"color: {theme.muted.name()}")
        self._problem.setStyleSheet(f"color: {theme.warning.name()}")
        self.reset_button.setIcon(icon("reset", theme))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_form"):
            self._render_theme()

    # What the person did

    def _rename(self, text: str) -> None:
        self._entry = self.name_edit
        self._clear_refusal()
        self.name_edited.emit(text)
        self._render()

    def _set_interval(self, edit: NumberEdit, value: float) -> None:
        self._entry = edit
        self._clear_refusal()
        start, end = edits.interval(self._view.source)
        self.interval_edited.emit(*((value, end) if edit is self.start_edit else (start, value)))
        self._render()

    def _refuse_text(self, edit: NumberEdit, reason: str) -> None:
        self._entry = edit
        self.refuse(reason)
        self.refused.emit(reason)

    def refuse(self, reason: str) -> None:
        """Say why what was typed last cannot be taken, and leave the text to be mended."""
        self._refusal = reason
        if self._entry is not None:
            self._entry.keep()
        self._render_problem()

    def _clear_refusal(self) -> None:
        self._refusal = ""
        self._render_problem()


def orders_set(view: CurveView) -> set[int]:
    """Return which of the derivatives that the family has were set by the person somewhere."""
    is_set = np.any(~np.isnan(view.arrays.given[..., 0]), axis=(0, 1)).tolist()
    return {order for order in range(1, view.source.family.derivatives + 1) if is_set[order - 1]}


def _facts(view: CurveView) -> str:
    curve = view.source
    facts = [count_of(len(curve.points), "point")]
    if view.is_current and view.curve is not None:
        facts += [*_kind_facts(view.curve), *_shape_facts(view)]
        start, end = (number(t, 6, decimal_mark()) for t in view.curve.domain)
        facts.append(f"{start} ≤ t ≤ {end}")
    # A fact is not torn apart at the end of a line.
    return " · ".join(fact.replace(" ", "\N{NO-BREAK SPACE}") for fact in facts)


def _kind_facts(curve: CoreCurve) -> list[str]:
    """Return the degree, and of how many polynomials the curve is made."""
    if curve.degree is None:
        return ["no polynomial"]
    pieces = len(curve.breaks) - 1
    return [
        f"degree {curve.degree}",
        "one polynomial" if curve.is_one_polynomial else count_of(pieces, "piece"),
    ]


def _shape_facts(view: CurveView) -> list[str]:
    """Return whether the curve is closed, and how many corners it has."""
    facts = ["closed"] if view.source.is_closed else []
    corners = view.corners
    return [*facts, count_of(len(corners), "corner")] if corners else facts


def _rule_box(name: str, label: str, rules: Iterable[NamedEnum]) -> QComboBox:
    box = QComboBox()
    box.setObjectName(name)
    box.setAccessibleName(label)
    box.setToolTip(f"{label}: how those that nobody set are estimated")
    box.addItems([each.label for each in rules])
    box.setMinimumContentsLength(8)
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    return box


def _note(name: str) -> Label:
    label = Label()
    label.setObjectName(name)
    label.setWordWrap(True)
    return label
