"""The window: builds, docks and connects. Nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import (
    QCloseEvent,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDragMoveEvent,
    QDropEvent,
    QKeyEvent,
)
from PySide6.QtWidgets import (
    QApplication,
    QDialog,
    QMainWindow,
    QTableView,
    QWidget,
)

from ..actions.keymap import is_so_already, why_not
from ..actions.qactions import Actions
from ..actions.state import ActionFacts, ClipboardWatch
from ..appearance.icons import app_icon
from ..appearance.theme import Theme, apply_theme, theme_of
from ..document.model import Vector
from ..plotting.tool_plot import ToolPlot
from ..qt.keys import ENTER, FieldShortcuts
from ..qt.overrides import SafeOverrides
from ..session import Session
from ..settings.preferences import Preferences
from ..state.window_state import Analysis, WindowState, WindowStore
from ..tasks.garbage import collect_between_events
from ..workbench.central_area import CentralArea
from ..workbench.context import WindowContext
from ..workbench.docks import Docks, declared_panels
from ..workbench.document_files import DocumentFiles
from ..workbench.file_work import FileWork
from ..workbench.status_line import StatusLine
from .connect import COMMAND_SETS, Commands
from .drops import accepted
from .focus_commands import FocusCommands
from .menus import Menus
from .rendering import Rendering
from .toolbar import Toolbar
from .window_layout import hide_floating, restore_layout, when_first_shown


class MainWindow(SafeOverrides, QMainWindow):
    """One document in one window.

    Attributes
    ----------
    context, commands
        Its parts; what can be done with them.
    canvas, basis_panel
        The two plots.
    asks_before_closing
        Whether closing asks about unsaved changes; not where the system is about to end.

    Signals
    -------
    closed
        The window is closed, and what was not saved has been given up.
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
        # Not what is usual: a lesson may be open, which has chosen what is shown.
        when_first_shown(self, self.central.fit_again)

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
        panels = [panel for each in self._command_sets for panel, _build in declared_panels(each)]
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
        # Commands are made later than docks; what they fill is asked of them.
        return self.commands.build_dock(name, *parent)

    @property
    def point_table(self) -> QTableView:
        """The numbers of the points."""
        table = self.findChild(QTableView, "pointTable")
        assert table is not None
        return table

    # Connecting

    def _connect(self) -> None:
        session, files = self.session, self.context.files
        self.store.changed.connect(self._show_state)
        session.interrupted.connect(self.status_line.reset)
        session.opened.connect(self.central.fit)
        session.opened.connect(self.canvas.tools.reset)
        self.canvas.pointed_at.connect(self.status_line.readouts.show_place)
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
        """Open a document, or say why not."""
        self.context.files.open(path)

    def ask_before_closing(self) -> None:
        """Ask about unsaved changes when the window is closed, from now on."""
        self.asks_before_closing = True

    def _apply_theme(self) -> None:
        app = QApplication.instance()
        assert isinstance(app, QApplication)
        apply_theme(app, self.preferences.theme_mode)

    def _render_theme(self) -> None:
        # Not the window's own palette: that is behind until the window has been polished.
        theme = theme_of(QApplication.palette())
        if theme is self._theme:
            # A palette is told more than once, at the start too.
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
        # What has been used by nobody: the keys of an action that is disabled, for one.
        disabled = self.actions_by_name.keymap.disabled_at(event.keyCombination())
        if disabled is not None:
            tell = self.session.say if is_so_already(disabled) else self.session.refuse
            tell(why_not(disabled))
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
            self.commands.drops.take_drawing(event, self._place_of(event))

    def _place_of(self, event: QDropEvent) -> Vector:
        return self.canvas.to_plane(self.canvas.viewport().mapFrom(self, event.position().toPoint()))

    def closeEvent(self, event: QCloseEvent) -> None:
        if self.asks_before_closing and not self.context.files.may_discard():
            event.ignore()
            return
        event.accept()
        # From here on nothing keeps the window open: where one of its parts fails to end, the others do.
        self.closed.emit()

    def _close_dialogs(self) -> None:
        for dialog in self.findChildren(QDialog):
            dialog.close()
