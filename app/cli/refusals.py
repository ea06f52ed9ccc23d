"""Refusals of the command line, each in one line."""

from __future__ import annotations

import os


class RefusalError(Exception):
    """A command cannot be done; the text says why."""


def say(text: str = "", end: str = "\n") -> None:
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


def reason_of(problem: OSError) -> str:
    """Return what the system says, and of which file; some errors have words of their own only."""
    reason = problem.strerror or str(problem) or type(problem).__name__
    return f"{reason}: “{os.fsdecode(problem.filename)}”" if _has_name(problem) else reason


def _has_name(problem: OSError) -> bool:
    return isinstance(problem.filename, str | bytes | os.PathLike) and bool(problem.filename)


def one_line(text: str) -> str:
    """Return text on one line, without characters that would steer a terminal."""
    return "".join(character if character.isprintable() else " " for character in text)
