"""The list of curves as tests see it."""

from __future__ import annotations

from app.features.curve_list.commands import CurveListCommands
from app.features.curve_list.view import CurveListView
from app.testing import Editor


def view_of(editor: Editor) -> CurveListView:
    """Return the list."""
    return editor.window.commands[CurveListCommands].panel.view


def rows(editor: Editor) -> list[str]:
    """Return the texts of the rows from the top, each as deep as it is drawn."""
    model = view_of(editor).curves
    return ["  " * entry.node.depth + model.index(row).data() for row, entry in enumerate(model.entries)]
