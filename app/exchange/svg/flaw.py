"""What of a style is not taken over."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Flaw:
    """Part of a style that is not taken over: why, and what is done instead."""

    why: str
    instead: str
