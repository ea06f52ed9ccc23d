"""The form of a document's unit, its grid and its page."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFormLayout, QWidget

from ...appearance.theme import Theme
from ...document.model import LONGEST_UNIT, Document
from ...document.plane_edits import set_grid_spacing, set_unit, set_y_up
from ...document.readings import readings_of
from ...document.style import Style
from ...exchange.units import note_of_unknown
from ...qt.labels import Label
from ...settings.kinds import Distance, Text
from ...settings.preferences import NO_UNIT, USUAL_UNITS
from ...widgets.boxes import column_of, form_of
from ...widgets.controls import check_box, push_button
from ...widgets.field_form import FieldForm
from ...widgets.length_text import length_text
from ...widgets.preference_fields import PreferenceField, field_of
from .page_fields import PageFields

_UNIT = Text(
    "",
    "Unit",
    "What a length of one is called in this document; type any name. Numbers stay as they are",
    longest=LONGEST_UNIT,
    usual=USUAL_UNITS,
    note=note_of_unknown,
    widget="documentUnit",
)
_GRID = Distance(
    "",
    "Grid spacing",
    "“adaptive”, or a distance in the plane (Enter to set)",
    none="adaptive",
    refusal="The grid needs a distance greater than 0, or “adaptive”.",
    widget="documentGrid",
)


class DocumentPanel(FieldForm):
    """A form that shows what belongs to a document as a whole, and asks for changes of it.

    Signals
    -------
    made_usual
        New documents shall begin as this one is.
    page_made
        Another page was asked for, and made.
    """

    made_usual = Signal()
    page_made = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("documentPanel", "documentProblem", parent)
        self._unit: PreferenceField[Any] = field_of(_UNIT, partial(self._ask, "unit", set_unit))
        self._grid: PreferenceField[Any] = field_of(
            _GRID, partial(self._ask, "grid spacing", set_grid_spacing)
        )
        self.page = PageFields(self._ask_page, self.watch)
        tip = "Tell x and y from the upper left corner of the page, as SVG does; else from the lower left one"
        self.y_down = check_box("yDown", "Y axis points down", tip)
        self.y_down.clicked.connect(self._ask_y_down)
        self._usual = Label(name="newDocuments", wordWrap=True)
        tip = "Let new documents begin with this unit, grid and page, and their curve with this one's style"
        self._take = push_button("useForNew", "Use for New Documents", tip)
        self._take.clicked.connect(self.made_usual)
        form = form_of(*self._unit.rows, *self._grid.rows, *self.page.rows, ("", self.y_down))
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        left = Qt.AlignmentFlag.AlignLeft
        column_of(form, self.problem, self._usual, (self._take, left), 1, margins=12, spacing=10, parent=self)
        self.show_problem("")
        self.follow_theme()

    def _ask(self, what: str, edit: Any, value: object) -> None:  # noqa: ANN401 - of the value's kind
        self.edited.emit(f"Set the {what}", lambda document, _curve: edit(document, value))

    def _ask_y_down(self, down: bool) -> None:
        text = f"Y Axis Points {'Down' if down else 'Up'}"
        self.edited.emit(text, lambda document, _curve: set_y_up(document, up=not down))

    def _ask_page(self, text: str, edit: Callable[[Document], Document]) -> None:
        self.clear_refusal()
        self.edited.emit(text, lambda document, _curve: edit(document))
        if not self.has_refusal:
            self.page_made.emit()

    def render_document(self, document: Document, new: Document, style: Style) -> None:
        """Show `document`, and of a `new` one the unit, the grid and the page, and the style of its curve."""
        unit, spacing = new.unit, new.grid_spacing
        self._unit.show(document.unit)
        self._grid.show(document.grid_spacing)
        self.page.show(document.page, document.unit)
        # Without a page y is that of mathematics.
        self.y_down.setEnabled(document.page is not None)
        self.y_down.setChecked(readings_of(document).is_down)
        grid = f"a grid of {length_text(spacing, unit)}" if spacing else "an adaptive grid"
        line = "usual lines" if style == Style() else "lines and fills of their own style"
        named = f"“{unit}”" if unit else NO_UNIT
        page = "no page"
        if new.page is not None:
            page = f"a page of {length_text(new.page.width, '', 4)} × {length_text(new.page.height, unit, 4)}"
        self._usual.setText(f"New documents begin with unit {named}, {grid}, {page} and {line}.")

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        super().set_theme(theme)
        self.page.set_theme(theme)
        self._usual.setStyleSheet(f"color: {theme.muted.name()}")
