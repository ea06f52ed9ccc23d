"""Keys that the point table and fields have, too, for what they show."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from ...workbench.context import WindowContext


def give_keys_to_drawing(context: WindowContext, commands: type) -> None:
    """Let the keys of a command set act with the focus on the canvas, or in a panel that has none such."""
    table = context.docks["pointsDock"]
    places: list[QWidget] = [
        context.central.canvas,
        *(dock for dock in context.docks.all if dock is not table),
    ]
    for each in context.actions.declared_by(commands):
        each.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        for place in places:
            place.addAction(each)
