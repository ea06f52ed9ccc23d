"""The line at the foot of the canvas about a file of families."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from ...workbench.notice_bar import NoticeBar

_FOOT = 44
"""Pixels that the axis below it takes."""


class FamilyBar(NoticeBar):
    """A sentence with buttons, above the functions that it is about."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__("family", parent)

    def place(self) -> None:
        super().place()
        self.move(self.x(), self.below.height() - self.height() - _FOOT)
