"""Slow frames: what the window's thread has to do before a change of the document is on the screen."""

from __future__ import annotations

import logging
from time import thread_time

from PySide6.QtCore import QObject, SignalInstance

SLOW_S = 0.2
"""Seconds from which a frame is felt as a halt."""

_log = logging.getLogger("curvebench.frames")


class SlowFrames(QObject):
    """Logs the frames that took long; the others cost a reading of the clock.

    The clock is that of the thread's own work, from one frame to the next: it stands still while nothing is
    done, and when a window that was covered is painted again.

    Parameters
    ----------
    changed
        Told when the document shown is another one.
    painted
        Told when the canvas has been painted.
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
