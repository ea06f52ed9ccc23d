"""Garbage collection from the event loop alone.

Python collects garbage wherever its thresholds are exceeded. In a thread, it may destroy a widget of a
reference cycle outside the window's thread, which crashes the program. In a destructor of Qt, as of a deleted
window, destroying another Qt object may wait for a lock that the first one holds: a deadlock. Therefore, from
the first window or task on, Python's own collector is off, and a timer collects by the same thresholds:
between two events no destructor is on the stack.
"""

from __future__ import annotations

import gc

from PySide6.QtCore import QCoreApplication, QObject, QTimer
from shiboken6 import isValid

_INTERVAL_MS = 1000
"""Milliseconds between checks of the thresholds; running tasks check as well."""


class GarbageCollector(QObject):
    """Garbage collector in the window's thread, in place of Python's own."""

    def __init__(self, parent: QObject | None) -> None:
        super().__init__(parent)
        self._generations = Generations()
        self._timer = QTimer(self, interval=_INTERVAL_MS)
        self._timer.timeout.connect(self.collect_due)
        self._timer.start()

    def collect_due(self) -> None:
        """Collect the generation that is due; nothing if Python's own collector was enabled again."""
        if not gc.isenabled():
            self._generations.collect_due()


_collectors: list[GarbageCollector] = []


def collect_between_events() -> None:
    """Collect garbage from the event loop alone, as long as the application lives.

    If Python's collector is disabled already, its owner decides when to collect.
    """
    if not gc.isenabled():
        return
    gc.disable()
    if not _collectors or not isValid(_collectors[0]):
        _collectors[:] = [GarbageCollector(QCoreApplication.instance())]


def collect_due() -> None:
    """Collect the generation that is due, if a collector exists; called from the event loop."""
    if _collectors and isValid(_collectors[0]):
        _collectors[0].collect_due()


_GROWTH = 1.25
"""Growth of the number of objects in the oldest generation before it is collected again. Python has the same
rule, but not for an explicit collection."""


class Generations:
    """Schedule of the generations of Python's collector."""

    def __init__(self) -> None:
        # Collections of the middle generation at the last check of the oldest.
        self._count_before = gc.get_count()[2]
        self._objects_before = 0

    def collect_due(self) -> None:
        """Collect the oldest generation that is due."""
        counts, thresholds = gc.get_count(), gc.get_threshold()
        self._count_before = min(self._count_before, counts[2])
        if 0 < thresholds[2] < counts[2] - self._count_before and self._have_grown(counts[2]):
            gc.collect()
            self._objects_before = len(gc.get_objects(2))
        elif 0 < thresholds[1] < counts[1]:
            gc.collect(1)
        elif 0 < thresholds[0] < counts[0]:
            gc.collect(0)

    def _have_grown(self, count: int) -> bool:
        self._count_before = count
        return len(gc.get_objects(2)) > _GROWTH * self._objects_before
