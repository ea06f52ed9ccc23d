"""Export dialog: a format, its options with a field for each, and a preview of pictures."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import suppress
from functools import singledispatch
from itertools import groupby
from typing import TYPE_CHECKING, Any, Generic

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QColor, QImage, QPainter, QPixmap, QStandardItemModel
from PySide6.QtWidgets import QCheckBox, QComboBox, QWidget

from ...appearance.theme import DARK, LIGHT, mix
from ...document.expression import ExpressionError, parse_number
from ...document.lengths import known_unit
from ...document.model import Document, Paper
from ...exchange.errors import ExchangeError
from ...exchange.export_choice import ExportChoice, choice_with, offered_options
from ...exchange.formats import FORMATS
from ...exchange.options import (
    EXTENT,
    TOLERANCE,
    TRUE_SIZE,
    Check,
    Extent,
    OneOf,
    Option,
    Real,
    SomeOf,
    Value,
    Whole,
    automatic_tolerance,
)
from ...qt.labels import Label
from ...tasks.progress import Report
from ...tasks.task import DelayedCall
from ...widgets.boxes import column_of, form_of, in_columns, row_of
from ...widgets.controls import check_box, choice_box
from ...widgets.fields import FieldEdit, RangedSpinBox
from ...widgets.number_text import decimal_mark, typed_text
from .work_dialog import WorkDialog, buttons

if TYPE_CHECKING:
    from ...exchange.drawing.image import PicturePreview

_SOON_MS = 120
_WIDTH, _HEIGHT = 300, 260
_SQUARE = 8


class ExportDialog(WorkDialog):
    """Dialog for the options of an export; the file dialog follows.

    Signals
    -------
    export_requested
        Export was pressed: the `ExportChoice`.
    """

    export_requested = Signal(object)

    def __init__(self, choice: ExportChoice, parent: QWidget | None = None) -> None:
        super().__init__("exportDialog", "Export", "exportProblem", parent)
        self._document: Document | None = None
        self._active, self._selected, self._with_estimates = 0, frozenset[int](), False
        self.form = ExportForm()
        self.picture = Label(name="exportPreview", label="Preview")
        self.picture.setToolTip("Preview of the picture; a checkerboard means no background")
        self.picture.setFixedSize(_WIDTH, _HEIGHT)
        self.picture.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.size_label = Label(name="exportSize", wordWrap=True)
        self.size_label.setAlignment(Qt.AlignmentFlag.AlignHCenter)
        self.colour_note = Label(name="exportColoursTold", wordWrap=True)
        self._soon = DelayedCall(self, _SOON_MS, self._render_preview)
        self._lay_out()
        self.form.changed.connect(self._render)
        self.form.show_choice(choice)
        self._render()

    def _lay_out(self) -> None:
        foot, self.ok = buttons("Export…", "exportFile", "Choose where to save the file", "cancelExport")
        foot.accepted.connect(self._export)
        foot.rejected.connect(self.reject)
        self.preview_side = QWidget()
        column_of(self.picture, self.size_label, self.colour_note, 1, margins=0, parent=self.preview_side)
        columns = row_of((column_of(self.form, 1, margins=0), 1), self.preview_side, spacing=18)
        column_of(columns, margins=(16, 14, 16, 0), parent=self.body)
        self.hold(self.problem, foot, preferred=QSize(690, 440))

    def show_document(
        self,
        document: Document,
        active: int,
        selected: frozenset[int] = frozenset(),
        *,
        with_estimates: bool = False,
    ) -> None:
        """Show the preview of this document; for the parameters see `ExportChoice.request`."""
        self._document, self._active, self._selected = document, active, selected
        self._with_estimates = with_estimates
        self.form.show_document(document, has_selection=bool(selected))
        if (choice := self._choice()) is not None:
            self._show_automatic(choice)
        self._soon.start()

    def _choice(self) -> ExportChoice | None:
        """Return the choice that the form shows; None for one with a problem, which is shown."""
        with suppress(ExpressionError):
            return self.form.choice()
        return None

    def _show_automatic(self, choice: ExportChoice) -> None:
        """Show the number of the automatic tolerance of the curves to export."""
        if self._document is not None:
            part = choice.request(self._document, self._active, self._selected).document
            self.form.fields[TOLERANCE.name].show_automatic(automatic_tolerance(part))

    def _render(self) -> None:
        """Show the problem and the preview of the present choice."""
        try:
            choice = self.form.choice()
        except ExpressionError as reason:
            self.show_problem(str(reason))
            self.ok.setEnabled(False)
            return
        self.show_problem("")
        self._show_automatic(choice)
        self.ok.setEnabled(True)
        self.ok.setToolTip(f"Choose where to save the {choice.format.title}")
        self.preview_side.setVisible(choice.format.preview is not None)
        self._soon.start()

    def _render_preview(self) -> None:
        document, active = self._document, self._active
        self.jobs.cancel()
        if document is None or not self.preview_side.isVisible() or (choice := self._choice()) is None:
            return
        preview = choice.format.preview
        assert preview is not None
        order = choice.request(document, active, self._selected, with_estimates=self._with_estimates)
        room = (round(_WIDTH * self.devicePixelRatioF()), round(_HEIGHT * self.devicePixelRatioF()))

        def draw(_report: Report) -> PicturePreview:
            return preview(*order, room)

        self.jobs.start("Drawing", draw, self._show_preview, self._refuse)

    def _show_preview(self, preview: PicturePreview) -> None:
        if (choice := self._choice()) is None:
            return  # typed meanwhile
        # In the theme of the picture, not of this window.
        paper = self._document.paper if self._document is not None else Paper.THEME
        style = choice.style_on(paper)
        theme = DARK if style is not None and style.theme == DARK.name else LIGHT
        squares = (theme.paper, mix(theme.ink, theme.paper, 0.1))
        self.picture.setPixmap(_on_squares(preview.image, self.devicePixelRatioF(), squares))
        self.size_label.setText(preview.size)
        self.colour_note.setText(preview.colour_remark)
        self.show_problem("")
        self.ok.setEnabled(True)

    def _refuse(self, problem: Exception) -> None:
        if not isinstance(problem, ExchangeError):
            raise problem
        self.picture.clear()
        self.size_label.clear()
        self.colour_note.clear()
        self.show_problem(str(problem))
        self.ok.setEnabled(False)

    def _export(self) -> None:
        self.export_requested.emit(self.form.choice())
        self.accept()


def _on_squares(image: QImage, ratio: float, colours: tuple[QColor, QColor]) -> QPixmap:
    """Return a picture on a checkerboard that shows where it has no background."""
    image.setDevicePixelRatio(ratio)
    result = QPixmap(image.size())
    result.setDevicePixelRatio(ratio)
    result.fill(colours[0])
    painter = QPainter(result)
    side = image.deviceIndependentSize()
    for row in range(int(side.height() // _SQUARE) + 1):
        for column in range(row % 2, int(side.width() // _SQUARE) + 1, 2):
            painter.fillRect(column * _SQUARE, row * _SQUARE, _SQUARE, _SQUARE, colours[1])
    painter.drawImage(0, 0, image)
    painter.end()
    return result


# The form


class ExportForm(QWidget):
    """Boxes and fields for an `ExportChoice`.

    Signals
    -------
    changed
        The user changed a value.

    Attributes
    ----------
    fields
        Fields of the options of all formats, by the options' names.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("exportForm")
        self._choice, self._unit, self._paper = ExportChoice(), "", Paper.THEME
        self._formats = FORMATS.offered
        titles = [format.title for format in self._formats]
        self.format_box = choice_box("exportFormat", "Format", "Format of the file", titles)
        self.format_box.activated.connect(self._change)
        self._description = Label(name="exportDescription", wordWrap=True)
        self._options = offered_options()
        self.fields = {option.name: field_for(option, self._change) for option in self._options}
        self._rows: list[tuple[QWidget, tuple[Option[Any], ...]]] = []
        self._lay_out()

    def _lay_out(self) -> None:
        rows = (("Format", self.format_box), ("", self._description))
        self._form = form_of(*rows, margins=0, across=14, parent=self)
        for label, group in groupby(self._options, lambda option: option.label):
            options = tuple(group)
            widgets = [self.fields[option.name].widget for option in options]
            row = widgets[0] if len(widgets) == 1 else in_columns(widgets, 2, 14)
            self._form.addRow(label, row)
            self._rows.append((row, options))

    def show_choice(self, choice: ExportChoice) -> None:
        """Show these options, those that concern the format."""
        self.format_box.setCurrentIndex(self._formats.index(choice.format))
        for option in self._options:
            self.fields[option.name].show(choice[option])
        self._choice = choice
        self._show_rows(choice)

    def show_document(self, document: Document, *, has_selection: bool) -> None:
        """Show true size and enable the selected curves where the document has them."""
        self._unit = unit = known_unit(document.unit)
        self._paper = document.paper
        check = self.fields[TRUE_SIZE.name].widget
        assert isinstance(check, QCheckBox)
        check.setText(f"True size: 1 is 1 {unit}")
        check.setToolTip(f"A length of one in the document is 1 {unit} in the file")
        self._show_extents(has_selection=has_selection)
        self._show_rows(self._choice)

    def _show_extents(self, *, has_selection: bool) -> None:
        """Enable the selected curves; without any, all curves are exported until some are selected."""
        field = self.fields[EXTENT.name]
        assert isinstance(field.widget, QComboBox)
        model = field.widget.model()
        assert isinstance(model, QStandardItemModel)
        model.item(list(Extent).index(Extent.SELECTED)).setEnabled(has_selection)
        field.show(self._choice[EXTENT] if has_selection else Extent.ALL)

    def _relevant(self, choice: ExportChoice) -> tuple[Option[Any], ...]:
        return choice.relevant_options(self._unit, self._paper)

    def _show_rows(self, choice: ExportChoice) -> None:
        self._description.setText(choice.format.description)
        relevant = (EXTENT, *self._relevant(choice))
        for row, options in self._rows:
            self._form.setRowVisible(row, any(option in relevant for option in options))
            if len(options) > 1:
                for option in options:
                    self.fields[option.name].widget.setVisible(option in relevant)

    def choice(self) -> ExportChoice:
        """Return the choice that the form shows.

        Raises
        ------
        ExpressionError
            If no column is selected, or a number of the format is out of range.
        """
        values = {option: self.fields[option.name].value() for option in self._options}
        choice = choice_with(self._formats[self.format_box.currentIndex()].ending, values)
        problems = (self.fields[option.name].problem() for option in self._relevant(choice))
        if problem := next(filter(None, problems), ""):
            raise ExpressionError(problem)
        return choice

    def _change(self) -> None:
        with suppress(ExpressionError):
            self._choice = self.choice()
            self._show_rows(self._choice)
        self.changed.emit()  # the dialog asks for the choice, or shows the problem


