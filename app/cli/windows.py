"""The first windows of the editor, and what surrounds them until the last is closed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtWidgets import QApplication

from ..features.lessons.commands import LessonCommands
from ..session import Session
from ..storage.open_file import is_large
from ..window.given_files import given_files
from ..window.main_window import MainWindow
from .lifecycle import Lifecycle


def open_windows(files: Sequence[str], problems: Sequence[str] = (), lesson: str = "") -> list[MainWindow]:
    """Show a window for every document; without any file one with the first sketch.

    A large document is read beside its window, which is empty until then, and stays so if it is refused.

    The first one takes what else there is as it takes a drop, says what was wrong with other files, as
    sentences in `problems`, and opens a lesson that is named.
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
        _begin_empty(sessions)
    for window in windows:
        window.show()
    for window, path in zip(windows, documents, strict=False):
        if path in large:
            window.open_file(path)
    imports = others.imports
    if imports and not others.documents and not others.pictures:
        # Nobody means it to lie on a sketch that was there before.
        windows[0].open_file(imports[0])
        imports = imports[1:]
    windows[0].commands.drops.take(replace(others, documents=(), imports=imports), problems)
    if lesson:
        windows[0].commands[LessonCommands].open(lesson)
    return windows


def _begin_empty(sessions: Iterable[Session]) -> None:
    """Let those that wait for their file have nothing in them: a sketch would be taken for what is in it."""
    for session in sessions:
        if session.files.is_untouched:
            session.files.new()


def run(application: QApplication, windows: list[MainWindow]) -> int:
    """Keep the work of the windows until the last is closed, and return the exit code."""
    lifecycle = Lifecycle(application, windows)
    windows.clear()  # a window that is closed goes
    lifecycle.start()
    code = int(application.exec())
    lifecycle.stop()
    return code
