"""The line under the canvas about a file of families."""

from __future__ import annotations

from PySide6.QtWidgets import QBoxLayout, QSizePolicy

from ...workbench.message_bar import NoticeBar


class FamilyBar(NoticeBar):
    """A sentence with buttons between the canvas and the functions that it is about; nothing lies under it.

    Parameters
    ----------
    column
        What it stands in.
    """

    def __init__(self, column: QBoxLayout) -> None:
        parent = column.parentWidget()
        assert parent is not None
        super().__init__("family", parent)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        column.addWidget(self)

    def place(self) -> None:
        """Take the width of the column, with the buttons beside the sentence where they fit."""
        self.wanted_width(self.sentence_width, self.below.width())
        self.updateGeometry()
