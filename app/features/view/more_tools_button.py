"""The tools that have no button of their own in the toolbar: one button, and a menu of them all."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QSize
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QSizePolicy, QToolButton

from ...widgets.boxes import row_of
from ...widgets.controls import ToolbarWidget, named

_ICON, _ARROW = 20, 20
"""Pixels along the sides of the icon, and of what stands beside it."""


class MoreToolsButton(ToolbarWidget):
    """Toolbar button for the last used tool of its menu.

    Parameters
    ----------
    is_on
        Function that tells by name whether a switch is on.
    """

    def __init__(self, is_on: Callable[[str], bool]) -> None:
        super().__init__()
        self._is_on = is_on
        self.button = named(QToolButton(), "moreToolsButton", "More Tools")
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.MenuButtonPopup)
        self.button.setIconSize(QSize(_ICON, _ICON))
        self.button.setFixedWidth(_ICON + _ARROW)
        self._menu = named(QMenu(self.button), "moreToolsMenu")
        self._menu.setToolTipsVisible(True)
        row_of(self.button, margins=(0, 0, 0, 0), parent=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)

    def offer(self, tools: Sequence[QAction]) -> None:
        """Set the tools of the menu; the first one is on the button."""
        self._menu.addActions(list(tools))
        self.button.setDefaultAction(tools[0])
        # Set last: setDefaultAction replaces the menu by that of the action.
        self.button.setMenu(self._menu)

    def show_in_use(self) -> None:
        """Show the tool in use, if it is in the menu; otherwise the last one."""
        used = next((entry for entry in self._menu.actions() if self._is_on(entry.objectName())), None)
        if used is not None and used is not self.button.defaultAction():
            self.button.setDefaultAction(used)
            self.button.setMenu(self._menu)
