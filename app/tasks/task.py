"""A background task in a thread of its own.

The only module that starts threads. What is to be done sees immutable values and touches no widget; its end
is told in the window's thread. What parses files of others may hang, or keep the interpreter to itself for
long, and goes on in a process of its own (``exchange.child``); the thread then only waits for it.
"""

from __future__ import annotations

import ctypes
import logging
import sys
import threading
import time
from collections.abc import Callable
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
