"""Output of the command line: results, refusals and remarks, each in one line, and progress on a terminal."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable
from time import perf_counter
from typing import Any, Self


class RefusalError(Exception):
    """Error of a command; the text says why."""


def print_text(text: str = "", end: str = "\n") -> None:
    """Print a text to the standard output.

    Raises
    ------
    RefusalError
        If it cannot be written. A reader that is gone is a `BrokenPipeError` still.
    """
    try:
        print(text, end=end, flush=True)
    except BrokenPipeError:
        raise
    except OSError as problem:
        raise RefusalError(f"The output cannot be written ({reason_of(problem)}).") from None


def print_json(content: dict[str, Any] | list[dict[str, Any]]) -> None:
    """Print plain values to the standard output."""
    print_text(json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False))


def print_remarks(remarks: Iterable[str]) -> None:
    """Print remarks to the standard error, one a line."""
    for remark in remarks:
        print(f"curvebench: {one_line(remark)}", file=sys.stderr)


def reason_of(problem: OSError) -> str:
    """Return the message of an error of the system, with the name of its file."""
    reason = problem.strerror or str(problem) or type(problem).__name__
    is_named = isinstance(problem.filename, str | bytes | os.PathLike) and problem.filename
    return f"{reason}: “{os.fsdecode(problem.filename)}”" if is_named else reason


def one_line(text: str) -> str:
    """Return text on one line, without control characters."""
    return "".join(character if character.isprintable() else " " for character in text)


# Progress


PATIENCE = 0.2
"""Seconds of work without a word, and between two words."""


class TerminalProgress:
    """Report that shows the progress of work on a terminal, from 0.2 s on.

    A context manager that removes the line at its end.
    """

    def __init__(self) -> None:
        self._began = self._last = perf_counter()
        self._is_visible = False

    def __call__(self, share: float, word: str) -> None:
        """Write the share that is done, and a word for the work; see `Report`."""
        now = perf_counter()
        if share < 1.0 and sys.stderr.isatty() and min(now - self._began, now - self._last) > PATIENCE:
            self._last, self._is_visible = now, True
            print(f"\r{word}: {share:.0%}\033[K", end="", file=sys.stderr, flush=True)

    def clear(self) -> None:
        """Remove the line before other output."""
        if self._is_visible:
            self._is_visible = False
            print("\r\033[K", end="", file=sys.stderr, flush=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_problem: object) -> None:
        self.clear()
