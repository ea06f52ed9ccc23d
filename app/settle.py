"""What is too heavy for a frame: computed once things have settled, beside the window."""

from __future__ import annotations

import sys
from collections.abc import Callable

from PySide6.QtCore import QObject, QRunnable, QThreadPool, QTimer, Signal

from app.overrides import Guarded

SETTLE_MS = 100
"""How long nothing must have changed before the work begins, in milliseconds."""

IsStale = Callable[[], bool]
"""Whether nobody waits for the result any more; long work asks now and then, and returns early."""


class Settler(QObject):
    """Computes the last thing it was asked for, in a thread of the pool; what came before is forgotten.

    The work sees immutable values only and touches no widget.

    Signals
    -------
    ready
        The result of what was asked last.
    busy_changed
        Whether a result is being waited for.
    """

    ready = Signal(object)
    busy_changed = Signal(bool)
    _ended = Signal(int, object, object)

    def __init__(self, parent: QObject | None = None, *, settle_ms: int = SETTLE_MS) -> None:
        super().__init__(parent)
        self._pool = QThreadPool(self)
        # One at a time: a second one would only take the first one's turn.
        self._pool.setMaxThreadCount(1)
        self._timer = QTimer(self, singleShot=True, interval=settle_ms)
        self._timer.timeout.connect(self._begin)
        self._compute: Callable[[IsStale], object] | None = None
        self._asked = 0
        self._is_busy = False
        self._ended.connect(self._deliver)

    @property
    def is_busy(self) -> bool:
        """Whether a result is being waited for."""
        return self._is_busy

    def ask(self, compute: Callable[[IsStale], object]) -> None:
        """Compute this as soon as nothing else is asked for a while."""
        self._asked += 1
        self._compute = compute
        self._set_busy(True)
        self._timer.start()

    def drop(self) -> None:
        """Forget what was asked."""
        self._asked += 1
        self._compute = None
        self._timer.stop()
        self._set_busy(False)

    def wait(self) -> None:
        """Let what is running end; called before the window goes."""
        self.drop()
        self._pool.waitForDone()

    def _begin(self) -> None:
        compute, asked = self._compute, self._asked
        if compute is not None:
            self._pool.clear()
            self._pool.start(_Work(compute, asked, self))

    def _deliver(self, asked: int, result: object, problem: object) -> None:
        if isinstance(problem, Exception):
            sys.excepthook(type(problem), problem, problem.__traceback__)
        if asked == self._asked:
            self._set_busy(False)
            if problem is None:
                self.ready.emit(result)

    def _set_busy(self, busy: bool) -> None:
        if busy != self._is_busy:
            self._is_busy = busy
            self.busy_changed.emit(busy)


class _Work(Guarded, QRunnable):
    """One computation; its end is told through a signal, hence in the window's thread."""

    def __init__(self, compute: Callable[[IsStale], object], asked: int, owner: Settler) -> None:
        super().__init__()
        self._compute, self._asked, self._owner = compute, asked, owner

    def run(self) -> None:
        """Compute; called by the pool."""
        owner, asked = self._owner, self._asked
        try:
            result, problem = self._compute(lambda: asked != owner._asked), None
        except Exception as exception:  # every one of them is shown in the window's thread
            result, problem = None, exception
        owner._ended.emit(asked, result, problem)
