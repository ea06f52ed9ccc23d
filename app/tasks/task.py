"""Background tasks: work in a thread of its own, and its owners in the window.

`Task` is one piece of work; its end arrives in the window's thread. `SingleTask` runs what the person starts,
one task at a time, with progress; `DebouncedTask` runs what follows a value, once the value has settled.
`close_all` ends them with the window.

This is the only module that starts threads. The work sees immutable values and touches no widget. Work that
parses files of other programs may hang or hold the interpreter lock for long; it runs in a process of its own
(``exchange.reader_process``), and the thread only waits for it.
"""

from __future__ import annotations

import ctypes
import logging
import sys
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from shiboken6 import isValid

from .garbage import collect_between_events, collect_due
from .progress import FINAL, Cancelled, Report

_log = logging.getLogger("curvebench.tasks")

_GRACE_S = 1.0
"""Seconds after which a cancelled task that still runs is ended from outside; doubled each time."""

_TELL_EVERY_S = 0.04
_LONG_S = 1.0
"""Seconds from which the end of a task is logged at level INFO."""

_TICK_MS = 100

Work = Callable[[Report], Any]
"""Function of a task: it takes the report of progress, which raises `Cancelled` to stop it."""


class Task:
    """Work in a thread of its own; a daemon thread, so that the end of the program does not wait for it.

    Parameters
    ----------
    work
        Called in the thread, with this task's `report`.
    then
        Called in the window's thread when the thread has ended; by default, an exception is passed to
        `sys.excepthook`.
    on_progress
        Called there with the share that is done and a word for the work.
    after
        Another task that must end before this one begins.

    Attributes
    ----------
    result, problem
        The return value of `work`, or the exception that it raised.
    """

    def __init__(
        self,
        work: Work,
        then: Callable[[Task], object] | None = None,
        on_progress: Report | None = None,
        after: Task | None = None,
    ) -> None:
        self.result: Any = None
        self.problem: Exception | None = None
        self.then, self.on_progress, self.after = then or Task.raise_problem, on_progress, after
        self._work, self._keeper, self._lock = work, _keeper(), threading.Lock()
        self._is_final, self._reported_at = False, 0.0
        self._stopped_at: float | None = None
        self._grace_s = _GRACE_S
        self.thread = threading.Thread(target=self._run, name="work", daemon=True)
        self._began = time.monotonic()
        self._keeper.take(self)
        _log.debug("%s begins", self._name)
        self.thread.start()

    def stop(self) -> bool:
        """Let the next report raise `Cancelled`; return False if the final step has begun."""
        with self._lock:
            if not self._is_final and self._stopped_at is None:
                self._stopped_at = time.monotonic()
            return not self._is_final

    @property
    def is_stopped(self) -> bool:
        """Whether the task was cancelled."""
        return self._stopped_at is not None

    def wait(self, seconds: float) -> bool:
        """Wait for the end of the thread, at most `seconds`; return whether it has ended."""
        until = time.monotonic() + seconds
        while self.thread.is_alive() and (remaining := until - time.monotonic()) > 0:
            self.thread.join(min(remaining, _GRACE_S))
            self.end_overdue()
        return not self.thread.is_alive()

    def end_overdue(self) -> None:
        """Raise `_Ended` in the thread if it was cancelled a while ago and still runs.

        That bounds every loop in Python; loops in C are bounded by the size of their arrays.
        """
        now = time.monotonic()
        if (
            self._stopped_at is not None
            and now - self._stopped_at >= self._grace_s
            and self.thread.is_alive()
        ):
            # Its cleanup gets more time at each attempt: the computer may be busy.
            self._stopped_at, self._grace_s = now, 2.0 * self._grace_s
            identity = ctypes.c_ulong(self.thread.ident or 0)
            ctypes.pythonapi.PyThreadState_SetAsyncExc(identity, ctypes.py_object(_Ended))

    def report(self, share: float, word: str) -> None:
        """Report the progress of the work; raise `Cancelled` if it was cancelled. Called in the thread."""
        with self._lock:
            if self._stopped_at is not None:
                raise Cancelled
            self._is_final = self._is_final or share == FINAL
        now = time.monotonic()
        if self.on_progress is not None and not self._is_final and now - self._reported_at > _TELL_EVERY_S:
            self._reported_at = now
            self._keeper.reported.emit(self, share, word)

    @property
    def _name(self) -> str:
        """The name of the function, for the log; the title in the window may contain the name of a file."""
        work = getattr(self._work, "func", self._work)  # of a partial
        return str(getattr(work, "__qualname__", type(work).__name__))

    def log_end(self) -> None:
        """Log the end of the task and its duration."""
        how = "was cancelled" if self.is_stopped else "ended"
        if self.problem is not None:
            how = f"failed ({type(self.problem).__name__})"
        seconds = time.monotonic() - self._began
        level = logging.INFO if self.problem is not None or seconds > _LONG_S else logging.DEBUG
        _log.log(level, "%s %s after %.0f ms", self._name, how, 1e3 * seconds)

    def raise_problem(self) -> None:
        """Pass the exception of the work, if there is one, to `sys.excepthook`."""
        if self.problem is not None:
            sys.excepthook(type(self.problem), self.problem, self.problem.__traceback__)

    def _run(self) -> None:
        with suppress(Cancelled, _Ended, RuntimeError):  # RuntimeError: the program has ended meanwhile
            try:
                if self.after is not None:
                    self.after.thread.join()
                if not self.is_stopped:
                    self.result = self._work(self.report)
            except Cancelled:
                self.stop()
            except Exception as problem:
                # Any exception is reported in the window's thread.
                self.problem = problem
            self._keeper.ended.emit(self)


