"""Windows of the editor, and the life of the program around them: backups, signals, crashes, its end."""

from __future__ import annotations

import faulthandler
import gc
import logging
import signal
import socket
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import FrameType
from typing import IO, Any

from PySide6.QtCore import QMargins, QObject, QPoint, QSocketNotifier, QTimer
from PySide6.QtWidgets import QApplication

from .. import diagnostics
from ..diagnostics.crash_handler import CrashHandler, versions
from ..diagnostics.slow_frames import SlowFrames
from ..document.model import Document
from ..features.lessons.commands import LessonCommands
from ..features.recovery.autosave import Autosave, snapshot_folder, state_folder
from ..features.recovery.commands import RecoveryCommands
from ..session import DocumentOrigin, Session
from ..storage.open_file import is_large
from ..tasks.garbage import collect_between_events
from ..tasks.task import DelayedCall
from ..window.given_files import given_files
from ..window.main_window import MainWindow
from ..workbench.document_files import DocumentFiles


def open_windows(files: Sequence[str], problems: Sequence[str] = (), lesson: str = "") -> list[MainWindow]:
    """Show a window for every document; without any file one with the first sketch.

    A large document is read beside its window, which is empty until then, and stays so if it is refused.

    The first window imports the other files as it imports a drop, shows the problems of others, as
    sentences in `problems`, and opens the lesson.
    """
    others = given_files(map(Path, files))
    documents = [Path(path) for path in files if Path(path) in others.documents]
    large = {path for path in documents if is_large(path)}
    sessions = [Session() for _ in documents] or [Session()]
    for session, path in zip(sessions, documents, strict=False):
        if path not in large:
            session.open(path)
    windows = [MainWindow(session) for session in sessions]
    if files:
        # A sketch would look like the content of the file that they wait for.
        for session in sessions:
            if session.files.is_untouched:
                session.files.new()
    for window in windows:
        window.show()
    for window, path in zip(windows, documents, strict=False):
        if path in large:
            window.open_file(path)
    imports = others.imports
    if imports and not others.documents and not others.pictures:
        # The curves shall not be added to a sketch.
        windows[0].open_file(imports[0])
        imports = imports[1:]
    windows[0].commands.drops.take(replace(others, documents=(), imports=imports), problems)
    if lesson:
        windows[0].commands[LessonCommands].open(lesson)
    return windows


def run(application: QApplication, windows: list[MainWindow]) -> int:
    """Run the windows until the last is closed, and return the exit code."""
    lifecycle = Lifecycle(application, windows)
    windows.clear()  # or this list would keep closed windows
    lifecycle.start()
    code = int(application.exec())
    lifecycle.stop()
    return code


# What surrounds the windows


_log = logging.getLogger("curvebench.lifecycle")

_SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGTERM", "SIGHUP", "SIGINT", "SIGBREAK") if hasattr(signal, name)
)
_LOG_FILE_MS = 1000
"""Milliseconds until the log goes to its file, too: until then it is in memory."""

_ASIDE = 40
"""Pixels that a new window lies beside the one that it was asked for in."""

_FIRST_SIGNAL_CODE = 128
"""Sum of this and a signal's number: the exit code of a program that the signal ended."""


