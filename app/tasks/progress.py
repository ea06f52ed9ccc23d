"""Progress of long work: the work reports its share done, and is cancelled by that report.

A function that may take longer than a moment takes a `Report` and calls it now and then.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import inf
from typing import TypeVar

Item = TypeVar("Item")

Report = Callable[[float, str], None]
"""Callback that takes the share done, 0 to 1, and a word for the work; raises `Cancelled` to stop it."""

FINAL = inf
"""Share that is reported before a step that cannot be undone; from then on, the work cannot be cancelled."""


class Cancelled(Exception):  # noqa: N818 - this is no error
    """The person has cancelled the work; partial results must be dropped."""


def silent(_share: float, _word: str) -> None:
    """Ignore the progress."""


def with_progress(items: Sequence[Item], report: Report, word: str) -> Iterator[Item]:
    """Yield items and report the progress before each: a loop that shows progress and can be cancelled."""
    for index, item in enumerate(items):
        report(index / len(items), word)
        yield item


def part(report: Report, start: float, end: float) -> Report:
    """Return the report of a part of the work, from the share `start` to the share `end` of the whole."""
    return lambda share, word: report(start + (end - start) * share, word)
