"""Debounced background task: the last thing that was asked for is computed once things have settled."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer, Signal

from .owner import TaskOwner
from .task import Task, Work

SETTLE_MS = 100
"""Milliseconds without a change before a task begins."""


class DebouncedTask(TaskOwner):
    """Computes the last thing it was asked for, once things have settled; what came before is forgotten.

    Signals
    -------
    ready
        The result of what was asked last.
    busy_changed
        Whether a result is being waited for.
    progressed
        The share that is done, 0 to 1, and a word for what is being done.
    """

    ready = Signal(object)
    busy_changed = Signal(bool)
    progressed = Signal(float, str)

    def __init__(self, parent: QObject | None = None, *, settle_ms: int = SETTLE_MS) -> None:
        super().__init__(parent)
        self._timer = QTimer(self, singleShot=True, interval=settle_ms)
        self._timer.timeout.connect(self._begin)
        self._compute: Work | None = None
        self.is_busy = False

    def ask(self, compute: Work) -> None:
        """Compute this as soon as nothing else is asked for a while."""
        super().give_up()
        self._compute = compute
        self._set_busy(True)
        self._timer.start()

    def give_up(self) -> None:
        """Forget what was asked."""
        super().give_up()
        self._compute = None
        self._timer.stop()
        self._set_busy(False)

    def _begin(self) -> None:
        # One at a time: a second one would only take the first one's turn.
        compute = self._compute
        if compute is not None and self._task is None and not self._timer.isActive():
            self._compute = None
            self._task = Task(compute, self._end, self.progressed.emit)

    def _end(self, task: Task) -> None:
        self._task = None
        task.raise_problem()
        if not task.is_stopped:
            self._set_busy(False)
            if task.problem is None:
                self.ready.emit(task.result)
        self._begin()

    def _set_busy(self, busy: bool) -> None:
        if busy != self.is_busy:
            self.is_busy = busy
            self.busy_changed.emit(busy)
