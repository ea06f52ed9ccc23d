"""Reports of long work: it says how far it is, and hears that it is no longer wanted.

Work that may take longer than a moment takes a `Report` and calls it now and then.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import inf
from typing import TypeVar

Item = TypeVar("Item")

Report = Callable[[float, str], None]
"""Callback that takes the share done, 0 to 1, and a word for the work; it raises `Cancelled`."""

FINAL = inf
"""Reported in place of a share before a step that cannot be taken back; from then on nothing is cancelled."""


class Cancelled(Exception):  # noqa: N818 - nothing has gone wrong
    """The person has taken the order back; whatever was half done is to be dropped."""


def silent(_share: float, _word: str) -> None:
    """Report to nobody."""


def with_progress(items: Sequence[Item], report: Report, word: str) -> Iterator[Item]:
    """Yield items one after the other, and report before each: a loop that tells, and that can be stopped."""
    for place, item in enumerate(items):
        report(place / len(items), word)
        yield item


def part(report: Report, start: float, end: float) -> Report:
    """Return a report for a part of the work, which goes on from `start` to `end` of the whole."""
    return lambda share, word: report(start + (end - start) * share, word)
