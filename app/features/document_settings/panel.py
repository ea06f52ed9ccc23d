"""The form of a document's unit and its grid."""

from __future__ import annotations

from functools import partial
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFormLayout, QWidget

from ...document.model import LONGEST_UNIT, Document, Paper
from ...document.plane_edits import set_grid_spacing, set_paper, set_unit
from ...document.style import Style
from ...exchange.units import note_of_unknown
from ...qt.labels import MUTED, Label
from ...settings.kinds import Choice, Distance, Text
from ...settings.preferences import NO_UNIT, USUAL_UNITS
from ...widgets.boxes import column_of, form_of
from ...widgets.controls import push_button
from ...widgets.fields import FieldForm
from ...widgets.number_text import length_text
from ...widgets.preference_fields import PreferenceField, field_of

_UNIT = Text(
    "",
    "Unit",
    "Unit of length in this document; type any name. Numbers are not converted",
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
    refusal="Enter a grid spacing greater than 0, or “adaptive”.",
    widget="documentGrid",
)


_PAPER = Choice(
    "",
    Paper.THEME,
    "Paper",
    "Paper of the canvas and of exported pictures, whatever the theme: the ink has its colour for it",
    widget="documentPaper",
)


class DocumentPanel(FieldForm):
    """Form of unit, grid and paper of a document, with the defaults of new ones.

    Signals
    -------
    defaults_requested
        The settings of this document are to be the defaults of new ones.
    """

    defaults_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("documentPanel", "documentProblem", parent)
        self._unit: PreferenceField[Any] = field_of(_UNIT, partial(self._ask, "unit", set_unit))
        self._grid: PreferenceField[Any] = field_of(
            _GRID, partial(self._ask, "grid spacing", set_grid_spacing)
        )
        self._paper: PreferenceField[Any] = field_of(_PAPER, partial(self._ask, "paper", set_paper))
        self._usual = Label(name="newDocuments", wordWrap=True, role=MUTED)
        tip = "Use this unit, this grid and the style of this curve in new documents"
        self._take = push_button("useForNew", "Use for New Documents", tip)
        self._take.clicked.connect(self.defaults_requested)
        form = form_of(*self._unit.rows, *self._grid.rows, *self._paper.rows)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        left = Qt.AlignmentFlag.AlignLeft
        column_of(form, self.problem, self._usual, (self._take, left), 1, margins=12, spacing=10, parent=self)
        self.show_problem("")

    def _ask(self, what: str, edit: Any, value: object) -> None:  # noqa: ANN401 - of the value's kind
        self.edited.emit(f"Set the {what}", lambda document, _curve: edit(document, value))

    def render_document(self, document: Document, new: Document, style: Style) -> None:
        """Show the settings of a document, and those of a new one with the style of its curve."""
        unit, spacing = new.unit, new.grid_spacing
        self._unit.show(document.unit)
        self._grid.show(document.grid_spacing)
        self._paper.show(document.paper)
        grid = f"a grid of {length_text(spacing, unit)}" if spacing else "an adaptive grid"
        line = "the default style" if style == Style() else "a saved style"
        named = f"“{unit}”" if unit else NO_UNIT
        self._usual.setText(f"New documents use unit {named}, {grid} and {line}.")
