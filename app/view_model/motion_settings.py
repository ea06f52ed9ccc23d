"""The settings of a dot that runs along a curve: speed, pace, and repetition at the end."""

from __future__ import annotations

import enum

import msgspec

from ..families import FAMILIES, Family

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)


def timed_families() -> tuple[Family, ...]:
    """Return the families whose curves pass the points at the t_i, which can be compared in motion."""
    return tuple(family for family in FAMILIES if family.interpolates)


class Repeat(enum.StrEnum):
    """The continuation of a motion at the end of the curve."""

    ONCE = "once"
    LOOP = "loop"
    PING_PONG = "ping-pong"


class Pace(enum.StrEnum):
    """The quantity that grows evenly with time."""

    PARAMETER = "t"
    LENGTH = "length"


class MotionSettings(msgspec.Struct, frozen=True):
    """The settings of the dot; neither saved with the document nor undone.

    Attributes
    ----------
    speed
        Seconds of the motion in a second of the clock.
    compared
        The families whose curves through the same points run side by side with the curve itself.
    """

    speed: float = 1.0
    repeat: Repeat = Repeat.LOOP
    pace: Pace = Pace.PARAMETER
    compared: frozenset[Family] = frozenset()
