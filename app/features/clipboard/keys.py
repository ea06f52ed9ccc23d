"""Keys that the point table and the fields of panels have, too, for what they show."""

from __future__ import annotations

from PySide6.QtCore import Qt

from ...workbench.context import WindowContext


def give_keys_to_drawing(context: WindowContext, commands: type) -> None:
    """Let the keys of a command set act with the focus on the canvas, or in the list of curves."""
    for each in context.actions.declared_by(commands):
        each.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        context.central.canvas.addAction(each)
        context.docks["curvesDock"].addAction(each)
