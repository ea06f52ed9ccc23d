"""Actions New, Open, Save and Quit, and the progress of background work in the status line."""

from __future__ import annotations

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QMainWindow, QWidget

from ...actions.declaration import action, also
from ...actions.menus import EDIT_WORK, FILE_OPEN, FILE_QUIT, FILE_RECENT, FILE_SAVE, TOOLBAR
from ...actions.needs import Need
from ...document.limits import EditError
from ...qt.labels import Label
from ...widgets.boxes import row_of
from ...widgets.controls import ThinProgress, tool_button
from ...workbench.context import CommandSet, WindowContext
from .disk import DiskCommands


class DocumentCommands(CommandSet):
    """Actions on documents and their windows."""

    @action("newDocument", "New", FILE_OPEN, "Ctrl+N", "new")
    @also(TOOLBAR(10))
    def _new(self) -> None:
        """Start an empty document with the Add Points tool."""
        if self._context.files.elsewhere("newDocument") is not None:
            return
        self._context.files.new()
        if not self._context.session.active_curve.points:
            self._context.actions["addTool"].trigger()

    @action("newWindow", "New Window", FILE_OPEN, "Alt+Shift+N", "new-window", keywords="second beside")
    def _open_window(self) -> None:
        """Open another window with an empty document."""
        if self._context.files.open_window is None:
            raise EditError("This window is part of another program and cannot open a second window.")
        self._context.files.open_window("newDocument")

    @action("openDocument", "Open…", FILE_OPEN, "Ctrl+O", "open")
    @also(TOOLBAR(11))
    def _open(self) -> None:
        """Open a document."""
        self._context.files.ask_and_open()

    @action("clearRecent", "Clear Recent Files", FILE_RECENT, keywords="forget history privacy")
    def _clear_recent(self) -> None:
        """Clear the list of recent files; the files are not deleted."""
        self._context.preferences.clear_recent_files()
        self._context.session.say("The list of recent files is now empty.")

    @action("saveDocument", "Save", FILE_SAVE, "Ctrl+S", "save")
    @also(TOOLBAR(12))
    def _save(self) -> None:
        """Save the document."""
        self._context.files.save()

    @action("saveDocumentAs", "Save As…", FILE_SAVE, "Ctrl+Shift+S", "save-as")
    def _save_as(self) -> None:
        """Save the document under another name."""
        self._context.files.ask_and_save()

    @action("closeWindow", "Close", FILE_QUIT, "Ctrl+W", "close", full_name="Close Window")
    def _close(self) -> None:
        """Close the document and its window; closing the last window quits the program."""
        self._context.window.close()

    @action("quit", "Quit", FILE_QUIT, "Ctrl+Q", "quit")
    def _quit(self) -> None:
        """Close all windows; you are asked about unsaved changes first."""
        others = [
            window
            for window in QApplication.topLevelWidgets()
            if isinstance(window, QMainWindow) and window.isVisible() and window is not self._context.window
        ]
        all(window.close() for window in (self._context.window, *others))


class WorkCommands:
    """Action that stops background work, and its progress in the status line."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._bar: JobBar | None = None
        jobs = context.work.jobs
        jobs.begun.connect(lambda: context.store.change(is_working=True))
        jobs.shown.connect(self._show_bar)
        jobs.ended.connect(self._hide_bar)
        jobs.progressed.connect(self._show_share)

    @action(
        "cancelWork",
        "Stop Background Work",
        EDIT_WORK,
        "Ctrl+.",
        "stop",
        needs=Need("", lambda state: state.window.is_working, "Nothing is running."),
    )
    def _cancel(self) -> None:
        """Stop reading, writing or computing; the document does not change."""
        self._context.work.cancel()

    def _show_bar(self, title: str) -> None:
        if self._bar is None:
            self._bar = JobBar(self._context.actions["cancelWork"])
            self._context.status_line.insertPermanentWidget(1, self._bar)
        self._bar.begin(title)

    def _hide_bar(self) -> None:
        self._context.store.change(is_working=False)
        if self._bar is not None:
            self._bar.hide()

    def _show_share(self, share: float, _word: str) -> None:
        if self._bar is not None:
            self._bar.bar.show_share(share)


class JobBar(QWidget):
    """Progress of background work in the status line: a title, a bar and a button."""

    def __init__(self, cancel: QAction) -> None:
        super().__init__()
        self.setObjectName("jobBar")
        self._word = Label(name="jobWord")
        self.bar = ThinProgress("jobProgress", "Progress")
        words = cancel.text(), cancel.toolTip()
        self.button = tool_button("cancelJobButton", *words, text="Stop", icon_size=14, flat=True)
        self.button.clicked.connect(cancel.trigger)
        self._cancel = cancel
        # No higher than the labels beside it: the canvas must not change its size when the bar appears.
        self.button.setFixedHeight(self.fontMetrics().height() + 4)
        row_of(self._word, self.bar, self.button, margins=(6, 0, 6, 0), spacing=8, parent=self)
        self.hide()

    @property
    def text(self) -> str:
        """The title of the work."""
        return self._word.text()

    def begin(self, title: str) -> None:
        """Show the title of the work and an empty bar."""
        self._word.setText(title)
        self.bar.setValue(0)
        self.button.setIcon(self._cancel.icon())  # tinted for the theme of the moment
        self.show()


COMMAND_SETS = (DocumentCommands, WorkCommands, DiskCommands)
