"""Text fields that open in the cells of lists and tables."""

from __future__ import annotations

from PySide6.QtWidgets import QAbstractItemView, QLineEdit, QStyledItemDelegate


def end_editing(view: QAbstractItemView) -> None:
    """Close the open text field, if there is one, as if the keyboard left it; Qt edits one cell at a time."""
    editor = view.viewport().findChild(QLineEdit)
    if view.state() == QAbstractItemView.State.EditingState and editor is not None:
        view.commitData(editor)
        view.closeEditor(editor, QStyledItemDelegate.EndEditHint.NoHint)
