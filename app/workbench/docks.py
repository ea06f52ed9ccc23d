"""The docks at the sides of the window: what stands in them, and in which order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import ClassVar, TypeVar

import msgspec
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget

from ..actions.declaration import marked
from .dock import Dock, LateDock

_LEFT, _RIGHT = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea
_WIDTH = 350
"""Of the docks at the right, in a new window: no panel asks for more, so that none makes them wider."""

_DECLARED = "docked_panel"
_Builder = TypeVar("_Builder", bound=Callable[..., QWidget])


class Stack(msgspec.Struct, frozen=True):
    """Docks that are tabs of one place; the first that is declared is in front.

    Attributes
    ----------
    area
        The side of the window.
    height
        Its share of the side in a new window.
    """

    area: Qt.DockWidgetArea
    height: int


UPPER, LOWER, LEFT = Stack(_RIGHT, 460), Stack(_RIGHT, 320), Stack(_LEFT, 0)
_STACKS = (UPPER, LOWER, LEFT)


class Panel(msgspec.Struct, frozen=True):
    """A panel that is there when the window is first shown; the method builds it in the parent that it gets.

    Attributes
    ----------
    name, title
        Object name of its dock, and what stands on the tab.
    stack
        Where it stands.
    on_demand
        Whether its dock stays away until it is asked for: too many tabs are none.
    is_steady
        Whether what stands in it stays there when its scroll bar comes and goes, for what changes with every
        click on the canvas.
    """

    dock_class: ClassVar[type[Dock]] = Dock

    name: str
    title: str
    stack: Stack = LOWER
    on_demand: bool = False
    is_steady: bool = False

    def __call__(self, build: _Builder) -> _Builder:
        """Declare the decorated method of a command set as what builds the panel."""
        setattr(build, _DECLARED, self)
        return build


class LatePanel(Panel, frozen=True):
    """A panel that is built when its dock is first shown: nobody waits for it at the start."""

    dock_class = LateDock


def declared_panels(commands: type) -> Iterator[tuple[Panel, Callable[..., QWidget]]]:
    """Yield the panels that a command set declares, and what builds them."""
    for build, panel in marked(commands, _DECLARED):
        yield panel, build


class Docks:
    """Builds and places the docks of a window.

    Parameters
    ----------
    panels
        What stands in them, in the order of the tabs.
    build
        Returns what stands in a dock: called with its name and the parent.

    Attributes
    ----------
    all, side
        All docks, by their stacks; those at the right.
    """

    def __init__(self, window: QMainWindow, panels: Sequence[Panel], build: Callable[..., QWidget]) -> None:
        self._window = window
        panels = [each for stack in _STACKS for each in panels if each.stack is stack]
        self._docks = {
            each.name: each.dock_class(each.title, partial(build, each.name), window) for each in panels
        }
        for each in panels:
            self._docks[each.name].is_steady = each.is_steady
        fronts: dict[Stack, QDockWidget] = {}
        for each in panels:
            self._place(self[each.name], each, fronts)
        for front in fronts.values():
            front.raise_()
        for each in panels:
            if each.on_demand:
                self[each.name].hide()
        self._fronts = [(fronts[stack], stack.height) for stack in (UPPER, LOWER)]
        self.all = tuple(self._docks.values())
        self.side = tuple(self[each.name] for each in panels if each.stack is not LEFT)

    def _place(self, dock: QDockWidget, panel: Panel, fronts: dict[Stack, QDockWidget]) -> None:
        """Put a dock behind the one in `fronts`; the first of a stack becomes that."""
        dock.setObjectName(panel.name)
        dock.setAllowedAreas(_LEFT | _RIGHT)
        front = fronts.setdefault(panel.stack, dock)
        self._window.addDockWidget(panel.stack.area, dock)
        if front is not dock:
            self._window.tabifyDockWidget(front, dock)

    def __getitem__(self, name: str) -> Dock:
        return self._docks[name]

    def fill(self) -> None:
        """Build the panels that are not late, and give each stack its share of the side."""
        for dock in self.all:
            if not isinstance(dock, LateDock):
                dock.fill()
        docks, heights = zip(*self._fronts, strict=True)
        self._window.resizeDocks(docks[:1], [_WIDTH], Qt.Orientation.Horizontal)
        self._window.resizeDocks(docks, heights, Qt.Orientation.Vertical)
