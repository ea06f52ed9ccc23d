"""Frames that lie over another widget and take no room from it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QFrame, QWidget
from shiboken6 import isValid

from ..appearance.theme import mix
from ..appearance.themed import FollowsTheme

_MOVES = (QEvent.Type.Resize, QEvent.Type.Move, QEvent.Type.Show, QEvent.Type.Hide)


class OverlayFrame(FollowsTheme, QFrame):
    """A frame on top of its parent: what lies below does not move when it appears.

    It places itself anew, by `place`, when the parent has another size, or when `beside`, which it keeps
    clear of, comes, goes or moves.
    """

    def __init__(self, name: str, below: QWidget, beside: QWidget | None = None) -> None:
        super().__init__(below)
        self.setObjectName(name)
        self._watched = [each for each in (below, beside) if each is not None]

    @property
    def below(self) -> QWidget:
        """Parent widget, asked for anew: for PySide6 a viewport that was kept was once gone."""
        below = self.parentWidget()
        assert below is not None
        return below

    def place(self) -> None:
        """Take size and place on the parent."""
        raise NotImplementedError

    def showEvent(self, event: QShowEvent) -> None:
        # Nobody listens for a frame that is hidden: every move of the mouse would come by.
        for each in self._watched:
            each.installEventFilter(self)
        self.place()
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        for each in self._watched:
            if isValid(each):
                each.removeEventFilter(self)
        super().hideEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in _MOVES and not self.isHidden():
            self.place()
        return super().eventFilter(watched, event)

    def set_sheet(self, rules: str = "", *, line: float = 0.14) -> None:
        """Draw it as a sheet of paper with a border of this much ink; `rules` are those of what is on it."""
        theme = self.theme
        border = mix(theme.ink, theme.paper, line).name()
        sheet = (
            f"#{self.objectName()} {{ background: {theme.surface.name()}; border: 1px solid {border};"
            f" border-radius: 8px }} {rules}"
        )
        if sheet != self.styleSheet():
            self.setStyleSheet(sheet)
