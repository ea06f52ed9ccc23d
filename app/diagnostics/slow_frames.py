"""Slow frames: the time of the window's thread from a change of the document to the next paint."""

from __future__ import annotations

import logging
from time import thread_time

from PySide6.QtCore import QObject, SignalInstance

SLOW_S = 0.2
"""Seconds from which a frame is logged as slow."""

_log = logging.getLogger("curvebench.frames")


class SlowFrames(QObject):
    """Log of frames that took long; other frames only cost a reading of the clock.

    The clock measures the processor time of the thread from one frame to the next: it stops while the thread
    is idle.

    Parameters
    ----------
    changed
        Signal that the displayed document has changed.
    painted
        Signal that the canvas was painted.
    """

    def __init__(self, changed: SignalInstance, painted: SignalInstance, parent: QObject) -> None:
        super().__init__(parent)
        self._is_changed, self._last = False, thread_time()
        changed.connect(self._note_change)
        painted.connect(self._note_frame)

    def _note_change(self) -> None:
        self._is_changed = True

    def _note_frame(self) -> None:
        before, self._last = self._last, thread_time()
        if self._is_changed and self._last - before > SLOW_S:
            _log.warning("a frame took %.0f ms", 1e3 * (self._last - before))
        self._is_changed = False
