"""Commands of the Help menu: the manual, keys and gestures, and the version."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QMessageBox

from ... import __version__
from ...actions.declaration import action
from ...actions.menus import HELP_ABOUT, HELP_ALL, MENUS
from ...document.several_curves import count_label
from ...workbench.context import WindowContext
from .. import help as help_feature

if TYPE_CHECKING:
    from .manual import ManualWindow
    from .shortcut_sheet import ShortcutSheet


class HelpCommands:
    """The Help menu."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._sheet: ShortcutSheet | None = None
        self._manual: ManualWindow | None = None

    @action("manual", "Manual", HELP_ALL, icon="manual")
    def _show_manual(self) -> None:
        """Read the manual: one page for each subject."""
        if self._manual is None:
            self._manual = help_feature.manual.ManualWindow(self._context.window)
        self._manual.bring_up()

    @action("showShortcuts", "Keys and Mouse", HELP_ALL, "F1", "help")
    def _show_shortcuts(self) -> None:
        """Show all keys and gestures, first those that apply now."""
        context = self._context
        if self._sheet is None:
            self._sheet = help_feature.shortcut_sheet.ShortcutSheet(
                context.window,
                over=context.window.centralWidget() or context.window,
                toggle=context.actions["showShortcuts"],
            )
        if self._sheet.isVisible():
            self._sheet.dismiss()
            return
        selected = context.session.selected
        state = help_feature.shortcut_sheet.SheetState(
            tool=context.store.state.tool,
            point_count=selected.group.count,
            has_derivatives=context.session.active_curve.family.derivatives > 0,
            curves=count_label(context.session.document, selected.whole_curves)
            if selected.whole_curves
            else "",
        )
        self._sheet.open(state, [(menu.title, context.actions.shortcuts(menu)) for menu in MENUS])

    @action("about", "About Curvebench", HELP_ABOUT)
    def _about(self) -> None:
        """Show version and licence."""
        box = QMessageBox(self._context.window)
        box.setObjectName("aboutBox")
        box.setWindowTitle("About Curvebench")
        box.setText(f"Curvebench {__version__}")
        box.setInformativeText(
            "Sketch parametric polynomial curves and see why they go where they go.\n"
            "MIT licence. Icons: Lucide, ISC licence."
        )
        box.open()


COMMAND_SETS = (HelpCommands,)