# Fields


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
        """Return the value that the widget shows."""

    @abstractmethod
    def show(self, value: Value) -> None:
        """Show a value."""

    def problem(self) -> str:
        """Return the problem of the value; empty for none."""
        return ""

    def show_automatic(self, number: float) -> None:
        """Show the number that an automatic value stands for."""


@singledispatch
def field_for(option: Option[Any], _change: Callable[[], object]) -> Field[Any]:
    """Return a field for an option; `change` is called when the user changes its value."""
    raise NotImplementedError(f"{type(option).__name__} has no field")


@field_for.register(Check)
class CheckField(Field[bool]):
    """A check box."""

    widget: QCheckBox

    def __init__(self, option: Check, change: Callable[[], object]) -> None:
        self.widget = _check(option.widget, option.title, option.tip, change)

    def value(self) -> bool:
        """Return the value that the widget shows."""
        return self.widget.isChecked()

    def show(self, value: bool) -> None:
        """Show a value."""
        self.widget.setChecked(value)


@field_for.register(Whole)
class WholeField(Field[int]):
    """A spin box that shows its limits."""

    widget: RangedSpinBox

    def __init__(self, option: Whole, change: Callable[[], object]) -> None:
        self.widget = RangedSpinBox(option.widget, option.title, option.tip, option.limits)
        self.widget.setKeyboardTracking(False)
        self.widget.setSuffix(option.suffix)
        # Spin boxes have no signal for user input only; values that the program sets do not differ.
        self.widget.valueChanged.connect(change)

    def value(self) -> int:
        """Return the value that the widget shows."""
        return self.widget.value()

    def show(self, value: int) -> None:
        """Show a value."""
        self.widget.setValue(value)

    def problem(self) -> str:
        """Return the problem of the value."""
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
        """Return the value that the widget shows."""
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
            choice: _check(option.widget.format(choice), choice, option.tip.format(choice), change)
            for choice in option.choices
        }
        self.widget = in_columns(list(self.checks.values()), 3, 14)

    def value(self) -> tuple[str, ...]:
        """Return the value that the widget shows."""
        return tuple(choice for choice, check in self.checks.items() if check.isChecked())

    def show(self, value: tuple[str, ...]) -> None:
        """Show a value."""
        for choice, check in self.checks.items():
            check.setChecked(choice in value)

    def problem(self) -> str:
        """Return the problem of the value."""
        return "" if self.value() else self._needed