class _Ended(SystemExit):
    """Exception raised from outside in a cancelled thread, which ends silently."""


class _Keeper(QObject):
    """Registry of the running tasks; their signals arrive here, in the window's thread.

    It holds a task until its thread has ended, so that objects of the task are not destroyed in the thread.
    """

    reported = Signal(object, float, str)
    ended = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self.running: set[Task] = set()
        self._timer = QTimer(self, interval=_TICK_MS)
        self._timer.timeout.connect(self._tick)
        self.reported.connect(self._pass_on, Qt.ConnectionType.QueuedConnection)
        self.ended.connect(self._end, Qt.ConnectionType.QueuedConnection)

    def take(self, task: Task) -> None:
        """Add a task that is about to begin."""
        if not self.running:
            collect_between_events()
            self._timer.start()
        self.running.add(task)

    def _pass_on(self, task: Task, share: float, word: str) -> None:
        # A tick may notice the end of a thread before its reports have arrived.
        if task in self.running and task.on_progress is not None and not task.is_stopped:
            task.on_progress(share, word)

    def _end(self, task: Task) -> None:
        if task not in self.running:
            return
        task.thread.join()  # it still runs for a moment after its signal
        task.after = None
        task.log_end()
        self.running.discard(task)
        if not self.running:
            self._timer.stop()
        task.then(task)

    def _tick(self) -> None:
        collect_due()
        for task in tuple(self.running):
            task.end_overdue()
            if not task.thread.is_alive():  # a thread that was ended from outside sends no signal
                self._end(task)


_keepers: list[_Keeper] = []


def _keeper() -> _Keeper:
    """Return the keeper; it is destroyed with the application, and made again for the next one."""
    if not _keepers or not isValid(_keepers[0]):
        _keepers[:] = [_Keeper()]
    return _keepers[0]


def stopped_tasks() -> list[Task]:
    """Return cancelled tasks that still run."""
    return [task for keeper in _keepers for task in keeper.running if task.is_stopped]


# Owners of tasks

PATIENCE_S = 3.0
"""Seconds that a closing window waits for its cancelled tasks."""


class TaskOwner(QObject):
    """Owner of at most one current task; cancelled tasks may run on for a moment."""

    _task: Task | None = None

    def give_up(self) -> None:
        """Cancel the current task."""
        if self._task is not None:
            self._task.stop()

    def close(self) -> None:
        """Cancel the current task and wait for its end, at most `PATIENCE_S`."""
        close_all((self,))


