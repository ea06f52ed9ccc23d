"""Qt's application; a refusal where Qt could open no window and would end the process."""

from __future__ import annotations

import sys
from pathlib import Path

import PySide6
from PySide6.QtWidgets import QApplication

from ..qt import spare_sources
from .display import why_no_window
from .output import RefusalError


def qt_application(without: str) -> QApplication:
    """Return the application, which is created if needed.

    Parameters
    ----------
    without
        A sentence on the commands that need no display.
    """
    spare_sources()
    running = QApplication.instance()
    if isinstance(running, QApplication):
        return running
    with why_no_window(Path(str(PySide6.__file__)).parent / "Qt" / "plugins" / "platforms") as sentence:
        if sentence:
            raise RefusalError(f"{sentence} {without}" if "display" in sentence else sentence)
        return QApplication([sys.argv[0]])
