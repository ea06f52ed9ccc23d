"""Progress of a command, on a terminal."""

from __future__ import annotations

import sys
from time import perf_counter
from typing import Self

PATIENCE = 0.2
"""Seconds of work without a word, and between two words."""


class TerminalProgress:
    """Report that writes to a terminal how far work has come, from 0.2 s on.

    A context manager: the line goes with it.
    """

    def __init__(self) -> None:
        self._began = self._last = perf_counter()
        self._is_shown = False

    def __call__(self, share: float, word: str) -> None:
        """Write the share that is done, and a word for the work; see `Report`."""
        now = perf_counter()
        if share < 1.0 and sys.stderr.isatty() and min(now - self._began, now - self._last) > PATIENCE:
            self._last, self._is_shown = now, True
            print(f"\r{word}: {share:.0%}\033[K", end="", file=sys.stderr, flush=True)

    def clear(self) -> None:
        """Take the line away, before something else is printed."""
        if self._is_shown:
            self._is_shown = False
            print("\r\033[K", end="", file=sys.stderr, flush=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_problem: object) -> None:
        self.clear()
