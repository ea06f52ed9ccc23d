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
"""Seconds after which a stopped task that has not noticed is ended from outside; twice as many each time."""

_TELL_EVERY_S = 0.04
_LONG_S = 1.0
"""Work that takes so long is logged as a rule."""

_TICK_MS = 100

Work = Callable[[Report], Any]
"""The work of a task: it reports how far it is, and ends with `Cancelled` when it is not wanted any more."""


class Task:
    """One piece of work in a thread of its own; a daemon, so that the program's end never hangs on it.

    Parameters
    ----------
    work
        Called in the thread, with this task's `report`.
    then
        Called in the window's thread when the thread has ended, however it did; by default what was raised
        goes to `sys.excepthook`.
    told
        Called there with the share that is done and a word for what is being done.
    after
        Another task, which has to end before this one begins.

    Attributes
    ----------
    result, problem
        What `work` returned, or what it raised.
    """

    def __init__(
        self,
        work: Work,
        then: Callable[[Task], object] | None = None,
        told: Report | None = None,
        after: Task | None = None,
    ) -> None:
        self.result: Any = None
        self.problem: Exception | None = None
        self.then, self.told, self.after = then or Task.raise_problem, told, after
        self._work, self._keeper, self._lock = work, _keeper(), threading.Lock()
        self._is_final, self._told_at = False, 0.0
        self._stopped_at: float | None = None
        self._grace_s = _GRACE_S
        self.thread = threading.Thread(target=self._run, name="work", daemon=True)
        self._began = time.monotonic()
        self._keeper.take(self)
        _log.debug("%s begins", self._name)
        self.thread.start()

    def stop(self) -> bool:
        """Let the next report raise `Cancelled`; return False where the last step has begun."""
        with self._lock:
            if not self._is_final and self._stopped_at is None:
                self._stopped_at = time.monotonic()
            return not self._is_final

    @property
    def is_stopped(self) -> bool:
        """Whether nobody waits for the result any more."""
        return self._stopped_at is not None

    def wait(self, seconds: float) -> bool:
        """Wait until the thread has ended, at most so long; return whether it has."""
        until = time.monotonic() + seconds
        while self.thread.is_alive() and (left := until - time.monotonic()) > 0:
            self.thread.join(min(left, _GRACE_S))
            self.end_overdue()
        return not self.thread.is_alive()

    def end_overdue(self) -> None:
        """Raise `_Ended` in the thread if it was stopped a while ago and goes on as if it were not.

        That bounds every loop of Python's; one in C is bounded by the size of its arrays.
        """
        now = time.monotonic()
        if (
            self._stopped_at is not None
            and now - self._stopped_at >= self._grace_s
            and self.thread.is_alive()
        ):
            # What cleans up behind it gets longer each time: the machine may be busy.
            self._stopped_at, self._grace_s = now, 2.0 * self._grace_s
            identity = ctypes.c_ulong(self.thread.ident or 0)
            ctypes.pythonapi.PyThreadState_SetAsyncExc(identity, ctypes.py_object(_Ended))

    def report(self, share: float, word: str) -> None:
        """Tell how far the work is; raise `Cancelled` where it was stopped. Called in the thread."""
        with self._lock:
            if self._stopped_at is not None:
                raise Cancelled
            self._is_final = self._is_final or share == FINAL
        now = time.monotonic()
        if self.told is not None and not self._is_final and now - self._told_at > _TELL_EVERY_S:
            self._told_at = now
            self._keeper.reported.emit(self, share, word)

    @property
    def _name(self) -> str:
        """The function that does the work: what the person calls it may hold the name of a file."""
        work = getattr(self._work, "func", self._work)  # of a partial
        return str(getattr(work, "__qualname__", type(work).__name__))

    def log_end(self) -> None:
        """Log what came of it, and how long that took."""
        how = "was cancelled" if self.is_stopped else "ended"
        if self.problem is not None:
            how = f"failed ({type(self.problem).__name__})"
        seconds = time.monotonic() - self._began
        level = logging.INFO if self.problem is not None or seconds > _LONG_S else logging.DEBUG
        _log.log(level, "%s %s after %.0f ms", self._name, how, 1e3 * seconds)

    def raise_problem(self) -> None:
        """Give what was raised, if anything was, to `sys.excepthook`."""
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
                # Whatever it is, it is the window's thread that has to say it.
                self.problem = problem
            self._keeper.ended.emit(self)


class _Ended(SystemExit):
    """Raised from outside in a stopped thread; threads end on it without a word."""


class _Keeper(QObject):
    """Keeper of the running tasks, where their signals arrive: in the window's thread.

    A task is kept until its thread is gone: what it refers to must not go with that.
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
        """Keep a task that is about to begin."""
        if not self.running:
            collect_between_events()
            self._timer.start()
        self.running.add(task)

    def _pass_on(self, task: Task, share: float, word: str) -> None:
        # A tick may have found the end of a thread before what it reported has arrived.
        if task in self.running and task.told is not None and not task.is_stopped:
            task.told(share, word)

    def _end(self, task: Task) -> None:
        if task not in self.running:
            return
        task.thread.join()  # it has a few steps to go after its signal
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
            if not task.thread.is_alive():  # one that was ended from outside sends no signal
                self._end(task)


_keepers: list[_Keeper] = []


def _keeper() -> _Keeper:
    """Return the one keeper, made with the first task; with the application it goes, and is made anew."""
    if not _keepers or not isValid(_keepers[0]):
        _keepers[:] = [_Keeper()]
    return _keepers[0]


def stopped_tasks() -> list[Task]:
    """Return the tasks that were taken back and have not noticed yet."""
    return [task for keeper in _keepers for task in keeper.running if task.is_stopped]


# Owners of tasks

PATIENCE_S = 3.0
"""Seconds that a window that closes waits until its work has noticed."""


class TaskOwner(QObject):
    """Has one task at a time whose end matters; what it has taken back may take a while to notice."""

    _task: Task | None = None

    def give_up(self) -> None:
        """Take back what is being done."""
        if self._task is not None:
            self._task.stop()

    def close(self) -> None:
        """Take back what is being done and wait until it has noticed, not longer than `PATIENCE_S`."""
        close_all((self,))


def close_all(owners: Sequence[TaskOwner]) -> None:
    """Take back what all of them do, and wait until it has noticed, not longer than `PATIENCE_S` in all."""
    until = time.monotonic() + PATIENCE_S
    tasks = [owner._task for owner in owners if owner._task is not None]
    for owner in owners:
        owner.give_up()
    for task in (*tasks, *stopped_tasks()):
        task.wait(until - time.monotonic())


# Tasks that the person starts

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


# Tasks that follow a value

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
