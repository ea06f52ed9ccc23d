"""The form of the active curve: name, interval of t, rules, and the settings of its family."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QComboBox, QFormLayout, QLayout, QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...document import curve_edits, rule_edits
from ...document.derivatives import DERIVATIVES, Derivative, EstimateRule
from ...document.model import Document
from ...document.selection import NONE_SELECTED
from ...document.words import count_of, digits_of_range, number, with_minus
from ...families import FamilySetting, SettingValue
from ...qt.labels import MUTED, Label
from ...view_model.curve.curve_view import CurveView, ParametricCurve
from ...view_model.point_kinds import jolts_of
from ...widgets.boxes import column_of, form_of, row_of
from ...widgets.controls import ICON, choice_box, named, tool_button
from ...widgets.fields import FieldEdit, FieldForm, NumberEdit
from ...widgets.number_text import decimal_mark
from ...widgets.sliders import LiveSlider

_FIELD_WIDTH = 56
"""Width in pixels of the field of a number; the slider fills the rest of the row."""

_DIGITS = 4
"""Significant digits of a real number in a field without the focus."""


def step_of(setting: FamilySetting, value: SettingValue) -> str:
    """Return the name of the undo step: Set degree of blending to 5."""
    text = setting.text_of(value)
    return f"Set {setting.title} to {text if isinstance(value, str) else with_minus(text)}"


def _widget_name(setting: FamilySetting) -> str:
    return "setting" + "".join(word.capitalize() for word in setting.name.split("_"))


class NumberField:
    """A number, whole or real: typed, or set by a slider that moves by steps of the setting.

    Attributes
    ----------
    edit, slider
        The field, and the slider, whose positions count steps from the smallest number.
    row, entry
        The row in the form, and the widget to focus.
    """

    def __init__(self, setting: FamilySetting, limits: tuple[float, float]) -> None:
        name, label = _widget_name(setting), setting.label
        self._setting, (self._least, self._most) = setting, limits
        self._step = setting.step or (1 if setting.is_whole else (self._most - self._least) / 100)
        reach = with_minus(" to ".join(map(setting.text_of, limits)))
        self.edit = NumberEdit(name, label, f"{setting.tip} ({reach}, Enter to set)".strip())
        self.edit.setFixedWidth(_FIELD_WIDTH)
        slider = LiveSlider()
        tip = f"{setting.tip} ({reach}; Escape cancels a drag)".strip()
        self.slider = named(slider, f"{name}Slider", f"{label}, slider", tip)
        # The last step is shorter where the limits are not a whole number of steps apart.
        self.slider.setRange(0, math.ceil(round((self._most - self._least) / self._step, 9)))
        self.slider.setPageStep(1)
        self._value: SettingValue | None = setting.default
        self.slider.drag_ended.connect(self._show)
        self.row: QLayout = row_of(self.edit, (self.slider, 1), spacing=8)
        self.entry: QWidget = self.edit

    def render_value(self, value: SettingValue | None) -> None:
        """Show `value`, or none; the handle of a dragged slider stays where it is."""
        self._value = value
        self._show()

    def value_at(self, position: int) -> SettingValue:
        """Return the number at a position of the slider."""
        # Twelve digits: 3 steps of 0.05 are 0.15.
        value = min(float(f"{self._least + position * self._step:.12g}"), self._most)
        return int(value) if self._setting.is_whole else value

    def _show(self) -> None:
        if not isinstance(self._value, int | float):
            self.edit.show_text("")
            return
        self.edit.show_number(self._value, None if self._setting.is_whole else _DIGITS)
        if not self.slider.isSliderDown():
            is_most = self._value == self._most
            steps = round((self._value - self._least) / self._step)
            self.slider.setValue(self.slider.maximum() if is_most else steps)


class ChoiceField:
    """A box of choices.

    Attributes
    ----------
    row, entry
        The box.
    """

    def __init__(self, setting: FamilySetting) -> None:
        self._values = [value for value, _ in setting.choices]
        labels = (text for _, text in setting.choices)
        self.box = choice_box(_widget_name(setting), setting.label, setting.tip, labels)
        self.row = self.entry = self.box

    def render_value(self, value: SettingValue | None) -> None:
        """Show `value`, or no choice for a value that the setting does not have."""
        self.box.setCurrentIndex(self._values.index(str(value)) if value in self._values else -1)

    def value_at(self, row: int) -> SettingValue:
        """Return the value of a row of the box."""
        return self._values[row]


class SettingFields(QObject):
    """The rows of a form for the settings of the curve's family.

    Signals
    -------
    chosen
        A value was typed or chosen: (setting, value).
    rebuilt
        There are other fields now, without connections to their signals.

    Attributes
    ----------
    numbers
        The fields of numbers, by their settings.
    """

    chosen = Signal(object, object)
    rebuilt = Signal()

    def __init__(self, form: QFormLayout, first_row: int, parent: QWidget) -> None:
        super().__init__(parent)
        self._form, self._first_row = form, first_row
        self._fields: dict[FamilySetting, NumberField | ChoiceField] = {}

    @property
    def numbers(self) -> dict[FamilySetting, NumberField]:
        """The fields of numbers, by their settings."""
        return {setting: field for setting, field in self._fields.items() if isinstance(field, NumberField)}

    def render_view(self, view: CurveView) -> None:
        """Show the settings of a curve, with the fields of its family."""
        settings, closed = view.source.family.settings, view.source.is_closed
        if settings.all != tuple(self._fields):
            self._rebuild(settings.all)
        for setting, value in settings.values(view.source.settings_in_effect).items():
            self._fields[setting].render_value(value)
            self._fields[setting].row.setEnabled(not (closed and setting.when_closed is not None))

    def render_none(self) -> None:
        """Show no values: no curve is selected."""
        for field in self._fields.values():
            field.render_value(None)

    def focus(self, setting: FamilySetting) -> None:
        """Focus the field of a setting."""
        if (field := self._fields.get(setting)) is not None:
            field.entry.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _rebuild(self, settings: tuple[FamilySetting, ...]) -> None:
        for _ in self._fields:
            self._form.removeRow(self._first_row)
        self._fields = {
            setting: NumberField(setting, setting.limits) if setting.limits else ChoiceField(setting)
            for setting in settings
        }
        for row, (setting, field) in enumerate(self._fields.items(), start=self._first_row):
            self._form.insertRow(row, setting.label, field.row)
        self.rebuilt.emit()
        for setting, field in self._fields.items():
            self._connect(setting, field)

    def _connect(self, setting: FamilySetting, field: NumberField | ChoiceField) -> None:
        if isinstance(field, ChoiceField):
            field.box.activated.connect(lambda row: self.chosen.emit(setting, field.value_at(row)))
        else:
            field.edit.entered.connect(
                lambda value: self.chosen.emit(setting, _whole(value) if setting.is_whole else value)
            )


def _whole(value: float) -> float | int:
    """Return whole numbers as integers: 3 for 3.0."""
    return int(value) if value == int(value) else value


_SETTINGS_ROW = 2
"""The row of the form at which the settings of the family begin."""


class CurveSettings(FieldForm):
    """Form of the curve of a view, or of no curve, which requests changes of the curve.

    Attributes
    ----------
    settings
        The fields of the family's settings.
    """

    def __init__(self, view: CurveView | None, parent: QWidget | None = None) -> None:
        super().__init__("curveSettings", "curveProblem", parent)
        self._view = view
        self._fields = QWidget()
        self.name_edit = FieldEdit("curveName", "Name of the curve", "Name of the curve (Enter to set)")
        self.start_edit = _interval_edit("intervalStart", "Start of the interval", "t of the first point")
        self.end_edit = _interval_edit(
            "intervalEnd",
            "End of the interval",
            "t of the last point (for a closed curve, of the return to the first)",
        )
        self.rule_boxes = {derivative: _rule_box(derivative) for derivative in DERIVATIVES}
        self.reset_button = tool_button(
            "resetAllToEstimated",
            "Reset All to Estimate",
            "Reset every derivative to the estimates of the rules",
            text="Reset All to Estimate",
            icon_size=ICON,
        )
        self._facts = Label(name="curveFacts", wordWrap=True, role=MUTED)
        self._lay_out()
        self._connect()
        self.follow_theme()
        self._render()

    def _lay_out(self) -> None:
        interval = row_of((self.start_edit, 1), "to", (self.end_edit, 1), spacing=6)
        self._form = form_of(
            ("Name", self.name_edit),
            ("Interval of t", interval),
            *((derivative.plural.capitalize(), box) for derivative, box in self.rule_boxes.items()),
            margins=0,
            parent=self._fields,
        )
        self.settings = SettingFields(self._form, _SETTINGS_ROW, self)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self._form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        reset = (self.reset_button, Qt.AlignmentFlag.AlignLeft)
        column_of(self._fields, reset, self.problem, self._facts, 1, margins=12, spacing=10, parent=self)

    def _connect(self) -> None:
        self.watch(self.name_edit, self.start_edit, self.end_edit)
        self.name_edit.committed.connect(self._rename)
        self.start_edit.entered.connect(lambda start: self._set_interval(start, None))
        self.end_edit.entered.connect(lambda end: self._set_interval(None, end))
        for derivative, box in self.rule_boxes.items():
            box.activated.connect(partial(self._set_rule, derivative))
        self.settings.chosen.connect(self._choose_setting)
        self.settings.rebuilt.connect(self._watch_settings)

    def _watch_settings(self) -> None:
        self.forget_entry()
        self.watch(*(field.edit for field in self.settings.numbers.values()))

    # Rendering: nothing here changes the document

    def render_view(self, view: CurveView | None) -> None:
        """Show `view`, or that no curve is selected (None); a hidden form waits until it is shown."""
        if view is None or self._view is None or view.source != self._view.source:
            self.clear_refusal()
        self._view = view
        if self.isVisible():
            self._render()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self._render()

    def _render(self) -> None:
        self._fields.setEnabled(self._view is not None)
        if self._view is None:
            for edit in (self.name_edit, self.start_edit, self.end_edit):
                edit.show_text("")
            for box in self.rule_boxes.values():
                box.setCurrentIndex(-1)
            self.settings.render_none()
            self.reset_button.setVisible(False)
            self._facts.setText(NONE_SELECTED)
            self.show_problem("")
        else:
            self._render_curve(self._view)

    def _render_curve(self, view: CurveView) -> None:
        curve = view.source
        interval = curve.interval
        self.name_edit.show_text(curve.name)
        for edit, value in zip((self.start_edit, self.end_edit), interval, strict=True):
            edit.show_number(value, digits_of_range(*interval))
        self.settings.render_view(view)
        for derivative, box in self.rule_boxes.items():
            rule = getattr(curve, derivative.rule_field)
            box.setCurrentIndex(list(derivative.rules).index(rule))
            if (tip := f"{_rule_tip(derivative)}\n{rule.label}: {rule.tip}") != box.toolTip():
                box.setToolTip(tip)
            has_rule = derivative.order <= curve.family.derivatives
            if self._form.isRowVisible(box) != has_rule:
                # Only when it changes: Qt lays the form out anew in any case.
                self._form.setRowVisible(box, has_rule)
        self.reset_button.setVisible(bool(orders_set(view)))
        self._facts.setText(_facts(view))
        # A curve without points is no problem.
        self.show_problem(view.problem if curve.points else "")

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self.reset_button.setIcon(icon("reset", theme))

    # Actions of the user

    def _rename(self, name: str) -> None:
        self.edited.emit(
            "Rename curve", lambda document, curve: curve_edits.rename_curve(document, curve, name)
        )
        self._render()

    def _set_interval(self, start: float | None, end: float | None) -> None:
        def edit(document: Document, curve: int) -> Document:
            before = document.curves[curve].interval
            return rule_edits.set_interval(
                document, curve, before[0] if start is None else start, before[1] if end is None else end
            )

        self.edited.emit("Set interval", edit)
        self._render()

    def _set_rule(self, derivative: Derivative, row: int) -> None:
        rule = list(derivative.rules)[row]
        self.edited.emit(
            choice_of(derivative, rule), lambda document, curve: rule_edits.set_rule(document, curve, rule)
        )

    def _choose_setting(self, setting: FamilySetting, value: SettingValue) -> None:
        self.edited.emit(
            step_of(setting, value),
            lambda document, curve: rule_edits.set_family_setting(document, curve, setting.name, value),
        )
        self._render()


def orders_set(view: CurveView) -> set[int]:
    """Return the orders of derivatives of the family that are set at any point."""
    is_set = np.any(~np.isnan(view.arrays.given[..., 0]), axis=(0, 1)).tolist()
    return {order for order in range(1, view.source.family.derivatives + 1) if is_set[order - 1]}


def _facts(view: CurveView) -> str:
    curve = view.source
    facts = [count_of(len(curve.points), curve.family.point)]
    if view.is_current and view.curve is not None:
        facts += [*_kind_facts(view.curve), *_shape_facts(view)]
        domain = view.curve.domain
        start, end = (number(t, digits_of_range(*domain), decimal_mark()) for t in domain)
        facts.append(f"{start} ≤ t ≤ {end}")
    # No line break within a fact.
    return " · ".join(fact.replace(" ", "\N{NO-BREAK SPACE}") for fact in facts)


def _kind_facts(curve: ParametricCurve) -> list[str]:
    """Return the degree and the number of polynomials of the curve, or the kind of its functions."""
    if curve.degree is None:
        return [curve.kind] if curve.kind else []
    pieces = len(curve.breaks) - 1
    return [f"degree {curve.degree}", "one polynomial" if pieces == 1 else count_of(pieces, "piece")]


def _shape_facts(view: CurveView) -> list[str]:
    """Return facts on the shape: closed or not, the number of corners and of other points with two sides."""
    facts = ["closed"] if view.source.is_closed else []
    others = len(jolts_of(view))
    corners = len(view.corners) - others
    facts += [count_of(corners, "corner")] if corners else []
    smooth = len(view.two_sided) - len(view.corners)
    facts += [f"{smooth} smooth"] if smooth else []
    return [*facts, f"{count_of(others, 'point')} with two sides"] if others else facts


def _interval_edit(name: str, label: str, meaning: str) -> NumberEdit:
    tip = f"{label}, the {meaning}; the curve keeps its shape (a number or an expression, Enter to set)"
    return NumberEdit(name, label, tip)


def choice_of(of: Derivative, rule: EstimateRule) -> str:
    """Return the name of the undo step: Choose velocity rule “Akima”."""
    return f"Choose {of.name} rule “{rule.label}”"


def _rule_tip(of: Derivative) -> str:
    return f"{of.name.capitalize()} rule: estimates the values that are not set"


def _rule_box(of: Derivative) -> QComboBox:
    label, tip = f"{of.name.capitalize()} rule", _rule_tip(of)
    rules = list(of.rules)
    box = choice_box(
        f"{of.name}Rule", label, tip, (rule.label for rule in rules), (rule.tip for rule in rules)
    )
    box.setMinimumContentsLength(8)
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    return box
