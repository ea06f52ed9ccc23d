"""The time limit of each phase of a test: set-up, call and teardown.

A phase that exceeds it ends its process with the traceback of all threads; pytest-xdist reports the crash as
the failure of that test and goes on in a new process. The thread that watches is one of C: it needs neither
the interpreter nor an event loop that comes back.

The limit is pytest's own option ``faulthandler_timeout``, for a test with the marker ``time_limit(seconds)``
the marker's; 0 is none. pytest itself sets it once a test, and takes it back as soon as something has failed:
the teardown of a failed test could last for ever.
"""

from __future__ import annotations

import faulthandler
import os
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from _pytest.faulthandler import get_stderr_fileno

_descriptor = pytest.StashKey[int]()


def pytest_configure(config):
    config.addinivalue_line("markers", "time_limit(seconds): the limit of each phase of the test; 0 is none")
    # While tests run, pytest has another file in place of the real one.
    config.stash[_descriptor] = os.dup(get_stderr_fileno())


def pytest_unconfigure(config):
    os.close(config.stash[_descriptor])


@contextmanager
def _limited(item: pytest.Item) -> Iterator[None]:
    marker = item.get_closest_marker("time_limit")
    seconds = marker.args[0] if marker else float(item.config.getini("faulthandler_timeout") or 0.0)
    if seconds > 0.0:
        faulthandler.dump_traceback_later(seconds, exit=True, file=item.config.stash[_descriptor])
    else:
        faulthandler.cancel_dump_traceback_later()
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_setup(item):
    with _limited(item):
        return (yield)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_call(item):
    with _limited(item):
        return (yield)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_teardown(item):
    with _limited(item):
        return (yield)
