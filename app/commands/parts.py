"""The parts of a window that commands act on, and what a set of commands is."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

import msgspec
from PySide6.QtWidgets import QBoxLayout, QDockWidget, QMainWindow, QMenu, QSplitter, QToolBar

from app.actions import Actions
from app.analysis import Analysis
from app.canvas.canvas import Canvas
from app.file_commands import FileCommands
from app.panels.basis_pane import BasisPane
from app.panels.basis_panel import BasisPanel
from app.panels.curve_list import CurveList
from app.panels.image_panel import ImagePanel
from app.panels.late_dock import LateDock
from app.panels.message_bar import MessageBar
from app.panels.plot_panel import PlotPanel
from app.panels.status_line import StatusLine
from app.preferences import Preferences
from app.session import Session
from app.theme import ThemeMode
from app.view_model.curve_view import CurveView

Handlers = Mapping[str, Callable[[], object]]


class Parts(msgspec.Struct, frozen=True):
    """The parts of a window that commands act on."""

    window: QMainWindow
    session: Session
    analysis: Analysis
    actions: Actions
    files: FileCommands
    canvas: Canvas
    under_canvas: QBoxLayout
    basis_panel: BasisPanel
    basis_pane: BasisPane
    message_bar: MessageBar
    status_line: StatusLine
    toolbar: QToolBar
    docks: Sequence[QDockWidget]
    parameters_menu: QMenu
    preferences: Preferences
    curve_list: CurveList
    set_theme_mode: Callable[[ThemeMode], None]
    image_panel: ImagePanel
    image_dock: QDockWidget
    splitter: QSplitter
    plot_panel: PlotPanel
    lessons_dock: LateDock

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return (
            self.canvas.cancel_gesture()
            or self.basis_panel.cancel_gesture()
            or self.plot_panel.cancel_gesture()
            or (self.session.is_previewing and self.session.interrupt())
        )


class CommandSet(Protocol):
    """Some commands that belong together."""

    def handlers(self) -> Handlers:
        """Return what each action does, by the action's name."""

    def render(self, view: CurveView) -> None:
        """Check and enable the actions as the active curve and the selection have it."""


class LiveSet(CommandSet, Protocol):
    """Commands behind something that follows a drag frame by frame."""

    def follow(self, view: CurveView) -> None:
        """Show what belongs to `view`; called for every preview, hence quick where nothing is switched on."""
