"""Garbage collection from the event loop alone.

Python collects garbage wherever its thresholds are exceeded. In a thread, a widget that is part of a cycle
is destroyed beside the window's thread, and takes the program along. In a destructor of Qt's, as of a window
that is deleted, destroying another object of Qt's may wait for a lock that the first one holds: the program
stands still for ever. So from the first window or task on, Python's own collector is off, and a timer
collects in its place, by the same thresholds: between two events no destructor is on the stack.
"""

from __future__ import annotations

import gc

from PySide6.QtCore import QCoreApplication, QObject, QTimer
from shiboken6 import isValid

from .generations import Generations

_INTERVAL_MS = 1000
"""Milliseconds between two looks at the thresholds; while tasks run these look, too."""


class GarbageCollector(QObject):
    """Collector of garbage in the window's thread, in place of Python's own."""

    def __init__(self, parent: QObject | None) -> None:
        super().__init__(parent)
        self._generations = Generations()
        self._timer = QTimer(self, interval=_INTERVAL_MS)
        self._timer.timeout.connect(self.collect_due)
        self._timer.start()

    def collect_due(self) -> None:
        """Collect what is due; nothing where somebody has Python collect again."""
        if not gc.isenabled():
            self._generations.collect_due()


_collectors: list[GarbageCollector] = []


def collect_between_events() -> None:
    """Have garbage collected from the event loop alone, as long as the application lives.

    Where Python's collector is off, somebody else decides when to collect, and goes on doing so.
    """
    if not gc.isenabled():
        return
    gc.disable()
    if not _collectors or not isValid(_collectors[0]):
        _collectors[:] = [GarbageCollector(QCoreApplication.instance())]


def collect_due() -> None:
    """Collect what is due, where that is done between events; called from the event loop."""
    if _collectors and isValid(_collectors[0]):
        _collectors[0].collect_due()