class Lifecycle(QObject):
    """Keeper of the work of some windows, however the program ends.

    Parameters
    ----------
    application
        The running application.
    windows
        All windows; the first one offers what was not saved when the program last ended.
    """

    def __init__(self, application: QApplication, windows: list[MainWindow]) -> None:
        super().__init__()
        self._application = application
        self._autosaves: dict[MainWindow, Autosave] = {}
        self._signals = SignalWatch(self.end, self)
        self._faults = FaultFile()
        self._log_file: diagnostics.log_file.LogFile | None = None
        self._log_due = DelayedCall(self, _LOG_FILE_MS, self._open_log_file)
        self.crashes = CrashHandler(self.write_now, self._private_words, self)
        self.crashes.quit_asked.connect(self._save_and_quit)
        self.crashes.interrupted.connect(lambda: self.end(signal.SIGINT))
        for window in windows:
            self._watch(window)

    def _watch(self, window: MainWindow) -> None:
        autosave = self._autosaves[window] = Autosave(window.session, snapshot_folder(), self)
        SlowFrames(window.session.document_changed, window.canvas.painted, window)
        window.commands[RecoveryCommands].keep_with(autosave, self._open_beside)
        window.commands.drops.open_window = self._open_window
        window.context.files.open_window = partial(self._open_empty, window)
        window.context.files.show_elsewhere = partial(self._show_open, window)
        window.closed.connect(lambda: self._finish(window))
        # A change means that the end of the session was called off.
        window.session.history_changed.connect(window.ask_before_closing)

    def _open_beside(self, document: Document, path: Path | None, origin: DocumentOrigin) -> Autosave:
        """Continue unsaved work in another window, and return its autosave."""
        session = Session()
        session.files.restore(document, path, origin)
        return self._autosaves[self._show(session)]

    def _open_window(self, path: Path) -> None:
        """Open a document in another window, as one of the command line."""
        session = Session()
        session.open(path)
        self._show(session)

    def _open_empty(self, beside: MainWindow, action: str) -> DocumentFiles:
        """Open another window beside one that stays visible, and trigger an action in it."""
        window = self._show(Session())
        if beside.isMaximized():
            window.showMaximized()
        else:
            _move_beside(window, beside)
        if action:
            window.context.actions[action].trigger()
        return window.context.files

    def _show_open(self, asked_in: MainWindow, path: Path) -> bool:
        """Bring another window that has a file to the front; return whether there is one."""
        for window in self._autosaves:
            here = window.session.files.path
            if window is not asked_in and here is not None and here.absolute() == path.absolute():
                window.raise_()
                window.activateWindow()
                return True
        return False

    def _show(self, session: Session) -> MainWindow:
        window = MainWindow(session)
        self._watch(window)
        window.show()
        return window

    def start(self) -> None:
        """Install the handlers of signals and crashes, and offer the work that was not saved last time."""
        # Python's own collector was off while the windows were made, see `start.no_garbage_sought`.
        collect_between_events()
        _log.info("started: %s", versions().replace("\n", "; "))
        self._log_due.start()
        self._faults.open()
        self._signals.start()
        self.crashes.install()
        self._application.commitDataRequest.connect(self.prepare_for_end)
        # After the first frame: reading left-over snapshots takes a moment.
        QTimer.singleShot(0, self, self._offer)

    def _offer(self) -> None:
        for window in list(self._autosaves)[:1]:
            window.commands[RecoveryCommands].offer_unsaved_work()

    def _open_log_file(self) -> None:
        with suppress(OSError):
            self._log_file = diagnostics.log_file.LogFile(state_folder())

    def stop(self) -> None:
        """Undo `start`."""
        self._application.setQuitOnLastWindowClosed(True)
        self._application.commitDataRequest.disconnect(self.prepare_for_end)
        self.crashes.uninstall()
        self._signals.stop()
        self._faults.close()
        _log.info("ended")
        if self._log_due.isActive():
            self._log_due.stop()
            self._open_log_file()
        if self._log_file is not None:
            self._log_file.close()

    def write_now(self) -> bool:
        """Write a backup of all unsaved work; return whether that was possible."""
        outcomes = [autosave.write_now() for autosave in self._autosaves.values()]
        return all(outcomes)

    def prepare_for_end(self, _manager: object = None) -> None:
        """Write a backup of all unsaved work; a window with a backup closes without a question.

        The system calls this before it ends, and may not close the windows afterwards.
        """
        for window, autosave in self._autosaves.items():
            window.session.files.check()
            window.asks_before_closing = not autosave.write_now()

    def end(self, number: int = 0) -> None:
        """Keep everything unsaved for the next start, and end the program; `number` is that of a signal."""
        _log.info("asked to end, signal %d", number)
        self.prepare_for_end()
        for window in self._autosaves:
            window.asks_before_closing = False  # nobody may be there to answer
        self._application.setQuitOnLastWindowClosed(False)
        for window in list(self._autosaves):
            window.close()
        self._application.exit(_FIRST_SIGNAL_CODE + number if number else 0)

    def _finish(self, window: MainWindow) -> None:
        autosave = self._autosaves.pop(window, None)
        if autosave is None:
            return
        if window.asks_before_closing:
            autosave.finish()  # the user was asked, and discarded what is not saved
        else:
            autosave.leave()
        # None has a parent that is deleted with the window, and their connections live as long as they do.
        for owner in (window, window.session, autosave):
            owner.deleteLater()
        # Objects of the start are exempt from garbage collection, see `start.no_garbage_sought`.
        gc.unfreeze()

    def _save_and_quit(self) -> None:
        """Save the documents that have a file; the next start offers the others."""
        for window in self._autosaves:
            session = window.session
            session.cancel()
            if session.files.path is not None and session.files.is_modified:
                window.actions_by_name["saveDocument"].trigger()
                if session.files.is_modified:
                    return  # the window says why
        if self.write_now():
            self.end()

    def _private_words(self) -> list[str]:
        paths = [window.session.files.path for window in self._autosaves]
        return [word for path in paths if path is not None for word in _names_of(path)]