def close_all(owners: Sequence[TaskOwner]) -> None:
    """Cancel the tasks of all owners and wait for their ends, at most `PATIENCE_S` in all."""
    until = time.monotonic() + PATIENCE_S
    tasks = [owner._task for owner in owners if owner._task is not None]
    for owner in owners:
        owner.give_up()
    for task in (*tasks, *stopped_tasks()):
        task.wait(until - time.monotonic())


# Tasks that the person starts

SHOWN_AFTER_MS = 200
"""Milliseconds of work without a progress bar."""


class SingleTask(TaskOwner):
    """Owner of tasks that the person starts, one at a time.

    Parameters
    ----------
    parent
        Of Qt.
    shown_after_ms
        Milliseconds after which the signal `shown` is sent.

    Signals
    -------
    begun
        A task has begun.
    shown
        The task takes a while, and its progress should be shown under this title.
    progressed
        The share that is done, 0 to 1, and a word for the work.
    ended
        The task has ended: it is done, has failed, or was cancelled.
    """

    begun = Signal()
    shown = Signal(str)
    progressed = Signal(float, str)
    ended = Signal()

    def __init__(self, parent: QObject | None = None, shown_after_ms: int = SHOWN_AFTER_MS) -> None:
        super().__init__(parent)
        self.title = ""
        self._patience = DelayedCall(self, shown_after_ms, self._show)

    @property
    def is_busy(self) -> bool:
        """Whether a task is running."""
        return self._task is not None

    @property
    def is_long(self) -> bool:
        """Whether the task takes long enough for its progress to be shown."""
        return self.is_busy and not self._patience.isActive()

    def start(
        self, title: str, work: Work, done: Callable[[Any], object], failed: Callable[[Exception], object]
    ) -> bool:
        """Start `work`, and pass its result to `done` or its exception to `failed` in this thread.

        Neither is called after `cancel`. Returns False, and does nothing, while another task is running;
        `title` is the name of that task.
        """
        if self._task is not None:
            return False

        def end(task: Task) -> None:
            if task is not self._task:
                return  # it was cancelled
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
        """Cancel the task: it has no result, and another one may begin at once.

        Returns False if its final step has begun: it then ends normally.
        """
        if self._task is not None:
            if not self._task.stop():
                return False
            self._finish()
        return True

    def give_up(self) -> None:
        """Cancel the current task; if it is too late for that, its end is ignored."""
        super().give_up()
        if self._task is not None:
            self._finish()

    def _show(self) -> None:
        self.shown.emit(self.title)

    def _finish(self) -> None:
        self._task, self.title = None, ""
        self._patience.stop()
        self.ended.emit()


# Tasks that follow a value

SETTLE_MS = 100
"""Milliseconds without a new request before a task begins."""


class DelayedCall(QTimer):
    """A call after a while, in the window's thread; `start` begins the while anew."""

    def __init__(self, parent: QObject, milliseconds: int, call: Callable[[], object]) -> None:
        super().__init__(parent, singleShot=True, interval=milliseconds)
        self.timeout.connect(call)

    def start_if_idle(self) -> None:
        """Let the while begin unless it has."""
        if not self.isActive():
            self.start()


class DebouncedTask(TaskOwner):
    """Owner of tasks that follow a value: computes the last request once no new one arrives for a while.

    Signals
    -------
    ready
        The result of the last request.
    busy_changed
        Whether a result is pending.
    progressed
        The share that is done, 0 to 1, and a word for the work.
    """

    ready = Signal(object)
    busy_changed = Signal(bool)
    progressed = Signal(float, str)

    def __init__(self, parent: QObject | None = None, *, settle_ms: int = SETTLE_MS) -> None:
        super().__init__(parent)
        self._timer = DelayedCall(self, settle_ms, self._begin)
        self._compute: Work | None = None
        self.is_busy = False

    def ask(self, compute: Work) -> None:
        """Request a computation; it begins unless a new request arrives first."""
        super().give_up()
        self._compute = compute
        self._set_busy(True)
        self._timer.start()

    def give_up(self) -> None:
        """Drop the request."""
        super().give_up()
        self._compute = None
        self._timer.stop()
        self._set_busy(False)

    def _begin(self) -> None:
        # One at a time: two threads would only slow each other down.
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
