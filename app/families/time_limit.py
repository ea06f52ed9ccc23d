"""A limit of time for the Python of others that runs in the caller's thread."""

from __future__ import annotations

import ctypes
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

_TICK_S = 0.1


class OverdueError(RuntimeError):
    """Code ran for longer than it may; its traceback ends where it was."""


class _Watch:
    """The thread that looks at the clock while something with a limit runs; begun with the first."""

    def __init__(self) -> None:
        self._until: dict[int, float] = {}
        self._lock, self._wake = threading.Lock(), threading.Event()
        self._thread: threading.Thread | None = None

    def begin(self, seconds: float) -> None:
        """Raise `OverdueError` in this thread after so many seconds, unless it comes to `end` before."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._look, name="time limit", daemon=True)
            self._thread.start()
        self._until[threading.get_ident()] = time.monotonic() + seconds
        self._wake.set()

    def end(self) -> None:
        """Raise nothing in this thread any more."""
        thread = threading.get_ident()
        with self._lock:
            if self._until.pop(thread, None) is None:
                # It was raised, and perhaps has not arrived.
                _raise_in(thread, None)

    def _look(self) -> None:
        while True:
            self._wake.wait()
            self._wake.clear()
            while self._until:
                time.sleep(_TICK_S)
                with self._lock:
                    for thread, until in tuple(self._until.items()):
                        if time.monotonic() > until:
                            del self._until[thread]
                            _raise_in(thread, OverdueError)


def _raise_in(thread: int, problem: type[BaseException] | None) -> None:
    raised = ctypes.py_object(problem) if problem is not None else None
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), raised)


_watch = _Watch()


@contextmanager
def stopped_after(seconds: float) -> Iterator[None]:
    """Raise `OverdueError` in what runs within as soon as the time is over.

    That bounds every loop of Python's; one in C is bounded by the size of its arrays.
    """
    try:
        _watch.begin(seconds)
        try:
            yield
        finally:
            _watch.end()
    except OverdueError as problem:
        text = f"it ran for longer than {seconds:g} s and was stopped"
        raise OverdueError(text).with_traceback(problem.__traceback__) from None
