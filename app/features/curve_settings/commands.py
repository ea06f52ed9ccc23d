"""The form of the active curve in the window: its dock, and what it shows."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from ...view_model.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from ...workbench.form_edits import FormEdits
from .panel import CurveSettings


class CurveSettingsCommands:
    """Keeps the form in step with the active curve.

    Attributes
    ----------
    panel
        The form, as soon as the docks are filled.
    """

    panel: CurveSettings

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session
        self._shown: CurveView | None = None

    @Panel("curveDock", "Curve")
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the form."""
        self.panel = CurveSettings(self._session.active_view, parent)
        self._edits = FormEdits(self._session, self.panel)
        return self.panel

    def render(self, view: CurveView) -> None:
        """Show `view`; where only the selection has changed, the form stays as it is."""
        if view is not self._shown:
            self._shown = view
            self.panel.render_view(view)


COMMAND_SETS = (CurveSettingsCommands,)
