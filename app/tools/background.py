"""Work of a tool that takes longer than a moment: beside the window, one thing after the other. No Qt."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import msgspec

from ..document.model import Vector
from ..tasks.progress import Report, silent


class Jobs(Protocol):
    """DocumentOrigin and end of work beside the window."""

    @property
    def is_busy(self) -> bool:
        """Whether something is being done."""

    def start(
        self,
        title: str,
        work: Callable[[Report], Any],
        done: Callable[[Any], object],
        failed: Callable[[Exception], object],
    ) -> bool:
        """Do `work`, and hand its result to `done` or what it raised to `failed`."""

    def cancel(self) -> bool:
        """Take the work back."""


class BackgroundTask(msgspec.Struct, frozen=True):
    """A piece of work of a tool.

    Attributes
    ----------
    title, work, done
        Its name, the work itself, and what takes its result.
    line
        What is seen on the plot until then.
    """

    title: str
    work: Callable[[Report], Any]
    done: Callable[[Any], object]
    line: tuple[Vector, ...] = ()


class Background:
    """Errands of the tools of one plot; a result waits until no gesture is in flight.

    Attributes
    ----------
    jobs
        Does them beside the window; whoever shows the plot sets it. Without, each is done at once.
    changed
        Called when there is one more or one less.
    """

    def __init__(self, is_free: Callable[[], bool]) -> None:
        self.jobs: Jobs | None = None
        self.changed: Callable[[], object] = lambda: None
        self._is_free = is_free
        self._tasks: list[BackgroundTask] = []
        self._results: list[Any] = []

    @property
    def is_busy(self) -> bool:
        """Whether there are tasks."""
        return bool(self._tasks)

    @property
    def lines(self) -> tuple[tuple[Vector, ...], ...]:
        """The lines of the tasks, to be seen meanwhile."""
        return tuple([task.line for task in self._tasks]) if self._tasks else ()

    def do(self, task: BackgroundTask) -> None:
        """Do this after those that there are."""
        if self.jobs is None:
            task.done(task.work(silent))
            return
        self._tasks.append(task)
        self.changed()
        self._begin()

    def cancel(self) -> bool:
        """Drop all of them; return whether there were any."""
        found = bool(self._tasks)
        self._tasks, self._results = [], []
        if self.jobs is not None and found:
            self.jobs.cancel()
            self.changed()
        return found

    def cancel_last(self) -> str:
        """Drop the one that was begun last; return its title, empty where there is none."""
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
        """Hand the result to whom it is for, unless a gesture is in flight; then begin the next."""
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
