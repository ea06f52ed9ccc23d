"""The start of the editor: windows on the screen, soon."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.main_window import MainWindow


@contextmanager
def no_garbage_sought() -> Iterator[None]:
    """Make what the program keeps as long as it runs: no garbage is sought in it, then or later.

    That takes some 8 % off the start, and a while off every later search. Where Qt runs already, this is no
    start, and nothing happens.
    """
    if "PySide6.QtWidgets" in sys.modules:
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


def open_windows(files: Sequence[str], problems: Sequence[str] = ()) -> list[MainWindow]:
    """Show a window for every document, or one with the first sketch; a large document is read beside it.

    The first one takes what else there is as it takes a drop, and says what was wrong with other files, as
    sentences in `problems`.
    """
    # The editor and Qt take a while to import, and the other commands do without.
    from app.commands.given import given  # noqa: PLC0415
    from app.main_window import MainWindow  # noqa: PLC0415
    from app.session import Session  # noqa: PLC0415
    from app.storage.open_file import is_large  # noqa: PLC0415

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
    windows[0].take_files(replace(others, documents=()), problems)
    return windows
