"""Fields for the settings of a family, made from their records: numbers with sliders, boxes of choices."""

from __future__ import annotations

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QFormLayout, QLayout, QWidget

from ...families import FamilySetting, SettingValue
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import row_of
from ...widgets.controls import choice_box, named
from ...widgets.fields import NumberEdit
from ...widgets.sliders import LiveSlider

_FIELD_WIDTH = 56
"""Pixels of the field of a whole number: the slider has the rest of the row."""


def step_of(setting: FamilySetting, value: SettingValue) -> str:
    """Return the name of a step in the history: Set degree of blending to 5."""
    return f"Set {setting.title} to {setting.text_of(value)}"


def _widget_name(setting: FamilySetting) -> str:
    return "setting" + "".join(word.capitalize() for word in setting.name.split("_"))


class NumberField:
    """A whole number: typed, or set by a slider.

    Attributes
    ----------
    edit, slider
        The field and the slider.
    row, entry
        What stands in the form, and what is typed into.
    """

    def __init__(self, setting: FamilySetting, limits: tuple[int, int]) -> None:
        name, label = _widget_name(setting), setting.label
        reach = f"({limits[0]} to {limits[1]}"
        self.edit = NumberEdit(name, label, f"{setting.tip} {reach}, Enter to set)".strip())
        self.edit.setFixedWidth(_FIELD_WIDTH)
        slider = LiveSlider()
        tip = f"{setting.tip} {reach}; Escape cancels a drag)".strip()
        self.slider = named(slider, f"{name}Slider", f"{label}, slider", tip)
        self.slider.setRange(*limits)
        self.slider.setPageStep(1)
        self._value: SettingValue | None = setting.default
        self.slider.drag_ended.connect(self._show)
        self.row: QLayout = row_of(self.edit, (self.slider, 1), spacing=8)
        self.entry: QWidget = self.edit

    def render_value(self, value: SettingValue | None) -> None:
        """Show `value`, or none; the handle of a slider that is being dragged stays where it is."""
        self._value = value
        self._show()

    def _show(self) -> None:
        self.edit.show_text("" if self._value is None else str(self._value))
        if not self.slider.isSliderDown() and isinstance(self._value, int):
            self.slider.setValue(self._value)


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
        """Show `value`; none also of a document whose family has become another one."""
        self.box.setCurrentIndex(self._values.index(str(value)) if value in self._values else -1)

    def value_at(self, place: int) -> SettingValue:
        """Return the value of a row of the box."""
        return self._values[place]


class SettingFields(QObject):
    """The rows of a form for the settings of the shown curve's family.

    Signals
    -------
    chosen
        A value was typed or chosen: its setting, and the value.
    rebuilt
        There are other fields now; nobody listens to them yet.

    Attributes
    ----------
    numbers
        The fields of whole numbers, by their settings.
    """

    chosen = Signal(object, object)
    rebuilt = Signal()

    def __init__(self, form: QFormLayout, place: int, parent: QWidget) -> None:
        super().__init__(parent)
        self._form, self._place = form, place
        self._fields: dict[FamilySetting, NumberField | ChoiceField] = {}

    @property
    def numbers(self) -> dict[FamilySetting, NumberField]:
        """The fields of whole numbers, by their settings."""
        return {setting: field for setting, field in self._fields.items() if isinstance(field, NumberField)}

    def render_view(self, view: CurveView) -> None:
        """Show the settings of a curve; its family decides which fields there are."""
        settings, closed = view.source.family.settings, view.source.is_closed
        if settings.all != tuple(self._fields):
            self._rebuild(settings.all)
        for setting, value in settings.values(view.source.settings_in_effect).items():
            self._fields[setting].render_value(value)
            self._fields[setting].row.setEnabled(not (closed and setting.when_closed is not None))

    def render_none(self) -> None:
        """Show no value: there is no curve to act on."""
        for field in self._fields.values():
            field.render_value(None)

    def focus(self, setting: FamilySetting) -> None:
        """Lead the person to the field of a setting."""
        if (field := self._fields.get(setting)) is not None:
            field.entry.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _rebuild(self, settings: tuple[FamilySetting, ...]) -> None:
        for _ in self._fields:
            self._form.removeRow(self._place)
        self._fields = {setting: _field_of(setting) for setting in settings}
        for place, (setting, field) in enumerate(self._fields.items(), start=self._place):
            self._form.insertRow(place, setting.label, field.row)
        self.rebuilt.emit()
        for setting, field in self._fields.items():
            self._connect(setting, field)

    def _connect(self, setting: FamilySetting, field: NumberField | ChoiceField) -> None:
        if isinstance(field, ChoiceField):
            field.box.activated.connect(lambda place: self.chosen.emit(setting, field.value_at(place)))
        else:
            field.edit.entered.connect(lambda value: self.chosen.emit(setting, _whole(value)))


def _field_of(setting: FamilySetting) -> NumberField | ChoiceField:
    return ChoiceField(setting) if setting.limits is None else NumberField(setting, setting.limits)


def _whole(value: float) -> float | int:
    """Return a number as a whole one where it is: 3 for 3.0."""
    return int(value) if value == int(value) else value
