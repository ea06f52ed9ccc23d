"""Exceptions that nobody caught: the work is kept, the person is told once, and the program goes on."""

from __future__ import annotations

import logging
import sys
import threading
import traceback
from collections.abc import Callable, Collection
from types import TracebackType
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QApplication, QDialog

from .. import diagnostics
from .crash_report import place_of, report_of, signature_of

_log = logging.getLogger("curvebench.crash")

_MOST_DIALOGS = 5
"""Different faults that are shown in one run; whoever has seen these knows that something is wrong."""


class CrashHandler(QObject):
    """The interpreter's hooks for exceptions that nobody caught.

    The same fault is shown once, however often a paint or a timer runs into it again, and there is one
    dialog at a time. One that keeps a window open is shown each time that the window is asked to close: else
    nothing would happen then, and there would be no way out. What comes from another thread is shown by that
    of the window.

    Parameters
    ----------
    secure
        Writes a backup of everything unsaved; returns whether that was possible.
    private
        Returns the words that a report must not hold.

    Signals
    -------
    quit_asked
        The person wants the work saved and the program to end.
    interrupted
        Ctrl+C.
    """

    quit_asked = Signal()
    interrupted = Signal()
    _arrived = Signal(object)

    def __init__(
        self,
        secure: Callable[[], bool],
        private: Callable[[], Collection[str]],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._secure, self._private = secure, private
        self._seen: set[str] = set()
        self._waiting: list[str] = []
        self._dialog: QDialog | None = None
        self._hooks: tuple[Any, ...] = ()
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._show_next)
        self._arrived.connect(self._note)

    def install(self) -> None:
        """Take the interpreter's hooks."""
        self._hooks = (sys.excepthook, threading.excepthook, sys.unraisablehook)
        sys.excepthook = self._take
        threading.excepthook = self._take_from_thread
        sys.unraisablehook = self._take_unraisable

    def uninstall(self) -> None:
        """Give the interpreter's hooks back."""
        if self._hooks:
            sys.excepthook, threading.excepthook, sys.unraisablehook = self._hooks
            self._hooks = ()

    def _take(self, kind: type[BaseException], problem: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            self.interrupted.emit()
            return
        _print(kind, problem, trace)
        _log.error("%s in %s", kind.__qualname__, place_of(problem.with_traceback(trace)))
        # Into the thread of the window: only there may anybody look at what is open.
        self._arrived.emit(problem)

    def _take_from_thread(self, arguments: threading.ExceptHookArgs) -> None:
        problem = arguments.exc_value
        if problem is not None and not isinstance(problem, SystemExit):
            self._take(arguments.exc_type, problem, arguments.exc_traceback)

    def _take_unraisable(self, arguments: Any) -> None:  # noqa: ANN401 - sys.UnraisableHookArgs exists for checkers only
        # Raised while something was thrown away: nothing that the person did has failed, so no dialog.
        if arguments.exc_value is not None:
            _print(arguments.exc_type, arguments.exc_value, arguments.exc_traceback)
            _log.error("%s while something was thrown away", arguments.exc_type.__qualname__)

    def _note(self, problem: BaseException) -> None:
        """Queue a report, unless it is known; never raises, for who would catch that."""
        try:
            signature = signature_of(problem)
            if _keeps_window_open(problem):
                if self._dialog is not None or self._waiting:
                    return
            elif signature in self._seen or len(self._seen) >= _MOST_DIALOGS:
                return
            self._seen.add(signature)
            self._waiting.append(report_of(problem, self._private()))
        except Exception as another:
            _print(type(another), another, another.__traceback__)
        # Not from within: it may be a paint that failed.
        self._soon.start()

    def _show_next(self) -> None:
        if self._dialog is not None or not self._waiting:
            return
        is_safe = self._secure()
        dialog = diagnostics.crash_dialog.CrashDialog(
            QApplication.activeWindow(), self._waiting.pop(0), is_safe=is_safe
        )
        self._dialog = dialog
        dialog.quit_asked.connect(self.quit_asked)
        dialog.finished.connect(self._shown)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _shown(self) -> None:
        self._dialog = None
        self._soon.start()


def _keeps_window_open(problem: BaseException) -> bool:
    """Whether a window was asked to close and has failed to; see `overrides.SafeOverrides`."""
    return any(
        frame.f_code.co_name == "closeEvent" for frame, _line in traceback.walk_tb(problem.__traceback__)
    )


def _print(kind: type[BaseException], problem: BaseException, trace: TracebackType | None) -> None:
    """Write the whole traceback to the terminal, where there is one: for whoever works on the program."""
    if sys.stderr is not None:
        sys.__excepthook__(kind, problem, trace)
