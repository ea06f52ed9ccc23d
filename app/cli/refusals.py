"""Output of the command line: refusals and remarks, each in one line; results."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable
from typing import Any


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


def say_json(content: dict[str, Any] | list[dict[str, Any]]) -> None:
    """Print plain values to the standard output."""
    say(json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False))


def tell(remarks: Iterable[str]) -> None:
    """Print what was left out or is otherwise, line by line, beside the output."""
    for remark in remarks:
        print(f"curvebench: {one_line(remark)}", file=sys.stderr)


def reason_of(problem: OSError) -> str:
    """Return what the system says, and of which file; some errors have words of their own only."""
    reason = problem.strerror or str(problem) or type(problem).__name__
    return f"{reason}: “{os.fsdecode(problem.filename)}”" if _has_name(problem) else reason


def _has_name(problem: OSError) -> bool:
    return isinstance(problem.filename, str | bytes | os.PathLike) and bool(problem.filename)


def one_line(text: str) -> str:
    """Return text on one line, without characters that would steer a terminal."""
    return "".join(character if character.isprintable() else " " for character in text)
