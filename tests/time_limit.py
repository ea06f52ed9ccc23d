"""The time limit of each phase of a test: set-up, call and teardown.

A phase that exceeds it ends its process with the traceback of all threads; pytest-xdist reports the crash as
the failure of that test and goes on in a new process. The thread that watches is one of C: it needs neither
the interpreter nor an event loop that comes back.

The limit is `LIMIT_S`, for a test with the marker ``time_limit(seconds)`` the marker's; 0 is none. pytest's
own ``faulthandler_timeout`` has another thread for each test, and takes it back as soon as something has
failed: the teardown of a failed test could last for ever.
"""

from __future__ import annotations

import faulthandler
import math
import os
import time

import pytest
from _pytest.faulthandler import get_stderr_fileno

LIMIT_S = 600.0
"""For what hangs, on a machine with any load."""

_SHARE = 0.1
"""Part of the limit that earlier phases and tests may use of it.

To end one thread and to start the next one takes some milliseconds of a busy machine.
"""

_descriptor = pytest.StashKey[int]()


class Watchdog:
    """The thread that watches, and how long it has watched."""

    def __init__(self) -> None:
        self._seconds, self._began = 0.0, -math.inf

    def begin_phase(self, item: pytest.Item) -> None:
        """Let the limit count from now on, unless it has done so for a moment only."""
        marker = item.get_closest_marker("time_limit")
        seconds = marker.args[0] if marker else LIMIT_S
        now = time.monotonic()
        if seconds == self._seconds and now - self._began <= _SHARE * seconds:
            return
        self.end()
        if seconds > 0.0:
            self._seconds, self._began = seconds, now
            faulthandler.dump_traceback_later(seconds, exit=True, file=item.config.stash[_descriptor])

    def end(self) -> None:
        """Take the limit back; the next phase has one of its own."""
        faulthandler.cancel_dump_traceback_later()
        self._seconds, self._began = 0.0, -math.inf


watchdog = Watchdog()


def pytest_configure(config):
    config.addinivalue_line("markers", "time_limit(seconds): the limit of each phase of the test; 0 is none")
    # While tests run, pytest has another file in place of the real one.
    config.stash[_descriptor] = os.dup(get_stderr_fileno())


def pytest_unconfigure(config):
    os.close(config.stash[_descriptor])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(nextitem):
    try:
        return (yield)
    finally:
        if nextitem is None:
            watchdog.end()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item):
    watchdog.begin_phase(item)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_call(item):
    watchdog.begin_phase(item)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_teardown(item):
    watchdog.begin_phase(item)


@pytest.hookimpl(trylast=True)
def pytest_exception_interact():
    watchdog.end()  # pytest has taken the limit back
