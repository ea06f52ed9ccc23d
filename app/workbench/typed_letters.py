"""Letters that are typed on the canvas: while they are, paints that are chosen are theirs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from ..document.style import Style

Restyle = Callable[[Style], Style]
"""Returns another style for one."""


class Painter(Protocol):
    """Paints the letters that are chosen in a text, or all of it where none are."""

    @property
    def subject(self) -> str:
        """What these are called."""

    @property
    def styles(self) -> Sequence[Style]:
        """How they look."""

    def paint(self, change: Restyle) -> None:
        """Have them look otherwise."""

    def look_at(self, change: Restyle) -> None:
        """Show how that would be."""

    def give_up(self) -> None:
        """Show them as they are."""


class TypedLetters(QObject):
    """The letters that are typed in a window.

    Attributes
    ----------
    painter
        Paints them; None where there are none, or they are all of one paint.
    tools
        Widgets that may be used meanwhile: who goes there has not left the text.

    Signals
    -------
    changed
        Others are chosen, they look otherwise, or there are none any more.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.painter: Painter | None = None
        self.tools: list[QWidget] = []

    def begin(self, painter: Painter) -> None:
        """Letters are typed from now on."""
        self.painter = painter
        self.changed.emit()

    def end(self) -> None:
        """None are typed any more."""
        if self.painter is not None:
            self.painter = None
            self.changed.emit()

    def has_tool(self, widget: QWidget) -> bool:
        """Whether a widget may be used while letters are typed."""
        return self.painter is not None and any(
            each is widget or each.isAncestorOf(widget) for each in self.tools
        )
