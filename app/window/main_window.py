"""The window: builds, docks and connects its parts; restores its layout."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QSize, Qt, Signal
from PySide6.QtGui import (
    QCloseEvent,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDragMoveEvent,
    QDropEvent,
    QKeyEvent,
    QScreen,
)
from PySide6.QtWidgets import QApplication, QDialog, QDockWidget, QMainWindow, QSplitter, QTableView, QWidget

from ..actions.keymap import is_redundant, reason_disabled
from ..actions.qactions import Actions
from ..actions.state import ActionFacts, ClipboardWatch
from ..appearance.icons import app_icon
from ..appearance.theme import Theme, apply_theme, theme_of
from ..plotting.tool_plot import ToolPlot
from ..qt.overrides import ENTER, FieldShortcuts, SafeOverrides, application
from ..session import Session
from ..settings.preferences import Preferences
from ..state.window_state import Analysis, WindowState, WindowStore
from ..tasks.garbage import collect_between_events
from ..tasks.task import DelayedCall
from ..widgets.frames import room_on
from ..workbench.central_area import CentralArea
from ..workbench.context import WindowContext
from ..workbench.docks import Docks, declared_panels, hide_idle_docks
from ..workbench.document_files import DocumentFiles
from ..workbench.file_work import FileWork
from ..workbench.status_line import StatusLine
from .connect import COMMAND_SETS, Commands, Rendering
from .drops import accepted
from .menus import Menus
from .toolbar import Toolbar
from .window_commands import FocusCommands


class MainWindow(SafeOverrides, QMainWindow):
    """Window of one document.

    Attributes
    ----------
    context, commands
        The parts of the window; its command sets.
    canvas, basis_panel
        The two plots.
    asks_before_closing
        Whether closing asks about unsaved changes; not where the system is about to end.

    Signals
    -------
    closed
        The window is closed, and unsaved changes are saved or discarded.
    """

    closed = Signal()

    def __init__(
        self,
        session: Session,
        preferences: Preferences | None = None,
        command_sets: Sequence[type] = COMMAND_SETS,
    ) -> None:
        super().__init__()
        collect_between_events()
        self.session = session
        self.asks_before_closing = True
        self.preferences = preferences or Preferences()
        self._theme: Theme | None = None
        # First of all: panels read the palette when they are built.
        self._apply_theme()
        self.setWindowIcon(app_icon())
        self.setAcceptDrops(True)
        self._command_sets = command_sets
        self._build_state()
        self._build_parts()
        self.commands = Commands(self.context, self._command_sets)
        self.basis_panel = self.findChild(ToolPlot, "basisPanel")
        self.toolbar.fill(self.commands.widgets())
        self.context.docks.fill()
        self._connect()
        restore_layout(self, self.splitter, self.preferences)
        self._render_theme()
        self._rendering = Rendering(self.context, self.commands)
        self.actions_by_name.attach(self.splitter)
        self.central.fit()
        # Not the usual ranges: an open lesson may have set them.
        FirstShow(self, self.central.fit_again)

    # Building

    def _build_state(self) -> None:
        session = self.session
        self.store = WindowStore(self.preferences, self)
        self.analysis = Analysis(self.store, self)
        clipboard = ClipboardWatch(self)
        facts = ActionFacts(session, self.store, clipboard)
        self.actions_by_name = Actions(self, self._command_sets, facts)
        for changed in (
            self.store.changed,
            session.history_changed,
            session.file_changed,
            session.grips_changed,
            clipboard.changed,
        ):
            changed.connect(self.actions_by_name.follow)

    def _build_parts(self) -> None:
        session, actions = self.session, self.actions_by_name
        central = CentralArea(session, self)
        self.setCentralWidget(central.splitter)
        self.splitter, self.canvas, self.message_bar = central.splitter, central.canvas, central.message_bar
        self.central = central
        panels = [panel for commands in self._command_sets for panel, _build in declared_panels(commands)]
        docks = Docks(self, panels, self._build_dock)
        self.status_line = StatusLine(self)
        self.setStatusBar(self.status_line)
        self.menus = Menus(self, actions)
        self.menus.fill_with_panels(docks.all)
        self.toolbar = Toolbar(actions, self)
        self.addToolBar(self.toolbar)
        files = DocumentFiles(session, self.preferences, self, self.message_bar.warn)
        work = FileWork(session, self.message_bar.warn, self)
        files.beside = work.start
        self.context = WindowContext(
            session=session, store=self.store, preferences=self.preferences, analysis=self.analysis,
            actions=actions, files=files, work=work, window=self, central=self.central, docks=docks,
            toolbar=self.toolbar, status_line=self.status_line,
        )  # fmt: skip

    def _build_dock(self, name: str, *parent: QWidget) -> QWidget:
        # Command sets are created after the docks, which they fill.
        return self.commands.build_dock(name, *parent)

    @property
    def point_table(self) -> QTableView:
        """The table of points."""
        table = self.findChild(QTableView, "pointTable")
        assert table is not None
        return table

    # Connecting

    def _connect(self) -> None:
        session, files = self.session, self.context.files
        self.store.changed.connect(self._show_state)
        session.gesture_ended.connect(self.status_line.reset)
        session.ranges_returned.connect(self.canvas.camera.return_to)
        session.opened.connect(self.central.fit)
        session.opened.connect(self.canvas.tools.reset)
        readouts = self.status_line.readouts
        readouts.pixel_size = lambda: self.canvas.camera.pixel_size
        readouts.view = lambda: session.active_view
        self.canvas.pointed_at.connect(readouts.show_position)
        FieldShortcuts(self)
        self.menus.fill_with_files(self.preferences, files.open_beside, files.open_example)
        ends = (files.remember_rules, files.release, self.commands.close)
        for end in (*ends, self._remember_layout, self._close_dialogs):
            self.closed.connect(end)

    # Theme and layout

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.theme_mode is not before.theme_mode:
            self._apply_theme()
            self._render_theme()

    def open_file(self, path: Path) -> None:
        """Open a document, or show the reason why not."""
        self.context.files.open(path)

    def ask_before_closing(self) -> None:
        """Ask about unsaved changes when the window is closed, from now on."""
        self.asks_before_closing = True

    def _apply_theme(self) -> None:
        apply_theme(application(), self.preferences.theme_mode)

    def _render_theme(self) -> None:
        # Not the palette of the window, which is outdated until the window has been polished.
        theme = theme_of(QApplication.palette())
        if theme is self._theme:
            # The palette changes more than once, also at the start.
            return
        self._theme = theme
        self.actions_by_name.set_theme(theme)
        for part in (self.canvas, self.commands):
            part.set_theme(theme)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "commands"):
            self._render_theme()

    def _remember_layout(self) -> None:
        self.store.change(presentation=False)
        self.preferences.window_geometry = self.saveGeometry()
        self.preferences.window_state = self.saveState()
        self.preferences.splitter_state = self.splitter.saveState()
        hide_floating(self)

    # Qt's events

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.commands.escape()
            return
        if event.key() in ENTER and self.commands[FocusCommands].leave_field():
            return
        # An unused key may belong to a disabled action.
        disabled = self.actions_by_name.keymap.disabled_at(event.keyCombination())
        if disabled is not None:
            tell = self.session.say if is_redundant(disabled) else self.session.refuse
            tell(reason_disabled(disabled))
            return
        super().keyPressEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        files = accepted(event)
        if files is not None:
            self.status_line.show_tip(files.invitation)
        elif self.commands.drops.accepts_drawing(event):
            self.status_line.show_tip("Drop to add the drawing here")

    def dragMoveEvent(self, event: QDragMoveEvent) -> None:
        if accepted(event) is None:
            self.commands.drops.accepts_drawing(event)

    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        self.status_line.show_tip("")

    def dropEvent(self, event: QDropEvent) -> None:
        self.status_line.show_tip("")
        files = accepted(event)
        if files is not None:
            self.commands.drops.take(files)
        elif self.commands.drops.accepts_drawing(event):
            pixel = self.canvas.viewport().mapFrom(self, event.position().toPoint())
            self.commands.drops.take_drawing(event, self.canvas.to_plane(pixel))

    def closeEvent(self, event: QCloseEvent) -> None:
        if self.asks_before_closing and not self.context.files.may_discard():
            event.ignore()
            return
        event.accept()
        # From here on the window closes: if ending one part fails, the others still end.
        self.closed.emit()

    def _close_dialogs(self) -> None:
        for dialog in self.findChildren(QDialog):
            dialog.close()


_SIZE = QSize(1280, 860)
_LEAST = QSize(200, 150)
"""Smallest plausible size of a saved window."""


def restore_layout(window: QMainWindow, splitter: QSplitter, preferences: Preferences) -> None:
    """Restore the layout from the preferences; an invalid one is refused with a message.

    A place that is on no screen (any more) is not worth a word: the window opens at its usual size.
    """
    usual = first_size(window.screen())
    layout = window.layout()
    if layout is not None:
        # Else the minimum size is that of the parts while they were assembled.
        layout.activate()
    window.resize(usual)
    geometry, state = preferences.window_geometry, preferences.window_state
    is_restored = geometry.isEmpty() or window.restoreGeometry(geometry)
    if not is_restored or window.size() != window.size().expandedTo(_LEAST):
        window.resize(usual)
    if not state.isEmpty() and not window.restoreState(state):
        preferences.file.complain("window/state", "it is not a layout")
    parts = preferences.splitter_state
    if not parts.isEmpty() and not splitter.restoreState(parts):
        preferences.file.complain("window/splitter", "it is not a layout")
    hide_idle_docks(window)
    if floating_docks(window):
        FirstShow(window, lambda: _lift(window))


def first_size(screen: QScreen) -> QSize:
    """Return the size of the first window, which fits the screen with its frame."""
    return _SIZE.boundedTo(room_on(screen)).expandedTo(_LEAST)


def floating_docks(window: QMainWindow) -> list[QDockWidget]:
    """Return the floating docks that are not hidden."""
    return [dock for dock in window.findChildren(QDockWidget) if dock.isFloating() and not dock.isHidden()]


def hide_floating(window: QMainWindow) -> None:
    """Hide floating docks with their window; Qt leaves them on the screen while another window is open."""
    for dock in floating_docks(window):
        dock.hide()


class FirstShow(SafeOverrides, QObject):
    """Event filter that waits until a window is first shown."""

    def __init__(self, window: QMainWindow, act: Callable[[], None]) -> None:
        super().__init__(window)
        self._window, self._act = window, act
        self._soon = DelayedCall(self, 0, self._finish)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self._window and event.type() == QEvent.Type.Show:
            self._window.removeEventFilter(self)
            self._soon.start()
        return False

    def _finish(self) -> None:
        self._act()
        self.deleteLater()


def _lift(window: QMainWindow) -> None:
    """Raise floating docks above the window.

    Docks restored before the window is shown are behind it, where nobody finds them. Raising is not
    enough: only a dock that is shown after the window stays above it.
    """
    for dock in floating_docks(window):
        dock.hide()
        dock.show()
        dock.raise_()
