"""Offsets in the plane: their sum, their part along an axis, their angle in steps of 15°."""

from __future__ import annotations

import math

from ..document.model import Vector
from .pointer import Pointer


def minus(a: Vector, b: Vector) -> Vector:
    """Return the offset from `b` to `a`."""
    return (a[0] - b[0], a[1] - b[1])


def plus(a: Vector, b: Vector) -> Vector:
    """Return the position at the offset `b` from `a`."""
    return (a[0] + b[0], a[1] + b[1])


def longer_axis(offset: Vector) -> int:
    """Return the axis, 0 or 1, along which an offset is longer."""
    return 0 if abs(offset[0]) >= abs(offset[1]) else 1


def axis_held(offset: Vector, pointer: Pointer) -> int | None:
    """Return the axis that Ctrl or Shift keeps an offset to, None while neither is held."""
    return longer_axis(offset) if pointer.is_constrained else None


def along_axis(offset: Vector, axis: int | None) -> Vector:
    """Return the part of an offset along one axis, all of it for None."""
    return offset if axis is None else (offset[0], 0.0) if axis == 0 else (0.0, offset[1])


def in_steps(v: Vector) -> Vector:
    """Turn `v` to the nearest multiple of 15 degrees; along the axes exactly."""
    steps = round(math.degrees(math.atan2(v[1], v[0])) / 15)
    length = math.hypot(*v)
    if steps % 6 == 0:
        x, y = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[steps // 6 % 4]
    else:
        x, y = math.cos(math.radians(15 * steps)), math.sin(math.radians(15 * steps))
    return (length * x, length * y)
