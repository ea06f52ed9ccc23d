"""The start of the editor: windows on the screen, soon."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
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


def open_windows(files: Sequence[str]) -> list[MainWindow]:
    """Show a window for every file, or one with the first sketch."""
    # The editor and Qt take a while to import, and the other commands do without.
    from app.main_window import MainWindow  # noqa: PLC0415
    from app.session import Session  # noqa: PLC0415

    sessions = [Session() for _ in files or [""]]
    for session, path in zip(sessions, files, strict=False):
        session.open(Path(path))
    windows = [MainWindow(session) for session in sessions]
    for window in windows:
        window.show()
    return windows
