"""Limit of processor time for a process that works on files of others.

The child limits itself, by `limit_processor_time`; the parent recognises by the exit code that the limit was
reached, and waits as long as `longest_wait` says. Time that a busy machine gives to other programs does not
count, nor does the start of the child.
"""

from __future__ import annotations

import math
import os
import signal
import threading
import time
from typing import Final

PROCESSOR_LIMIT: Final = "--processor-limit"
"""Option of the command line that limits the program itself, for files whose code it runs; not for people."""

_OVERDUE: Final = 124
"""Exit code where no signal ends the process; that of the command ``timeout``."""

_POLL_S = 0.05


def limit_processor_time(seconds: float) -> None:
    """End this process once it has used so many more seconds of the processor; infinity lifts the limit.

    To be called in the main thread. The system ends the process, whatever it does. Windows has no such timer:
    a thread watches there, which code in C may keep from running; `longest_wait` is the limit of that.
    """
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGPROF, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_PROF, seconds if math.isfinite(seconds) else 0.0)
    else:
        _watch.limit(seconds)


def was_overdue(code: int) -> bool:
    """Return whether the exit code is that of a process that reached its limit of processor time."""
    return code == (-signal.SIGPROF if hasattr(signal, "setitimer") else _OVERDUE)


def longest_wait(seconds: float) -> float:
    """Return how many seconds of the clock a process may take that has `seconds` of processor time.

    A process that sleeps uses no processor and still has to end. Neither its start nor its work takes as long
    as this beside a dozen busy programs for every processor.
    """
    return 60.0 + 20.0 * seconds


class _Watch:
    """Thread that ends this process when its processor time is used up."""

    def __init__(self) -> None:
        self._end = math.inf
        self._thread: threading.Thread | None = None

    def limit(self, seconds: float) -> None:
        """Have the limit from now on; the thread starts with the first one."""
        self._end = time.process_time() + seconds
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="processor limit", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while time.process_time() < self._end:
            time.sleep(_POLL_S)
        os._exit(_OVERDUE)


_watch = _Watch()
