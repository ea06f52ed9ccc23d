"""Work off the window's thread: with progress, a way to take it back, and its result where widgets live.

What is to be done is a pure function of its data that takes a `Report`. It never touches a widget or the
session. What parses files of others may hang, or keep the interpreter to itself for long, and goes on in a
process of its own (``exchange.child``); the thread then only waits for it.
"""

from __future__ import annotations

import gc
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from app.exchange.progress import FINAL, Cancelled, Report

SHOWN_AFTER_MS = 200
"""What is done sooner needs no bar."""

_TELL_EVERY = 0.04
_PATIENCE = 3.0

Work = Callable[[Report], Any]


class Jobs(QObject):
    """Does one thing at a time for one window.

    Signals
    -------
    shown
        The work is taking a while; the title is what it is called.
    progressed
        The share that is done, 0 to 1, and a word for what is being done.
    ended
        There is no work any more: it is done, has failed, or was taken back.
    """

    shown = Signal(str)
    progressed = Signal(float, str)
    ended = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._job: _Job | None = None
        self._title = ""
        self._patience = QTimer(self, singleShot=True, interval=SHOWN_AFTER_MS)
        self._patience.timeout.connect(self._show)

    @property
    def is_busy(self) -> bool:
        """Whether something is being done."""
        return self._job is not None

    @property
    def title(self) -> str:
        """What is being done; empty when nothing is."""
        return self._title

    def start(
        self,
        title: str,
        work: Work,
        done: Callable[[Any], object],
        failed: Callable[[Exception], object],
    ) -> bool:
        """Do `work` and hand its result to `done`, or what it raised to `failed`, in this thread.

        Neither is called once the work was taken back. Returns False, and does nothing, while there is
        other work.
        """
        if self._job is not None:
            return False
        self._job, self._title = _Job(work, done, failed), title
        self._job.reported.connect(self._pass_on, Qt.ConnectionType.QueuedConnection)
        self._job.finished.connect(self._end, Qt.ConnectionType.QueuedConnection)
        self._patience.start()
        self._job.start()
        return True

    def cancel(self) -> bool:
        """Take the work back: nothing comes of it, and other work may begin at once.

        Returns False where it is too late: its last step has begun, and it ends as it would have.
        """
        if self._job is None:
            return True
        if not self._job.stop():
            return False
        self._finish()
        return True

    def close(self) -> None:
        """Take the work back and wait until it has noticed, as long as that does not take too long."""
        job = self._job
        if job is not None:
            job.stop()
            self._finish()
            job.wait(_PATIENCE)

    def _show(self) -> None:
        if self._job is not None:
            self.shown.emit(self._title)

    def _pass_on(self, share: float, word: str) -> None:
        if self._job is not None and self._job is self.sender():
            self.progressed.emit(share, word)

    def _end(self) -> None:
        job = self._job
        if job is None or job is not self.sender():
            return  # it was taken back
        self._finish()
        if job.problem is not None:
            job.failed(job.problem)
        else:
            job.done(job.result)

    def _finish(self) -> None:
        self._job, self._title = None, ""
        self._patience.stop()
        self.ended.emit()


class _Job(QObject):
    """One piece of work in a thread of its own.

    A daemon thread of Python, not a QThread: destroyed while it runs, that would take the program along.
    """

    reported = Signal(float, str)
    finished = Signal()

    def __init__(
        self, work: Work, done: Callable[[Any], object], failed: Callable[[Exception], object]
    ) -> None:
        super().__init__()
        self.done, self.failed = done, failed
        self.result: Any = None
        self.problem: Exception | None = None
        self._work = work
        self._stopped = threading.Event()
        self._told = 0.0
        self._lock, self._is_final = threading.Lock(), False
        self._thread = threading.Thread(target=self._run, name="work", daemon=True)

    def start(self) -> None:
        """Begin."""
        _alive.add(self)
        # Collected in this thread, a widget that is part of a cycle would be destroyed in it.
        gc.disable()
        # As the last thing of the thread's, so that `_alive` keeps this object until then.
        self.finished.connect(self._let_go, Qt.ConnectionType.QueuedConnection)
        self._thread.start()

    def stop(self) -> bool:
        """Let the next report raise `Cancelled`; return False where the last step has begun."""
        with self._lock:
            if not self._is_final:
                self._stopped.set()
            return not self._is_final

    def wait(self, seconds: float) -> None:
        """Wait until the thread has ended, at most so long."""
        self._thread.join(seconds)

    def _run(self) -> None:
        try:
            self.result = self._work(self._report)
        except Cancelled:
            self._stopped.set()
        except Exception as problem:
            # Whatever it is, it is the window's thread that has to say it.
            self.problem = problem
        with suppress(RuntimeError):  # at the end of the program
            self.finished.emit()

    def _report(self, share: float, word: str) -> None:
        with self._lock:
            if self._stopped.is_set():
                raise Cancelled
            self._is_final = self._is_final or share == FINAL
        if self._is_final:
            return
        now = time.monotonic()
        if now - self._told > _TELL_EVERY:
            self._told = now
            self.reported.emit(share, word)

    def _let_go(self) -> None:
        _alive.discard(self)
        if not _alive:
            gc.enable()


_alive: set[_Job] = set()
"""Everything that runs, taken back or not."""
