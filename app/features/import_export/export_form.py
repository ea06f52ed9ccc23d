"""The options of an export, of each format those that concern it: a row for each record."""

from __future__ import annotations

from itertools import groupby
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import QCheckBox, QComboBox, QWidget

from ...document.expression import ExpressionError
from ...document.lengths import known_unit
from ...document.model import Document
from ...exchange.choice import ExportChoice, chosen, offered_options
from ...exchange.formats import FORMATS
from ...exchange.options import EXTENT, TRUE_SIZE, Extent, Option
from ...qt.labels import Label
from ...widgets.boxes import form_of
from ...widgets.controls import choice_box
from .export_fields import field_for, in_columns


class ExportForm(QWidget):
    """Boxes and fields for an `ExportChoice`.

    Signals
    -------
    changed
        The person chose something else.

    Attributes
    ----------
    fields
        One for each option of any format, by the options' names.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("exportForm")
        self._shown, self._unit = ExportChoice(), ""
        self._formats = FORMATS.offered
        titles = [each.title for each in self._formats]
        self.format_box = choice_box("exportFormat", "Format", "What kind of file to write", titles)
        self.format_box.activated.connect(self._change)
        self._description = Label(name="exportDescription", wordWrap=True)
        self._options = offered_options()
        self.fields = {each.name: field_for(each, self._change) for each in self._options}
        self._rows: list[tuple[QWidget, tuple[Option[Any], ...]]] = []
        self._lay_out()

    def _lay_out(self) -> None:
        rows = (("Format", self.format_box), ("", self._description))
        self._form = form_of(*rows, margins=0, across=14, parent=self)
        for label, group in groupby(self._options, lambda option: option.label):
            options = tuple(group)
            widgets = [self.fields[each.name].widget for each in options]
            row = widgets[0] if len(widgets) == 1 else in_columns(widgets, 2)
            self._form.addRow(label, row)
            self._rows.append((row, options))

    def show_choice(self, choice: ExportChoice) -> None:
        """Show these options, those that concern the format."""
        self.format_box.setCurrentIndex(self._formats.index(choice.format))
        for option in self._options:
            self.fields[option.name].show(choice[option])
        self._shown = choice
        self._show_rows(choice)

    def show_document(self, document: Document, *, has_chosen: bool) -> None:
        """Offer what can be had of a document: true size in its unit, and what is chosen."""
        self._unit = unit = known_unit(document.unit)
        check = self.fields[TRUE_SIZE.name].widget
        assert isinstance(check, QCheckBox)
        check.setEnabled(bool(unit))
        check.setText(f"True size, 1 is 1 {unit}" if unit else "True size")
        why = f"“{document.unit}” is no unit of length" if document.unit else "The document has no unit"
        tip = f"A length of one in the document is 1 {unit} in the file" if unit else why
        check.setToolTip(tip)
        self._show_extents(has_chosen=has_chosen)
        self._show_rows(self._shown)

    def _show_extents(self, *, has_chosen: bool) -> None:
        """Offer what is chosen; where nothing is, all curves are exported until something is chosen."""
        field = self.fields[EXTENT.name]
        assert isinstance(field.widget, QComboBox)
        model = field.widget.model()
        assert isinstance(model, QStandardItemModel)
        model.item(list(Extent).index(Extent.CHOSEN)).setEnabled(has_chosen)
        field.show(self._shown[EXTENT] if has_chosen else Extent.ALL)

    def _show_rows(self, choice: ExportChoice) -> None:
        self._description.setText(choice.format.description)
        shown = (EXTENT, *choice.shown(self._unit))
        for row, options in self._rows:
            self._form.setRowVisible(row, any(each in shown for each in options))
            if len(options) > 1:
                for each in options:
                    self.fields[each.name].widget.setVisible(each in shown)

    def choice(self) -> ExportChoice:
        """Return what is chosen.

        Raises
        ------
        ExpressionError
            If no column is, or a number that concerns the format is out of its range.
        """
        values = {each: self.fields[each.name].value() for each in self._options}
        choice = chosen(self._formats[self.format_box.currentIndex()].ending, values)
        problems = (self.fields[each.name].problem() for each in choice.shown(self._unit))
        if problem := next(filter(None, problems), ""):
            raise ExpressionError(problem)
        return choice

    def _change(self) -> None:
        try:
            choice = self.choice()
        except ExpressionError:
            self.changed.emit()  # whoever hears it asks for the choice, and says so
            return
        if choice != self._shown:
            self._shown = choice
            self._show_rows(choice)
            self.changed.emit()
