"""Checks of the numbers that a document may hold, and the error of an edit that cannot be done."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .fields import Vector
from .words import number

MAX_MAGNITUDE = 1e12
"""Largest coordinate, parameter or derivative a document may hold: beyond it a drawing means nothing."""


class EditError(ValueError):
    """An edit that cannot be done; the message tells the person why."""


class AlreadySoError(EditError):
    """An edit that would change nothing, for what was wanted is so already: it is told, and no refusal."""


def checked(value: float, what: str) -> float:
    """Return `value` if a document may hold it."""
    if not math.isfinite(value):
        raise EditError(f"{what} must be a finite number.")
    if abs(value) > MAX_MAGNITUDE:
        raise EditError(f"{what} must lie between −1e12 and 1e12.")
    return float(value)


def checked_vector(vector: Vector, what: str) -> Vector:
    """Return `vector` if a document may hold it."""
    x, y = vector
    if abs(x) <= MAX_MAGNITUDE and abs(y) <= MAX_MAGNITUDE:
        return (float(x), float(y))
    return (checked(x, f"The x of {what}"), checked(y, f"The y of {what}"))


def are_within(values: Sequence[float]) -> bool:
    """Whether all numbers are plain floats that a document may hold, at one look."""
    if not values:
        return True
    # A sum is NaN if anything is, while min and max may pass it over.
    is_plain = set(map(type, values)) == {float} and not math.isnan(sum(values))
    return is_plain and min(values) >= -MAX_MAGNITUDE and max(values) <= MAX_MAGNITUDE


def not_after(index: int, before: float) -> EditError:
    """Return the error of a point whose t is not greater than that of the point before it."""
    return EditError(
        f"The t of point {index} must be greater than {number(before, 6)}, the t of point {index - 1}."
    )
