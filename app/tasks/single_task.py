"""Background tasks that a person starts, one at a time: progress, cancelling, result or failure."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from .owner import TaskOwner
from .task import Task, Work

SHOWN_AFTER_MS = 200
"""Milliseconds of work that need no bar."""


class SingleTask(TaskOwner):
    """Does one thing at a time, as the person asks for it.

    Parameters
    ----------
    parent
        Of Qt.
    shown_after_ms
        Milliseconds of work after which it is `shown`.

    Signals
    -------
    begun
        There is work now.
    shown
        The work is taking a while; the title is what it is called.
    progressed
        The share that is done, 0 to 1, and a word for what is being done.
    ended
        There is no work any more: it is done, has failed, or was taken back.
    """

    begun = Signal()
    shown = Signal(str)
    progressed = Signal(float, str)
    ended = Signal()

    def __init__(self, parent: QObject | None = None, shown_after_ms: int = SHOWN_AFTER_MS) -> None:
        super().__init__(parent)
        self.title = ""
        self._patience = QTimer(self, singleShot=True, interval=shown_after_ms)
        self._patience.timeout.connect(self._show)

    @property
    def is_busy(self) -> bool:
        """Whether something is being done."""
        return self._task is not None

    @property
    def is_long(self) -> bool:
        """Whether what is being done takes long enough to be shown."""
        return self.is_busy and not self._patience.isActive()

    def start(
        self, title: str, work: Work, done: Callable[[Any], object], failed: Callable[[Exception], object]
    ) -> bool:
        """Do `work` and hand its result to `done`, or what it raised to `failed`, in this thread.

        Neither is called once the work was taken back. Returns False, and does nothing, while there is
        other work; its name is the `title`.
        """
        if self._task is not None:
            return False

        def end(task: Task) -> None:
            if task is not self._task:
                return  # it was taken back
            self._finish()
            if task.problem is not None:
                failed(task.problem)
            elif not task.is_stopped:
                done(task.result)

        self.title = title
        self._patience.start()
        self._task = Task(work, end, self.progressed.emit)
        self.begun.emit()
        return True

    def cancel(self) -> bool:
        """Take the work back: nothing comes of it, and other work may begin at once.

        Returns False where it is too late: its last step has begun, and it ends as it would have.
        """
        if self._task is not None:
            if not self._task.stop():
                return False
            self._finish()
        return True

    def give_up(self) -> None:
        """Take back what is being done; where it is too late for that, its end is not told."""
        super().give_up()
        if self._task is not None:
            self._finish()

    def _show(self) -> None:
        self.shown.emit(self.title)

    def _finish(self) -> None:
        self._task, self.title = None, ""
        self._patience.stop()
        self.ended.emit()
