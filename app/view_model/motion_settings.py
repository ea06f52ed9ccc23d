"""The settings of a dot that runs along a curve: speed, pace, and what follows at the end."""

from __future__ import annotations

import enum

import msgspec

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)


class Repeat(enum.StrEnum):
    """The ways to go on at the end of the curve."""

    ONCE = "once"
    LOOP = "loop"
    PING_PONG = "ping-pong"


class Pace(enum.StrEnum):
    """The quantities that may grow evenly with time."""

    PARAMETER = "t"
    LENGTH = "length"


class MotionSettings(msgspec.Struct, frozen=True):
    """The settings of the dot; neither saved with the document nor undone.

    Attributes
    ----------
    speed
        Seconds of the motion in a second of the clock.
    compares
        Whether the cubic and the quintic Hermite curve through the same points run side by side.
    """

    speed: float = 1.0
    repeat: Repeat = Repeat.LOOP
    pace: Pace = Pace.PARAMETER
    compares: bool = False
