"""Keys and mouse, and what this program is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QMessageBox

from app import __version__
from app.action_specs import MENUS
from app.commands.parts import Handlers, Parts
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from app.panels.shortcut_sheet import ShortcutSheet


class HelpCommands:
    """The Help menu."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._sheet: ShortcutSheet | None = None

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {"showShortcuts": self._show_shortcuts, "about": self._about}

    def render(self, view: CurveView) -> None:
        """Help is always there."""

    def _show_shortcuts(self) -> None:
        """Show the keys of the moment, or put the sheet away."""
        from app.panels.shortcut_sheet import Moment, ShortcutSheet  # noqa: PLC0415 - not at the start

        parts = self._parts
        if self._sheet is None:
            self._sheet = ShortcutSheet(parts.window, over=parts.window.centralWidget() or parts.window)
        if self._sheet.isVisible():
            self._sheet.put_away()
            return
        moment = Moment(
            adding=parts.actions["addTool"].isChecked(),
            selected=len(parts.session.selection),
            has_derivatives=parts.session.active_curve.family.derivatives > 0,
            curves=len(parts.session.chosen_curves),
        )
        self._sheet.open(moment, [(menu, parts.actions.shortcuts(menu)) for menu in MENUS])

    def _about(self) -> None:
        box = QMessageBox(self._parts.window)
        box.setObjectName("aboutBox")
        box.setWindowTitle("About Curvebench")
        box.setText(f"Curvebench {__version__}")
        box.setInformativeText(
            "Sketch parametric polynomial curves and see why they go where they go.\n"
            "MIT licence. Icons: Lucide, ISC licence."
        )
        box.open()
