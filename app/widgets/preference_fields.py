"""Fields of the dialog of preferences: one for each kind of setting that has a label."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Sequence
from functools import singledispatch
from typing import Any, Generic

from PySide6.QtCore import Qt
from PySide6.QtGui import QFocusEvent, QMouseEvent
from PySide6.QtWidgets import QCheckBox, QLineEdit, QWidget

from ..document.expression import ExpressionError
from ..document.words import NamedEnum
from ..qt.labels import WARNING, Label
from ..qt.overrides import SafeOverrides
from ..settings.kinds import Choice, Distance, Setting, Several, Switch, Text, Value, WholeNumber
from .boxes import in_columns
from .controls import check_box, choice_box
from .fields import NumberEdit, RangedSpinBox, read_number
from .number_text import typed_text

Change = Callable[[Any], object]
"""Called with the value that the user has chosen."""


class PreferenceField(ABC, Generic[Value]):
    """Rows of the dialog that show the value of a setting.

    Attributes
    ----------
    rows
        Rows of the form: labels and widgets.
    """

    rows: Sequence[tuple[str, QWidget]]

    @abstractmethod
    def show(self, value: Value) -> None:
        """Show a value."""


@singledispatch
def field_of(setting: Setting[Any], _change: Change) -> PreferenceField[Any]:
    """Return a field for a setting."""
    raise NotImplementedError(f"{type(setting).__name__} has no field")


@field_of.register(Choice)
class ChoicePreference(PreferenceField[NamedEnum]):
    """A box with the labels of an enumeration."""

    def __init__(self, setting: Choice[NamedEnum], change: Change) -> None:
        self._members = list(type(setting.default))
        labels = (member.label for member in self._members)
        self._box = choice_box(setting.widget, setting.label, setting.tip, labels)
        self._box.activated.connect(lambda row: change(self._members[row]))
        self.rows = [(setting.label, self._box)]

    def show(self, value: NamedEnum) -> None:
        """Show a value."""
        self._box.setCurrentIndex(self._members.index(value))


@field_of.register(Switch)
class SwitchPreference(PreferenceField[bool]):
    """A check box."""

    def __init__(self, setting: Switch, change: Change) -> None:
        self._check = check_box(setting.widget, setting.label, setting.tip, setting.label)
        self._check.clicked.connect(lambda checked: change(checked))  # noqa: PLW0108 - Qt hands a partial no argument
        self.rows = [("", self._check)]

    def show(self, value: bool) -> None:
        """Show a value."""
        self._check.setChecked(value)


@field_of.register(WholeNumber)
class WholeNumberPreference(PreferenceField[int]):
    """A spin box."""

    def __init__(self, setting: WholeNumber, change: Change) -> None:
        self._value, self._change = setting.default, change
        self._box = RangedSpinBox(setting.widget, setting.label, setting.tip, setting.limits)
        self._box.setRange(*setting.limits)
        # A number that is being typed does not count yet.
        self._box.setKeyboardTracking(False)
        self._box.valueChanged.connect(self._choose)
        self.rows = [(setting.label, self._box)]

    def show(self, value: int) -> None:
        """Show a value."""
        self._value = value
        self._box.setValue(value)

    def _choose(self, value: int) -> None:
        if value != self._value:
            self._value = value
            self._change(value)


@field_of.register(Several)
class SeveralPreference(PreferenceField[Collection[NamedEnum]]):
    """A check box for each member of an enumeration, in two columns."""

    def __init__(self, setting: Several[NamedEnum], change: Change) -> None:
        self._value, self._change = frozenset[NamedEnum](), change
        self._checks = {member: _check_of(setting, member) for member in setting.kind}
        for member, check in self._checks.items():
            check.clicked.connect(lambda _checked, member=member: self._switch(member))
        self.rows = [(setting.label, in_columns(list(self._checks.values()), 2))]

    def _switch(self, member: NamedEnum) -> None:
        self._value ^= {member}
        self._change(self._value)

    def show(self, value: Collection[NamedEnum]) -> None:
        """Show a value."""
        self._value = frozenset(value)
        for member, check in self._checks.items():
            check.setChecked(member in value)


class _WholeTextEdit(SafeOverrides, QLineEdit):
    """A line whose text is selected by the click that focuses it, so that typing replaces the text.

    Otherwise typing in the box would continue the word that is chosen.
    """

    _is_entered = False

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._is_entered = event.reason() == Qt.FocusReason.MouseFocusReason

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        # A drag has selected a part of the text.
        if self._is_entered and not self.hasSelectedText():
            self.selectAll()
        self._is_entered = False


@field_of.register(Text)
class TextPreference(PreferenceField[str]):
    """A box with the usual texts, of which the first stands for none; others may be typed."""

    def __init__(self, setting: Text, change: Change) -> None:
        self._setting, self._none, self._change, self._value = setting, setting.usual[0], change, ""
        line = _WholeTextEdit(maxLength=setting.longest)
        self._box = choice_box(setting.widget, setting.label, setting.tip, setting.usual)
        self._box.setEditable(True)
        self._box.setLineEdit(line)
        self._box.textActivated.connect(self._choose)
        line.editingFinished.connect(lambda: self._choose(line.text()))
        self._note = Label(name=f"{setting.widget}Note", wordWrap=True)
        self._note.hide()
        self.rows = [(setting.label, self._box), ("", self._note)]

    def show(self, value: str) -> None:
        """Show a value and the note about it."""
        self._value = value
        self._box.setCurrentText(value or self._none)
        self._show_note(value)

    def _show_note(self, value: str) -> None:
        note = self._setting.note(value)
        self._note.show_text(note)

    def _choose(self, text: str) -> None:
        name = text.strip()
        name = "" if name == self._none else name
        if name != self._value:
            self._value = name
            self._show_note(name)
            self._change(name)


@field_of.register(Distance)
class DistancePreference(PreferenceField[float]):
    """A number, or the word for none, with a line below for problems."""

    def __init__(self, setting: Distance, change: Change) -> None:
        self._setting, self._change = setting, change
        self._edit = NumberEdit(setting.widget, setting.label, setting.tip, self._distance_of)
        self._problem = Label(name="preferencesProblem", wordWrap=True, role=WARNING)
        self._problem.hide()
        self._edit.entered.connect(self._enter)
        self._edit.refused.connect(self._problem.show_problem)
        self._edit.left.connect(lambda: self._problem.show_problem(""))
        self.rows = [(setting.label, self._edit), ("", self._problem)]

    def show(self, value: float) -> None:
        """Show a value."""
        self._edit.show_text(typed_text(value) if value else self._setting.none)

    def _distance_of(self, text: str) -> float:
        if text.strip().casefold() in ("", self._setting.none):
            return 0.0
        distance = read_number(text)
        if not distance > 0:
            raise ExpressionError(self._setting.refusal)
        return distance

    def _enter(self, distance: float) -> None:
        self._problem.show_problem("")
        self._change(distance)
        self.show(distance)


def _check_of(setting: Several[Any], member: NamedEnum) -> QCheckBox:
    text = member.label
    tip = setting.tip.format(f"{text[0].lower()}{text[1:]}")
    return check_box(setting.widget.format(member.value), text, tip)
