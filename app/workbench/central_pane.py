"""A pane in the middle of the window, below the canvas: what it can do, and how a feature declares one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

import msgspec
from PySide6.QtWidgets import QWidget

from ..actions.declaration import marked
from ..plotting.tool_plot import ToolPlot

_DECLARED = "central_pane"


class CentralPane(QWidget):
    """A pane below the canvas.

    Attributes
    ----------
    plot
        The plot in it; None until it is made.
    """

    plot: ToolPlot | None = None

    @property
    def stop(self) -> QWidget:
        """Stop of F6 on its way through the window."""
        return self

    def fit(self, *, whole: bool) -> None:
        """Show what a person usually sees, or the whole, however far it reaches."""


_Builder = TypeVar("_Builder", bound=Callable[..., CentralPane])


class Pane(msgspec.Struct, frozen=True):
    """A pane below the canvas; the method builds it in the parent that it gets.

    Attributes
    ----------
    name
        Its object name.
    stretch, height
        Its share when the window grows, and in a new window (0: what it asks for).
    """

    name: str
    stretch: int = 0
    height: int = 0

    def __call__(self, build: _Builder) -> _Builder:
        """Declare the decorated method of a command set as what builds the pane."""
        setattr(build, _DECLARED, self)
        return build


def declared_panes(commands: type) -> Iterator[tuple[Callable[..., CentralPane], Pane]]:
    """Yield what builds the panes that a command set declares, and how they stand."""
    yield from marked(commands, _DECLARED)
