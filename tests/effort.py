"""How much work something is, counted: the same on every machine, busy or not."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import FrameType

import pytest


def profile(work: Callable[[], object], note: Callable[[FrameType, str, object], None]) -> None:
    """Do `work`, and tell `note` of each call and return in it."""
    before = sys.getprofile()
    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(before)


def calls_of(work: Callable[[], object]) -> int:
    """Return how many functions `work` calls, those written in C included."""
    count = 0

    def note(_frame: object, event: str, _argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    profile(work, note)
    return count


def noted_calls(monkeypatch: pytest.MonkeyPatch, owner: object, name: str) -> list[tuple[object, ...]]:
    """Return the arguments of all calls of a function of `owner` from now on; it does what it did."""
    calls: list[tuple[object, ...]] = []
    work = getattr(owner, name)

    def recording(*arguments: object, **named: object) -> object:
        calls.append(arguments)
        return work(*arguments, **named)

    monkeypatch.setattr(owner, name, recording)
    return calls
