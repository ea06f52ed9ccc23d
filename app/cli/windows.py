"""The first windows of the editor, and what surrounds them until the last is closed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtWidgets import QApplication

from ..features.lessons.commands import LessonCommands
from ..session import Session
from ..storage.open_file import is_large
from ..window.given import given
from ..window.main_window import MainWindow
from .lifecycle import Lifecycle


def open_windows(files: Sequence[str], problems: Sequence[str] = (), lesson: str = "") -> list[MainWindow]:
    """Show a window for every document, or one with the first sketch; a large document is read beside it.

    The first one takes what else there is as it takes a drop, says what was wrong with other files, as
    sentences in `problems`, and opens a lesson that is named.
    """
    others = given(map(Path, files))
    documents = [Path(path) for path in files if Path(path) in others.documents]
    large = {path for path in documents if is_large(path)}
    sessions = [Session() for _ in documents] or [Session()]
    for session, path in zip(sessions, documents, strict=False):
        if path not in large:
            session.open(path)
    windows = [MainWindow(session) for session in sessions]
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


def run(application: QApplication, windows: list[MainWindow]) -> int:
    """Keep the work of the windows until the last is closed, and return the exit code."""
    lifecycle = Lifecycle(application, windows)
    windows.clear()  # a window that is closed goes
    lifecycle.start()
    code = int(application.exec())
    lifecycle.stop()
    return code
