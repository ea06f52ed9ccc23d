"""A limit of time for the Python of others that runs in the main thread.

By a signal of the system's, which Python hears between two instructions: a thread that kept the time could
collect garbage, and destroy widgets that are none of its business (see ``tasks.task``). Windows has no such
signal; there a process of its own, which tries a file first, is all that bounds it.
"""

from __future__ import annotations

import signal
import threading
import time
from types import FrameType, TracebackType

_AGAIN_S = 0.02
"""Seconds between alarms from the first one on: code may catch what an alarm raises."""

_BUSY = 0.8
"""Share of the limit that must have gone by at work, not waiting for other programs."""


def _longest_wait(seconds: float) -> float:
    """Return the seconds of the clock after which waiting code is stopped.

    A busy machine may take several to give a program a tenth of a second.
    """
    return 5.0 + 10.0 * seconds


class OverdueError(BaseException):
    """Code ran for longer than it may; its traceback ends where it was.

    No `Exception`: code that passes over all mistakes shall end, too.
    """


class _Clock:
    """The alarm of this process, with its earlier handler."""

    def __init__(self) -> None:
        self._seconds: float | None = None
        self._began = self._worked = 0.0
        self._before: object = None
        self._theirs = (0.0, 0.0)

    @property
    def is_free(self) -> bool:
        """Whether the system has an alarm that this thread receives and that is not set yet."""
        is_main = threading.current_thread() is threading.main_thread()
        return hasattr(signal, "setitimer") and is_main and self._seconds is None

    def start(self, seconds: float) -> None:
        """Set the alarm: after so many seconds, and then again and again."""
        if signal.getsignal(signal.SIGALRM) != self._ring:
            # Never put back: one that comes a moment too late must find somebody who lets it pass.
            self._before = signal.signal(signal.SIGALRM, self._ring)
        self._began, self._worked, self._seconds = time.monotonic(), time.thread_time(), seconds
        self._theirs = signal.setitimer(signal.ITIMER_REAL, seconds, _AGAIN_S)

    def stop(self) -> None:
        """Clear the alarm; an earlier one goes on with the rest of its time."""
        self._seconds = None
        theirs, interval = self._theirs
        left = max(theirs - (time.monotonic() - self._began), 1e-3) if theirs else 0.0
        signal.setitimer(signal.ITIMER_REAL, left, interval)

    def _ring(self, number: int, frame: FrameType | None) -> None:
        if self._seconds is None:
            if callable(self._before):
                self._before(number, frame)
        elif self._is_over(self._seconds) and (frame is None or frame.f_code.co_filename != __file__):
            # In this file it is just being stopped.
            raise OverdueError

    def _is_over(self, seconds: float) -> bool:
        worked = time.thread_time() - self._worked
        return worked >= _BUSY * seconds or time.monotonic() - self._began >= _longest_wait(seconds)


_clock = _Clock()


class stopped_after:  # noqa: N801 - reads as a word of the language
    """Context that raises `OverdueError` in its body when the time is over.

    That bounds every loop of Python's; one in C is bounded by the size of its arrays. Time that the machine
    gives to other programs does not count, up to `_longest_wait`.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds, self._is_set = seconds, False

    def __enter__(self) -> None:
        if _clock.is_free:
            self._is_set = True
            _clock.start(self._seconds)

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not self._is_set:
            return
        _clock.stop()
        if isinstance(problem, OverdueError):
            text = f"it ran for longer than {self._seconds:g} s and was stopped"
            raise OverdueError(text).with_traceback(trace) from None
