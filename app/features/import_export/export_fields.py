"""Widgets for the options of an export: a field for each kind of option."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import singledispatch
from typing import Any, Generic

from PySide6.QtWidgets import QCheckBox, QComboBox, QGridLayout, QWidget

from ...document.expression import ExpressionError, parse_number
from ...exchange.options import Check, OneOf, Option, Real, SomeOf, Value, Whole
from ...widgets.controls import check_box, choice_box
from ...widgets.fields import FieldEdit, RangedSpinBox
from ...widgets.number_text import decimal_mark, exact_text

_AUTOMATIC = "automatic"


class Field(ABC, Generic[Value]):
    """A widget that shows the value of an option.

    Attributes
    ----------
    widget
        The widget.
    """

    widget: QWidget

    @abstractmethod
    def value(self) -> Value:
        """Return what the person chose."""

    @abstractmethod
    def show(self, value: Value) -> None:
        """Show a value."""

    def problem(self) -> str:
        """Return why the value cannot be used; empty where it can."""
        return ""


@singledispatch
def field_for(option: Option[Any], _change: Callable[[], object]) -> Field[Any]:
    """Return a field for an option; `change` is called when the person chooses something else."""
    raise NotImplementedError(f"{type(option).__name__} has no field")


@field_for.register(Check)
class CheckField(Field[bool]):
    """A check box."""

    widget: QCheckBox

    def __init__(self, option: Check, change: Callable[[], object]) -> None:
        self.widget = _check(option.widget, option.title, option.tip, change)

    def value(self) -> bool:
        """Return what the person chose."""
        return self.widget.isChecked()

    def show(self, value: bool) -> None:
        """Show a value."""
        self.widget.setChecked(value)


@field_for.register(Whole)
class WholeField(Field[int]):
    """A spin box that says which numbers are possible."""

    widget: RangedSpinBox

    def __init__(self, option: Whole, change: Callable[[], object]) -> None:
        self.widget = RangedSpinBox(option.widget, option.title, option.tip, option.limits)
        self.widget.setKeyboardTracking(False)
        self.widget.setSuffix(option.suffix)
        # Numbers have no signal of the person's alone; what the program sets is the same as before.
        self.widget.valueChanged.connect(change)

    def value(self) -> int:
        """Return what the person chose."""
        return self.widget.value()

    def show(self, value: int) -> None:
        """Show a value."""
        self.widget.setValue(value)

    def problem(self) -> str:
        """Return why the value cannot be used."""
        return str(self.widget.problem)


@field_for.register(OneOf)
class OneOfField(Field[Any]):
    """A box with the titles of the choices."""

    widget: QComboBox

    def __init__(self, option: OneOf[Any], change: Callable[[], object]) -> None:
        self._choices = list(option.choices)
        self.widget = choice_box(option.widget, option.title, option.tip, list(option.choices.values()))
        self.widget.activated.connect(change)

    def value(self) -> Any:  # noqa: ANN401 - of the option's own type
        """Return what the person chose."""
        return self._choices[self.widget.currentIndex()]

    def show(self, value: Any) -> None:  # noqa: ANN401
        """Show a value."""
        self.widget.setCurrentIndex(self._choices.index(value))


@field_for.register(SomeOf)
class SomeOfField(Field[tuple[str, ...]]):
    """A check box for each choice."""

    def __init__(self, option: SomeOf, change: Callable[[], object]) -> None:
        self._needed = option.needed
        self.checks = {
            each: _check(option.widget.format(each), each, option.tip.format(each), change)
            for each in option.choices
        }
        self.widget = in_columns(list(self.checks.values()), 3)

    def value(self) -> tuple[str, ...]:
        """Return what the person chose."""
        return tuple(each for each, check in self.checks.items() if check.isChecked())

    def show(self, value: tuple[str, ...]) -> None:
        """Show a value."""
        for each, check in self.checks.items():
            check.setChecked(each in value)

    def problem(self) -> str:
        """Return why the value cannot be used."""
        return "" if self.value() else self._needed


@field_for.register(Real)
class RealField(Field[float | None]):
    """A field for a number, or “automatic” where there need not be one."""

    widget: FieldEdit

    def __init__(self, option: Real, change: Callable[[], object]) -> None:
        self._option, self._value, self._change = option, option.default, change
        self.widget = FieldEdit(option.widget, option.title, option.tip)
        self.widget.committed.connect(self._type)

    def value(self) -> float | None:
        """Return what the person chose."""
        return self._value

    def show(self, value: float | None) -> None:
        """Show a value."""
        self._value = value
        self.widget.show_text(_AUTOMATIC if value is None else exact_text(value, decimal_mark()))

    def _type(self, text: str) -> None:
        try:
            self.show(self._number(text))
        except ExpressionError:
            self.widget.keep()
        else:
            self._change()

    def _number(self, text: str) -> float | None:
        if self._option.default is None and text.strip().casefold() in ("", _AUTOMATIC):
            return None
        value = parse_number(text, decimal_mark())
        if self._option.checked(value) != value:
            raise ExpressionError("It is beyond the limits.")
        return value


def _check(name: str, text: str, tip: str, change: Callable[[], object]) -> QCheckBox:
    check = check_box(name, text, tip)
    check.clicked.connect(change)
    return check


def in_columns(widgets: Sequence[QWidget], count: int) -> QWidget:
    """Return widgets side by side, `count` in a row."""
    holder = QWidget()
    grid = QGridLayout(holder)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(14)
    for place, widget in enumerate(widgets):
        grid.addWidget(widget, place // count, place % count)
    return holder
