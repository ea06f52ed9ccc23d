"""Uncaught exceptions: the work is backed up, a dialog is shown once, and the program continues.

`CrashHandler` takes the interpreter's hooks and shows the crash dialog; `report_of` writes the report for the
makers, without names of files and folders.
"""

from __future__ import annotations

import logging
import platform
import re
import sys
import threading
import traceback
from collections.abc import Callable, Collection
from pathlib import Path
from types import TracebackType
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QApplication, QDialog

from .. import __version__, diagnostics
from .log import last_lines

_log = logging.getLogger("curvebench.crash")

_MOST_DIALOGS = 5
"""Largest number of different errors that are shown in one run."""


class CrashHandler(QObject):
    """Hooks of the interpreter for uncaught exceptions.

    The same error is shown once, however often a paint or a timer repeats it, in one dialog at a time. An
    error that keeps a window open is shown each time that the window is closed: otherwise nothing would seem
    to happen. Exceptions of other threads are shown by the window's thread.

    Parameters
    ----------
    secure
        Function that backs up all unsaved work; returns whether that was possible.
    private
        Function that returns the words that a report must not contain.

    Signals
    -------
    quit_asked
        The person wants to save the work and quit.
    interrupted
        Ctrl+C was pressed in the terminal.
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
        self._signatures: set[str] = set()
        self._waiting: list[str] = []
        self._dialog: QDialog | None = None
        self._hooks: tuple[Any, ...] = ()
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self._show_next)
        self._arrived.connect(self._note)

    def install(self) -> None:
        """Install the hooks of the interpreter."""
        self._hooks = (sys.excepthook, threading.excepthook, sys.unraisablehook)
        sys.excepthook = self._take
        threading.excepthook = self._take_from_thread
        sys.unraisablehook = self._take_unraisable

    def uninstall(self) -> None:
        """Restore the former hooks of the interpreter."""
        if self._hooks:
            sys.excepthook, threading.excepthook, sys.unraisablehook = self._hooks
            self._hooks = ()

    def _take(self, kind: type[BaseException], problem: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            self.interrupted.emit()
            return
        _print(kind, problem, trace)
        _log.error("%s in %s", kind.__qualname__, place_of(problem.with_traceback(trace)))
        # Continue in the window's thread: only there may documents be accessed.
        self._arrived.emit(problem)

    def _take_from_thread(self, arguments: threading.ExceptHookArgs) -> None:
        problem = arguments.exc_value
        if problem is not None and not isinstance(problem, SystemExit):
            self._take(arguments.exc_type, problem, arguments.exc_traceback)

    def _take_unraisable(self, arguments: Any) -> None:  # noqa: ANN401 - sys.UnraisableHookArgs exists for checkers only
        # Raised while an object was destroyed: no action of the person has failed, so no dialog.
        if arguments.exc_value is not None:
            _print(arguments.exc_type, arguments.exc_value, arguments.exc_traceback)
            _log.error("%s while an object was destroyed", arguments.exc_type.__qualname__)

    def _note(self, problem: BaseException) -> None:
        """Queue a report unless the error is known; never raises, because nothing would catch that."""
        try:
            signature = signature_of(problem)
            if _keeps_window_open(problem):
                if self._dialog is not None or self._waiting:
                    return
            elif signature in self._signatures or len(self._signatures) >= _MOST_DIALOGS:
                return
            self._signatures.add(signature)
            self._waiting.append(report_of(problem, self._private()))
        except Exception as another:
            _print(type(another), another, another.__traceback__)
        # Later, because a paint may have failed.
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
        dialog.finished.connect(self._forget_dialog)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def _forget_dialog(self) -> None:
        self._dialog = None
        self._soon.start()


def _keeps_window_open(problem: BaseException) -> bool:
    """Return whether the exception kept a window from closing; see `overrides.SafeOverrides`."""
    return any(
        frame.f_code.co_name == "closeEvent" for frame, _line in traceback.walk_tb(problem.__traceback__)
    )


def _print(kind: type[BaseException], problem: BaseException, trace: TracebackType | None) -> None:
    """Write the complete traceback to the terminal, if there is one, for developers."""
    if sys.stderr is not None:
        sys.__excepthook__(kind, problem, trace)


# Report

_LIBRARIES = ("PySide6", "pyqtgraph", "numpy", "msgspec")
_PACKAGES = re.compile(r".*[\\/](?:site-packages|dist-packages|python3\.\d+|Lib)[\\/]")
_FILE = re.compile(r'(?<=File ")([^"\n]+)(?=", line)')
_PATH = re.compile(r"(?<![\w.])(?:[A-Za-z]:)?(?:[\\/][^\s\\/'\"“”<>|:]+){2,}")
_QUOTED = re.compile("“[^”]*”")
"""Names of files and curves in messages of the program."""

_PROGRAM = Path(__file__).resolve().parents[1]
_ROOT = _PROGRAM.parent
_SHORTEST_NAME = 3
_LONGEST = 20_000


def report_of(problem: BaseException, private: Collection[str] = ()) -> str:
    """Return the report about an exception.

    Parameters
    ----------
    problem
        The exception.
    private
        Words that must not appear, such as the names of open files.
    """
    trace = "".join(traceback.format_exception(problem))
    text = without_names(with_short_files(trace), private)
    if len(text) > _LONGEST:  # endless recursion
        text = f"{text[: _LONGEST // 2]}\n…\n{text[-_LONGEST // 2 :]}"
    lines = without_names("\n".join(last_lines()), private)
    return f"{versions()}\n\n{text.rstrip()}\n\n{lines}".rstrip() + "\n"


def signature_of(problem: BaseException) -> str:
    """Return the signature of an error, the same in every report about it: its type, file and line."""
    line_of_error = "".join(f"{file}:{line}" for file, line in _lines_of(problem)[-1:])
    return f"{type(problem).__qualname__} {line_of_error}"


def place_of(problem: BaseException) -> str:
    """Return the innermost line of this program in a traceback; no other file is named."""
    lines = [
        f"{_short_path(file)}:{line}"
        for file, line in _lines_of(problem)
        if Path(file).is_relative_to(_PROGRAM)
    ]
    return lines[-1] if lines else "no line of the program"


def _lines_of(problem: BaseException) -> list[tuple[str, int]]:
    """Return the files and lines of a traceback, the innermost last."""
    return [(frame.f_code.co_filename, line) for frame, line in traceback.walk_tb(problem.__traceback__)]


def versions() -> str:
    """Return the versions of program, libraries and system, one per line."""
    rows = [f"Curvebench {__version__}", f"Python {platform.python_version()}"]
    rows += [f"{name} {_version(name)}" for name in _LIBRARIES]
    core = sys.modules.get("PySide6.QtCore")
    if core is not None:
        rows.append(f"Qt {core.qVersion()}, {_platform_plugin()}")
    rows.append(f"{platform.system()} {platform.release()}, {platform.machine()}")
    return "\n".join(rows)


def _version(name: str) -> str:
    return str(getattr(sys.modules.get(name), "__version__", "(not loaded)"))


def _platform_plugin() -> str:
    gui = sys.modules.get("PySide6.QtGui")
    application = gui.QGuiApplication.instance() if gui is not None else None
    return str(application.platformName()) if application is not None else "no window system"


def with_short_files(trace: str) -> str:
    """Return a traceback with paths shortened to begin with the package."""
    return _FILE.sub(lambda match: _short_path(match[1]), trace)


def _short_path(file: str) -> str:
    path = Path(file)
    if path.is_relative_to(_ROOT):
        inside = path.relative_to(_ROOT).as_posix()
        if not _PACKAGES.match(inside):  # an environment may lie within the working copy
            return inside
    if _PACKAGES.match(file):
        return _PACKAGES.sub("", file).replace("\\", "/")
    return re.split(r"[\\/]", file)[-1]


def without_names(text: str, private: Collection[str]) -> str:
    """Return a text without paths, quoted names, the home folder and the words in `private`."""
    try:
        home = str(Path.home())
    except RuntimeError:  # there is none
        home = ""
    # The longest first, because the name of a file is part of its path.
    for word in sorted({home, *private}, key=len, reverse=True):
        if len(word) >= _SHORTEST_NAME:
            text = text.replace(word, "…").replace(repr(word)[1:-1], "…")
    return _PATH.sub("…", _QUOTED.sub("“…”", text))
