"""The numbers of the forms that are chosen: a rectangle's own width and height and its radii."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import get_args

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QWidget

from ...document.expression import ExpressionError
from ...document.form import Form, FormField
from ...document.forms import AnyForm
from ...document.words import number
from ...qt.labels import Label
from ...widgets.boxes import row_of
from ...widgets.field_edit import NumberEdit, read_number
from ...widgets.number_text import field_text, typed_text
from ...widgets.percent_field import MIXED

_BESIDE = 2
"""Fields that have room beside each other for numbers such as 210.25 mm."""

ReadLength = Callable[[Callable[[], float], str], float]
"""Returns the length that a text means, by what tells the one that there is now."""


class FormRow(QWidget):
    """A row of fields for each kind of form; that of those which are chosen is seen.

    Signals
    -------
    number_entered
        A number of the forms shall be another one: its field, and the number.
    """

    number_entered = Signal(object, float)

    def __init__(self, read_length: ReadLength) -> None:
        super().__init__()
        self._read_length = read_length
        self._forms: Sequence[AnyForm] = ()
        self._rows = {kind: _Row(kind, self._edit) for kind in get_args(AnyForm)}
        row_of(*self._rows.values(), spacing=0, margins=(0, 0, 0, 0), parent=self)
        self.render_forms((), "")

    @property
    def edits(self) -> list[NumberEdit]:
        """All fields."""
        return [edit for row in self._rows.values() for _, edit in row.edits]

    def _edit(self, kind: type[Form], field: FormField) -> NumberEdit:
        name = f"form{kind.noun.title()}{field.name.title().replace('_', '')}"
        how = "a number or an expression" + (", with a unit or without" if field.is_length else "")
        how += ", or per cent of the whole, as 50%" if field.share else ""
        edit = NumberEdit(
            name, field.words, f"{field.words}: {how} (Enter to set)", partial(self._read, field)
        )
        edit.entered.connect(lambda entered: self.number_entered.emit(*entered))
        return edit

    def _read(self, field: FormField, text: str) -> tuple[FormField, float]:
        """Return the number of a form that a text means: which, and what it is."""
        if field.share and text.rstrip().endswith("%"):
            return field.as_share, read_number(text.rstrip()[:-1]) / 100
        if not field.is_length:
            return field, _within(field, text)
        return field, self._read_length(partial(self._number, field.name), text)

    def _number(self, name: str) -> float:
        return float(getattr(self._forms[0], name)) if self._forms else 0.0

    def render_forms(self, forms: Sequence[AnyForm], problem: str) -> None:
        """Show the numbers of forms of one kind; nothing where there is none."""
        self._forms = forms
        for kind, row in self._rows.items():
            is_seen = bool(forms) and type(forms[0]) is kind
            row.setVisible(is_seen)
            row.show_fields(forms if is_seen else ())
            for field, edit in row.edits if is_seen else ():
                _show(edit, field, forms)
                edit.setEnabled(not problem)
        self.setVisible(bool(forms))


def _show(edit: NumberEdit, field: FormField, forms: Sequence[AnyForm]) -> None:
    """Show a number of some forms: as the share that it is, if it is one."""
    are_shares = {bool(field.share) and form.has_number(field.share) for form in forms}
    name = field.share if True in are_shares else field.name
    first, *others = (float(getattr(form, name)) for form in forms)
    if len(are_shares) > 1 or any(other != first for other in others):
        edit.show_text(MIXED)
    elif True in are_shares:
        edit.show_text(f"{typed_text(100 * first)}%", f"{field_text(100 * first)}%")
    elif field.is_length:
        edit.show_length(first)
    else:
        edit.show_number(first)


def _within(field: FormField, text: str) -> float:
    """Return the number that a text means.

    Raises
    ------
    ExpressionError
        If it is none, or not within the limits of a field.
    """
    value = read_number(text)
    if field.limits is not None and not field.limits[0] <= value <= field.limits[1]:
        least, most = map(number, field.limits)
        raise ExpressionError(f"{field.words.partition(';')[0]}: from {least} to {most}.")
    return value


class _Row(QWidget):
    """The fields of a kind of form."""

    def __init__(self, kind: type[Form], make: Callable[[type[Form], FormField], NumberEdit]) -> None:
        super().__init__()
        self.edits = [(field, make(kind, field)) for field in kind.fields]
        self._labels = list[Label]()
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(6)
        grid.addWidget(Label(kind.noun.title()), 0, 0)
        for at, (field, edit) in enumerate(self.edits):
            row, place = divmod(at, _BESIDE)
            self._labels.append(label := Label(field.label))
            for column, part in enumerate((label, edit), 1 + 2 * place):
                grid.addWidget(part, row, column)
                grid.setColumnStretch(column, int(part is edit))

    def show_fields(self, forms: Sequence[AnyForm]) -> None:
        """Show the fields of the numbers that all of some forms have."""
        for label, (field, edit) in zip(self._labels, self.edits, strict=True):
            for part in (label, edit):
                part.setVisible(all(form.has_number(field.name) for form in forms))
