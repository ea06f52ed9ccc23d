"""New, open, save and quit."""

from __future__ import annotations

from PySide6.QtWidgets import QApplication, QMainWindow

from ...actions.declaration import action, also
from ...actions.menus import FILE_OPEN, FILE_QUIT, FILE_RECENT, FILE_SAVE, TOOLBAR
from ...document.limits import EditError
from ...workbench.context import WindowContext
from .work_commands import WorkCommands


class DocumentCommands:
    """Actions on the document as a whole."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context

    @action("newDocument", "New", FILE_OPEN, "Ctrl+N", "new")
    @also(TOOLBAR(10))
    def _new(self) -> None:
        """Start an empty document, with the pen in hand."""
        if self._context.files.elsewhere("newDocument") is not None:
            return
        self._context.files.new()
        if not self._context.session.active_curve.points:
            self._context.actions["addTool"].trigger()

    @action("newWindow", "New Window", FILE_OPEN, "Alt+Shift+N", "new-window", keywords="second beside")
    def _open_window(self) -> None:
        """Open another window with an empty document, beside this one."""
        if self._context.files.open_window is None:
            raise EditError("Another program keeps this window, and opens no second one.")
        self._context.files.open_window("newDocument")

    @action("openDocument", "Open…", FILE_OPEN, "Ctrl+O", "open")
    @also(TOOLBAR(11))
    def _open(self) -> None:
        """Open a document."""
        self._context.files.ask_and_open()

    @action("clearRecent", "Clear Recent Files", FILE_RECENT, keywords="forget history privacy")
    def _clear_recent(self) -> None:
        """Forget which files were open lately; the files stay."""
        self._context.preferences.clear_recent_files()
        self._context.session.say("The list of recent files is empty now.")

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
        """Close this document and its window; the last one ends the program."""
        self._context.window.close()

    @action("quit", "Quit", FILE_QUIT, "Ctrl+Q", "quit")
    def _quit(self) -> None:
        """Close all windows, this one first, unless the question about changes keeps one open."""
        others = [
            each
            for each in QApplication.topLevelWidgets()
            if isinstance(each, QMainWindow) and each.isVisible() and each is not self._context.window
        ]
        all(window.close() for window in (self._context.window, *others))


COMMAND_SETS = (DocumentCommands, WorkCommands)
