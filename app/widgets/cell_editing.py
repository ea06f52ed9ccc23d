"""Editing of cells in lists and tables by a field that opens in them."""

from __future__ import annotations

from PySide6.QtWidgets import QAbstractItemView, QLineEdit, QStyledItemDelegate


def end_editing(view: QAbstractItemView) -> None:
    """Close the field of a cell as if it were left: as long as it is there, no other cell can be edited."""
    editor = view.viewport().findChild(QLineEdit)
    if view.state() == QAbstractItemView.State.EditingState and editor is not None:
        view.commitData(editor)
        view.closeEditor(editor, QStyledItemDelegate.EndEditHint.NoHint)
