"""Limit of processor time for a child process that reads files of other programs.

The child limits itself with `limit_processor_time`; the parent recognises the limit by the exit code and
waits at most `longest_wait`. Time of other programs on a busy computer does not count, nor does the start of
the child.
"""

from __future__ import annotations

import math
import os
import signal
import threading
import time
from typing import Final

PROCESSOR_LIMIT: Final = "--processor-limit"
"""Internal command line option that limits the program itself while it runs code from files."""

_OVERDUE: Final = 124
"""Exit code where no signal can end the process; the same as of the command ``timeout``."""

_POLL_S = 0.05


def limit_processor_time(seconds: float) -> None:
    """End this process after `seconds` more of processor time; infinity removes the limit.

    Must be called in the main thread. The system ends the process, whatever it does. Windows has no such
    timer: there a thread watches, which code in C may block; then `longest_wait` is the limit.
    """
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGPROF, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_PROF, seconds if math.isfinite(seconds) else 0.0)
    else:
        _watch.limit(seconds)


def was_overdue(code: int) -> bool:
    """Return whether an exit code is that of a process that reached its limit of processor time."""
    return code == (-signal.SIGPROF if hasattr(signal, "setitimer") else _OVERDUE)


def longest_wait(seconds: float) -> float:
    """Return the seconds of real time after which a process with `seconds` of processor time is ended.

    A sleeping process uses no processor time, but must end as well. Start and work take less than this even
    with a dozen busy programs for every processor.
    """
    return 60.0 + 20.0 * seconds


class _Watch:
    """Thread that ends this process when its processor time is used up."""

    def __init__(self) -> None:
        self._end = math.inf
        self._thread: threading.Thread | None = None

    def limit(self, seconds: float) -> None:
        """Set the limit; the thread starts with the first call."""
        self._end = time.process_time() + seconds
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="processor limit", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while time.process_time() < self._end:
            time.sleep(_POLL_S)
        os._exit(_OVERDUE)


_watch = _Watch()
