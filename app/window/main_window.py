"""The window: builds, docks and connects. Nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, Qt, QTimer, Signal
from PySide6.QtGui import (
    QCloseEvent,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDragMoveEvent,
    QDropEvent,
    QKeyEvent,
    QStatusTipEvent,
)
from PySide6.QtWidgets import (
    QApplication,
    QDialog,
    QMainWindow,
    QTableView,
    QWidget,
)

from app.actions.clipboard_watch import ClipboardWatch
from app.actions.qactions import Actions
from app.actions.situation import Situation
from app.appearance.icons import app_icon
from app.appearance.theme import Theme, apply_theme, theme_of
from app.plotting.tool_plot import ToolPlot
from app.qt.overrides import Guarded
from app.session import Message, MessageKind, Session
from app.settings.preferences import Preferences
from app.state.analysis import Analysis
from app.state.window_state import WindowState, WindowStore
from app.view_model.curve_view import CurveView
from app.window.connect import COMMAND_SETS, Commands
from app.window.drops import accepted
from app.window.menus import Menus
from app.window.toolbar import Toolbar
from app.window.window_layout import hide_floating, restore_layout, when_first_shown
from app.workbench.central_area import CentralArea
from app.workbench.context import WindowContext
from app.workbench.docks import Docks, declared_panels
from app.workbench.document_files import DocumentFiles, title_of
from app.workbench.file_work import FileWork
from app.workbench.status_line import StatusLine

_PANELS_MS = 100
"""How far the panels may lag behind a drag, in milliseconds; the canvas and the functions never do."""


class MainWindow(Guarded, QMainWindow):
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
        self.session = session
        self.asks_before_closing = True
        self.preferences = preferences or Preferences()
        self._theme: Theme | None = None
        # What the panels show; behind the session while it tells that what was selected is there no more.
        self._rendered: CurveView | None = None
        # First of all: panels read the palette when they are built.
        self._apply_theme()
        self.setWindowIcon(app_icon())
        self.setAcceptDrops(True)
        self._command_sets = command_sets
        self.store = WindowStore(self.preferences, self)
        clipboard = ClipboardWatch(self)
        now = Situation(session, self.store, clipboard)
        self.actions_by_name = Actions(self, command_sets, now)
        for changed in (self.store.changed, session.history_changed, clipboard.changed):
            changed.connect(self.actions_by_name.render)
        self.analysis = Analysis(self.store, self)
        self._build_plots()
        self._build_docks()
        self._build_bars()
        self._panels_due = QTimer(self, singleShot=True, interval=_PANELS_MS)
        self._panels_due.timeout.connect(self._render_panels)
        files = DocumentFiles(session, self.preferences, self, self.message_bar.warn)
        work = FileWork(session, self.message_bar.warn, self)
        files.beside = work.start
        self.context = self._make_context(files, work)
        self.commands = Commands(self.context, self._command_sets)
        self.basis_panel = self.findChild(ToolPlot, "basisPanel")
        self.toolbar.fill(self.commands.widgets())
        self._docks.fill()
        self._connect()
        self._connect_end()
        restore_layout(self, self.splitter, self.preferences)
        self._render_theme()
        self._render_document()
        self._render_file()
        if self.session.path is None and not self.session.files.beginning.title:
            # Who opens a document came to work on it.
            self.commands.messages.greet()
        if self.preferences.complaint:
            self.status_line.refuse(self.preferences.complaint)
        self.actions_by_name.attach(self)
        self.central.fit()
        # Not what is usual: a lesson may be open, which has chosen what is shown.
        when_first_shown(self, self.central.fit_again)

    # Building

    def _build_plots(self) -> None:
        central = CentralArea(self.session, self)
        self.setCentralWidget(central.splitter)
        self.splitter, self.canvas, self.message_bar = central.splitter, central.canvas, central.message_bar
        self.central = central

    def _build_docks(self) -> None:
        panels = [panel for each in self._command_sets for panel, _build in declared_panels(each)]
        self._docks = Docks(self, panels, self._build_dock)

    def _build_dock(self, name: str, *parent: QWidget) -> QWidget:
        # Commands are made later than docks; what they fill is asked of them.
        return self.commands.build_dock(name, *parent)

    def _build_bars(self) -> None:
        self.status_line = StatusLine(self)
        self.setStatusBar(self.status_line)
        self.menus = Menus(self, self.actions_by_name)
        self.menus.fill_with_panels(self._docks.all)
        self.toolbar = Toolbar(self.actions_by_name, self)
        self.addToolBar(self.toolbar)

    def _make_context(self, files: DocumentFiles, work: FileWork) -> WindowContext:
        return WindowContext(
            session=self.session,
            store=self.store,
            preferences=self.preferences,
            analysis=self.analysis,
            actions=self.actions_by_name,
            files=files,
            work=work,
            window=self,
            central=self.central,
            docks=self._docks,
            toolbar=self.toolbar,
            status_line=self.status_line,
        )

    @property
    def point_table(self) -> QTableView:
        """The numbers of the points."""
        table = self.findChild(QTableView, "pointTable")
        assert table is not None
        return table

    # Connecting

    def _connect(self) -> None:
        session = self.session
        self.store.changed.connect(self._show_state)
        session.document_changed.connect(self._render_document)
        session.active_changed.connect(self._render_document)
        session.selection_changed.connect(self._render_selection)
        session.selected_curves_changed.connect(self._render_selected_curves)
        session.hovered_changed.connect(self.canvas.drawing.set_hovered)
        session.scrub_changed.connect(self._render_scrub)
        session.file_changed.connect(self._render_file)
        session.interrupted.connect(self.status_line.forget)
        session.opened.connect(self.central.fit)
        session.opened.connect(self.canvas.tools.reset)
        session.message.connect(self._tell)
        self.canvas.pointed_at.connect(self.status_line.show_place)
        self.menus.fill_with_files(self.preferences, self.context.files.open, self.context.files.open_example)
        session.history_changed.connect(self._render_file)

    def _connect_end(self) -> None:
        for end in (
            self.context.files.release,
            self.commands.close,
            self._remember_layout,
            self._close_dialogs,
        ):
            self.closed.connect(end)

    # Rendering: from values to widgets, never back

    def _render_document(self) -> None:
        view = self._rendered = self.session.active_view
        self.canvas.render_view(view)
        self.canvas.render_others(self.session.views, self.session.active_index, self.session.selected_curves)
        self.commands.follow(view)
        if not self.session.is_previewing:
            self._render_panels()
        elif not self._panels_due.isActive():
            self._panels_due.start()

    def _render_panels(self) -> None:
        """Render what need not follow a drag frame by frame."""
        self._panels_due.stop()
        view = self.session.active_view
        self.commands.render(view)

    def _render_selection(self, selection: frozenset[int]) -> None:
        self.canvas.set_selection(selection)
        self._render_commands()

    def _render_selected_curves(self, chosen: frozenset[int]) -> None:
        session = self.session
        self.canvas.render_others(session.views, session.active_index, chosen)
        self.canvas.hover_again()
        self._render_commands()

    def _render_commands(self) -> None:
        """Check and enable actions; those of a document that the panels do not show yet, together with it."""
        view = self.session.active_view
        if view is self._rendered:
            self.commands.render(view)

    def _render_scrub(self, t: float | None) -> None:
        self.canvas.drawing.set_scrub(t)
        self.status_line.show_scrub(t)
        self.commands.follow_scrub(t)

    def _render_file(self) -> None:
        path = self.session.path
        name = title_of(self.session).replace("[*]", "[*][*]")
        self.setWindowFilePath(str(path) if path is not None else "")
        read_only = " (read-only)" if self.session.files.is_read_only else ""
        self.setWindowTitle(f"{name}[*]{read_only} – Curvebench")
        if self.isWindowModified() != self.session.is_modified:
            # Qt writes the title anew, whatever is there.
            self.setWindowModified(self.session.is_modified)

    def _tell(self, message: Message) -> None:
        match message.kind:
            case MessageKind.SAID:
                self.status_line.say(message.text)
            case MessageKind.REFUSED:
                self.status_line.refuse(message.text)
            case MessageKind.OFFERED:
                self._offer(message.text, message.action)

    def _offer(self, text: str, action: str) -> None:
        self._render_commands()
        self.status_line.clear_message()
        self.commands.messages.offer(text, self.actions_by_name[action])

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
        for part in (self.canvas, self.message_bar, self.commands):
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

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QStatusTipEvent):
            # Qt's own way hides what stands in the status line, for good where a button goes away.
            self.status_line.show_tip(event.tip())
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.commands.escape()
            return
        # What has been used by nobody: the keys of an action that is disabled, for one.
        if why_not := self.actions_by_name.keymap.why_not(event.keyCombination()):
            self.session.refuse(why_not)
            return
        super().keyPressEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        files = accepted(event)
        if files is not None:
            self.status_line.show_tip(files.invitation)

    def dragMoveEvent(self, event: QDragMoveEvent) -> None:
        accepted(event)

    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        self.status_line.show_tip("")

    def dropEvent(self, event: QDropEvent) -> None:
        self.status_line.show_tip("")
        files = accepted(event)
        if files is not None:
            self.commands.drops.take(files)

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
