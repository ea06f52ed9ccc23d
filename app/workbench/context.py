"""Context of command sets: the parts of a window, and the protocols by which sets take part in it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Protocol, runtime_checkable

import msgspec
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMainWindow, QToolBar

from app.actions.qactions import Actions
from app.appearance.theme import Theme
from app.plotting.tool_plot import ToolPlot
from app.session import Session
from app.settings.preferences import Preferences
from app.state.analysis import Analysis
from app.state.window_state import WindowStore
from app.view_model.curve_view import CurveView
from app.workbench.central_area import CentralArea
from app.workbench.docks import Docks
from app.workbench.document_files import DocumentFiles
from app.workbench.file_work import FileWork
from app.workbench.status_line import StatusLine


class WindowContext(msgspec.Struct, frozen=True):
    """Parts of a window that its commands act on.

    Attributes
    ----------
    session, store, preferences
        The document; the window's state; what is remembered between starts.
    analysis
        Overlays, plots and laboratory, which are a part of the window's state.
    actions
        All actions of the window.
    files, work
        Opening and saving; what is read and written beside the window.
    window, central, docks, toolbar, status_line
        The window and its parts.
    """

    session: Session
    store: WindowStore
    preferences: Preferences
    analysis: Analysis
    actions: Actions
    files: DocumentFiles
    work: FileWork
    window: QMainWindow
    central: CentralArea
    docks: Docks
    toolbar: QToolBar
    status_line: StatusLine

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return self.central.cancel_gesture() or (self.session.is_previewing and self.session.interrupt())

    def connect_plot(self, plot: ToolPlot) -> None:
        """Let the status line say what the mouse does on a plot, and keep that true.

        What a press would do changes with every step, also under a pointer that rests.
        """
        session, line = self.session, self.status_line
        plot.hint_changed.connect(line.show_hint)
        plot.progress_changed.connect(line.show_progress)
        plot.gesture_began.connect(line.begin_gesture)
        session.interrupted.connect(plot.abandon_gesture)
        for changed in (session.history_changed, session.active_changed):
            # Later, when everything has been drawn that has changed.
            changed.connect(plot.hover_again, Qt.ConnectionType.QueuedConnection)


@runtime_checkable
class Follows(Protocol):
    """A command set behind something that follows a drag frame by frame."""

    def follow(self, view: CurveView) -> None:
        """Show what belongs to `view`; called for every preview, hence quick where nothing is switched on."""


@runtime_checkable
class Renders(Protocol):
    """A command set that shows something at the pace of the panels."""

    def render(self, view: CurveView) -> None:
        """Show what the active curve and the selection have it."""


@runtime_checkable
class Imports(Protocol):
    """A command set that imports files of other formats."""

    def import_files(self, paths: Iterable[Path]) -> None:
        """Import these, one after the other."""


@runtime_checkable
class Traces(Protocol):
    """A command set that puts pictures behind the curves."""

    def trace(self, path: Path) -> None:
        """Put this picture there, or say why not."""


@runtime_checkable
class StepsBack(Protocol):
    """A command set that knows where Escape leads, where nothing else takes it."""

    def escape(self) -> None:
        """Step back."""


@runtime_checkable
class Themed(Protocol):
    """A command set with a panel that takes the colours of a theme."""

    def set_theme(self, theme: Theme) -> None:
        """Take them."""


@runtime_checkable
class Closes(Protocol):
    """A command set that has something to end before the window goes."""

    def close(self) -> None:
        """End it."""