class SignalWatch(QObject):
    """Bridge for the signals that end a program into Qt's event loop.

    Python runs a handler only between two of its own instructions, and while nothing happens in the window
    there are none; a byte in a socket wakes the loop.
    """

    def __init__(self, end: Any, parent: QObject | None = None) -> None:  # noqa: ANN401
        super().__init__(parent)
        self._end = end
        self._handlers: dict[int, Any] = {}
        self._sender, self._receiver = socket.socketpair()
        self._sender.setblocking(False)
        self._receiver.setblocking(False)
        self._old_descriptor = -1
        self._notifier = QSocketNotifier(self._receiver.fileno(), QSocketNotifier.Type.Read, self)
        self._notifier.activated.connect(self._receive)

    def start(self) -> None:
        """Install the handlers."""
        self._old_descriptor = signal.set_wakeup_fd(self._sender.fileno(), warn_on_full_buffer=False)
        self._handlers = {number: signal.signal(number, _leave_to_event_loop) for number in _SIGNALS}

    def stop(self) -> None:
        """Restore the old handlers."""
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(self._old_descriptor)
        self._notifier.setEnabled(False)
        self._sender.close()
        self._receiver.close()

    def _receive(self) -> None:
        with suppress(BlockingIOError):
            numbers = self._receiver.recv(64)
            if numbers:
                self._end(numbers[0])


class FaultFile:
    """Output of the fault handler, for when the process itself breaks down.

    To the terminal where there is one, else to a file in the folder of the program's state.
    """

    def __init__(self) -> None:
        self._file: IO[str] | None = None
        self._is_ours = False

    def open(self) -> None:
        """Enable the fault handler, unless somebody has already."""
        if faulthandler.is_enabled():
            return
        with suppress(OSError, ValueError):
            if sys.stderr is None:
                state_folder().mkdir(mode=0o700, parents=True, exist_ok=True)
                self._file = (state_folder() / "faults.txt").open("a", encoding="utf-8")
            faulthandler.enable(self._file or sys.stderr)
            self._is_ours = True

    def close(self) -> None:
        """Disable it again."""
        if self._is_ours:
            faulthandler.disable()
        if self._file is not None:
            self._file.close()


def _leave_to_event_loop(number: int, _frame: FrameType | None) -> None:
    """Leave a signal to the event loop; the next one ends the process, in case the loop hangs."""
    signal.signal(number, signal.SIG_DFL)


def _names_of(path: Path) -> tuple[str, ...]:
    return (str(path), str(path.absolute()), str(path.parent.absolute()), path.name, path.name.split(".")[0])


def _move_beside(window: MainWindow, beside: MainWindow) -> None:
    """Put a window a step below and right of another, of its size, but no further off the screen."""
    frame = beside.frameGeometry()
    room = beside.screen().availableGeometry().united(frame).bottomRight() - frame.bottomRight()
    over = QPoint(_ASIDE, _ASIDE) - room
    window.resize(beside.size().shrunkBy(QMargins(0, 0, max(over.x(), 0), max(over.y(), 0))))
    window.move(beside.pos() + QPoint(_ASIDE, _ASIDE))
