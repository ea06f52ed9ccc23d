"""The owner of a background task, and the end of all of them."""

from __future__ import annotations

import time
from collections.abc import Sequence

from PySide6.QtCore import QObject

from .task import Task, stopped_tasks

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
