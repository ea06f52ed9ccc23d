"""A limit of time for the Python of others that runs in the main thread.

By a signal of the system's, which Python hears between two instructions: a thread that kept the time could
collect garbage, and destroy widgets that are none of its business (see ``tasks.task``). Windows has no such
signal; there a process of its own, which tries a file first, is all that bounds it.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class OverdueError(RuntimeError):
    """Code ran for longer than it may; its traceback ends where it was."""


class _Clock:
    """The alarm of this process, and what it was for before."""

    def __init__(self) -> None:
        self._until: float | None = None
        self._before: object = None

    @property
    def is_free(self) -> bool:
        """Whether there is an alarm, this thread hears it, and it is not set yet."""
        is_main = threading.current_thread() is threading.main_thread()
        return hasattr(signal, "setitimer") and is_main and self._until is None

    @contextmanager
    def set_to(self, seconds: float) -> Iterator[None]:
        """Have the alarm after so many seconds; who had one gets what is left of it afterwards."""
        if signal.getsignal(signal.SIGALRM) != self._ring:
            # Never put back: one that comes a moment too late must find somebody who lets it pass.
            self._before = signal.signal(signal.SIGALRM, self._ring)
        began = time.monotonic()
        self._until = began + seconds
        theirs, interval = signal.setitimer(signal.ITIMER_REAL, seconds)
        try:
            yield
        finally:
            self._until = None
            left = max(theirs - (time.monotonic() - began), 1e-3) if theirs else 0.0
            signal.setitimer(signal.ITIMER_REAL, left, interval)

    def _ring(self, number: int, frame: FrameType | None) -> None:
        if self._until is not None and time.monotonic() >= self._until:
            self._until = None
            raise OverdueError
        if self._until is None and callable(self._before):
            self._before(number, frame)


_clock = _Clock()


@contextmanager
def stopped_after(seconds: float) -> Iterator[None]:
    """Raise `OverdueError` in what runs within as soon as the time is over.

    That bounds every loop of Python's; one in C is bounded by the size of its arrays.
    """
    if not _clock.is_free:
        yield
        return
    try:
        with _clock.set_to(seconds):
            yield
    except OverdueError as problem:
        text = f"it ran for longer than {seconds:g} s and was stopped"
        raise OverdueError(text).with_traceback(problem.__traceback__) from None
