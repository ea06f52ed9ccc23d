"""Context menus, made of the actions of a bar and of the sections that are submenus there."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from ..actions.menus import ActionBar
from .context import WindowContext


def bar_menu(
    context: WindowContext, bar: ActionBar, name: str = "contextMenu", *, is_short: bool = False
) -> QMenu:
    """Return a menu with the actions of `bar`, which goes when it is closed.

    One that `is_short` has those alone that can be done now; so do its submenus.
    """
    menu = QMenu(context.window)
    menu.setObjectName(name)
    menu.setToolTipsVisible(True)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    submenus: dict[str, QMenu] = {}
    for group in context.actions.with_sections(bar).values():
        menu.addSeparator()
        for entry in group:
            if isinstance(entry, QAction):
                menu.addActions(_offered([entry], is_short=is_short))
            elif actions := _offered(context.actions.in_section(entry), is_short=is_short):
                if entry.called not in submenus:
                    submenus[entry.called] = menu.addMenu(entry.called)
                    submenus[entry.called].setToolTipsVisible(True)
                submenus[entry.called].addSeparator()
                submenus[entry.called].addActions(actions)
    return menu


def _offered(actions: Sequence[QAction], *, is_short: bool) -> list[QAction]:
    return [each for each in actions if each.isEnabled() or not is_short]
