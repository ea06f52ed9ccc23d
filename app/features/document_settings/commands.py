"""Unit and grid of the document, on the canvas and in a form; defaults of new documents."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace
from PySide6.QtWidgets import QWidget

from ... import exchange
from ...actions.declaration import action
from ...actions.menus import FILE_DOCUMENT
from ...appearance.theme import DARK, LIGHT, Theme
from ...document.model import Paper
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from ...workbench.form_edits import FormEdits
from .. import document_settings

if TYPE_CHECKING:
    from .panel import DocumentPanel


class DocumentSettingsCommands:
    """Unit, grid and paper of the document, on the canvas, in the status line and in the form."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._preferences = context.preferences
        self._dock = context.docks["documentDock"]
        self._panel: DocumentPanel | None = None
        self._rendered: tuple[str, float] | None = None
        self._theme = LIGHT
        self.render_panel(context.session.active_view)

    @Panel("documentDock", "Document", on_demand=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the form."""
        self._panel = document_settings.panel.DocumentPanel(parent)
        self._edits = FormEdits(self._session, self._panel)
        self._panel.defaults_requested.connect(self._make_default)
        self._render_panel()
        return self._panel

    def render_panel(self, view: CurveView) -> None:
        """Show the unit and the grid of the document."""
        document = self._session.document
        now = (document.unit, document.grid_spacing)
        if now != self._rendered:
            before, self._rendered = self._rendered, now
            canvas = self._context.central.canvas
            canvas.show_marks()
            canvas.drawing.grid.set_spacing(document.grid_spacing)
            canvas.drawing.units.render(document.unit)
            self._context.status_line.readouts.show_unit(document.unit)
            if before is not None and before[0] != document.unit and self._panel is not None:
                name = f"are now in {document.unit}" if document.unit else "now have no unit"
                note = exchange.units.note_of_unknown(document.unit)
                self._session.say(f"Lengths {name}; the numbers are unchanged. {note}".rstrip())
        self._show_paper()
        self._render_panel()

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme` where the document has no paper of its own."""
        self._theme = theme
        self._show_paper()

    def _show_paper(self) -> None:
        theme = {Paper.LIGHT: LIGHT, Paper.DARK: DARK}.get(self._session.document.paper, self._theme)
        canvas = self._context.central.canvas
        if theme is not canvas.layers.theme:
            canvas.set_theme(theme)

    def _render_panel(self) -> None:
        if self._panel is not None:
            preferences = self._preferences
            document = replace(
                self._session.document,
                unit=preferences.unit_name,
                grid_spacing=preferences.grid_spacing,
            )
            self._panel.render_document(self._session.document, document, preferences.new_style)

    def _make_default(self) -> None:
        document, preferences = self._session.document, self._preferences
        preferences.unit_name, preferences.grid_spacing = document.unit, document.grid_spacing
        preferences.new_style = self._session.active_curve.style
        self._session.say("New documents will use this unit and grid, and the style of this curve.")
        self._render_panel()

    @action(
        "documentSettings",
        "Document…",
        FILE_DOCUMENT,
        "Ctrl+Shift+D",
        full_name="Document: Unit, Grid and Paper…",
        keywords="properties unit millimetres inches grid spacing new setup background white dark",
    )
    def _show(self) -> None:
        """Set the unit, the grid and the paper of this document."""
        self._dock.bring_up()


COMMAND_SETS = (DocumentSettingsCommands,)
