"""Work of a tool that takes longer than a moment: in a thread, one task after the other. No Qt."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import msgspec

from ..document.model import Vector
from ..tasks.progress import Report, silent


class Jobs(Protocol):
    """Thread that does one piece of work at a time."""

    @property
    def is_busy(self) -> bool:
        """Whether work is in progress."""

    def start(
        self,
        title: str,
        work: Callable[[Report], Any],
        done: Callable[[Any], object],
        failed: Callable[[Exception], object],
    ) -> bool:
        """Do `work`; call `done` with its result, or `failed` with its exception."""

    def cancel(self) -> bool:
        """Cancel the work; return whether there was any."""


class BackgroundTask(msgspec.Struct, frozen=True):
    """A piece of work of a tool.

    Attributes
    ----------
    title, work, done
        Its name, the work itself, and the function that gets its result.
    line
        Line drawn on the plot until then.
    """

    title: str
    work: Callable[[Report], Any]
    done: Callable[[Any], object]
    line: tuple[Vector, ...] = ()


class Background:
    """Background tasks of the tools of one plot; a result waits until no gesture is in flight.

    Attributes
    ----------
    jobs
        The thread; the widget of the plot sets it. Without, each task is done at once.
    changed
        Called when a task is added or removed.
    """

    def __init__(self, is_free: Callable[[], bool]) -> None:
        self.jobs: Jobs | None = None
        self.changed: Callable[[], object] = lambda: None
        self._is_free = is_free
        self._tasks: list[BackgroundTask] = []
        self._results: list[Any] = []

    @property
    def is_busy(self) -> bool:
        """Whether tasks are waiting or in progress."""
        return bool(self._tasks)

    @property
    def lines(self) -> tuple[tuple[Vector, ...], ...]:
        """The lines of the tasks, drawn meanwhile."""
        return tuple([task.line for task in self._tasks]) if self._tasks else ()

    def do(self, task: BackgroundTask) -> None:
        """Do a task after those that are waiting."""
        if self.jobs is None:
            task.done(task.work(silent))
            return
        self._tasks.append(task)
        self.changed()
        self._begin()

    def cancel(self) -> bool:
        """Cancel all tasks; return whether there were any."""
        is_busy = bool(self._tasks)
        self._tasks, self._results = [], []
        if self.jobs is not None and is_busy:
            self.jobs.cancel()
            self.changed()
        return is_busy

    def cancel_last(self) -> str:
        """Cancel the task that was added last; return its title, empty for none."""
        if not self._tasks:
            return ""
        title = self._tasks[-1].title
        if len(self._tasks) == 1:
            self.cancel()
        else:
            self._tasks.pop()
            self.changed()
        return title

    def hand_over(self) -> None:
        """Finish the task with its result, unless a gesture is in flight; then begin the next one."""
        if self._results and self._is_free():
            task, result = self._tasks.pop(0), self._results.pop()
            self.changed()
            task.done(result)
            self._begin()

    def _begin(self) -> None:
        if self.jobs is not None and self._tasks and not self._results and not self.jobs.is_busy:
            task = self._tasks[0]
            self.jobs.start(task.title, task.work, self._take, self._fail)

    def _take(self, result: object) -> None:
        self._results.append(result)
        self.hand_over()

    def _fail(self, problem: Exception) -> None:
        self._tasks.pop(0)
        self.changed()
        self._begin()
        raise problem
