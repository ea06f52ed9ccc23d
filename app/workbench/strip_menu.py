"""Context menus, made of the actions of a strip."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu

from ..actions.strips import Strip
from .context import WindowContext


def strip_menu(
    context: WindowContext, strip: Strip, name: str = "contextMenu", *, is_short: bool = False
) -> QMenu:
    """Return a menu with the actions of `strip`, which goes when it is closed.

    One that `is_short` has those alone that can be done now.
    """
    menu = QMenu(context.window)
    menu.setObjectName(name)
    menu.setToolTipsVisible(True)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    for group in context.actions.in_strip(strip).values():
        menu.addSeparator()
        menu.addActions([each for each in group if each.isEnabled() or not is_short])
    return menu