@field_for.register(Real)
class RealField(Field[float | None]):
    """A field for a number, or “automatic” where the number is optional."""

    widget: FieldEdit

    def __init__(self, option: Real, change: Callable[[], object]) -> None:
        self._option, self._value, self._change = option, option.default, change
        self._automatic, self._problem = _AUTOMATIC, ""
        self.widget = FieldEdit(option.widget, option.title, option.tip)
        self.widget.is_entered_when_left = True
        self.widget.committed.connect(self._type)
        self.widget.left.connect(self._forget_problem)

    def value(self) -> float | None:
        """Return the value that the widget shows."""
        return self._value

    def show(self, value: float | None) -> None:
        """Show a value."""
        self._value = value
        self.widget.show_text(self._automatic if value is None else typed_text(value))

    def show_automatic(self, number: float) -> None:
        """Show the number that an automatic value stands for."""
        self._automatic = f"{_AUTOMATIC} ({typed_text(number)})"
        self.show(self._value)

    def _type(self, text: str) -> None:
        try:
            self.show(self._number(text))
            self._problem = ""
        except ExpressionError as reason:
            self._problem = f"{self._option.title}: {reason}"
            self.widget.keep()
        self._change()

    def _forget_problem(self) -> None:
        if self._problem:
            self._problem = ""
            self._change()

    def problem(self) -> str:
        """Return the problem of the typed text."""
        return self._problem

    def _number(self, text: str) -> float | None:
        if self._option.default is None and text.strip().casefold() in ("", _AUTOMATIC, self._automatic):
            return None
        value = parse_number(text, decimal_mark())
        if self._option.checked(value) != value:
            raise ExpressionError("The number is out of range.")
        return value


def _check(name: str, text: str, tip: str, change: Callable[[], object]) -> QCheckBox:
    check = check_box(name, text, tip)
    check.clicked.connect(change)
    return check
