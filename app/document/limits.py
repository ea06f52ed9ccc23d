"""Limits of the numbers in a document, and the error of an impossible edit."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .fields import Vector
from .words import number

MAX_MAGNITUDE = 1e12
"""Largest coordinate, parameter or derivative that a document may hold."""


class EditError(ValueError):
    """An edit is impossible; the message for the status line gives the reason and a remedy.

    An edit raises it, ``raise EditError("“Sketch” is locked. Unlock it in the list of curves.")``;
    `Session.change` and `Drag.move` show the message and leave the document as it is.
    """


class AlreadySoError(EditError):
    """An edit would change nothing: its message is shown as information, not as a refusal."""


def checked(value: float, subject: str) -> float:
    """Return a number as a float, or raise EditError if a document may not hold it."""
    if not math.isfinite(value):
        raise EditError(f"{subject} must be a finite number.")
    if abs(value) > MAX_MAGNITUDE:
        raise EditError(f"{subject} must lie between −1e12 and 1e12.")
    return float(value)


def checked_vector(vector: Vector, subject: str) -> Vector:
    """Return a vector of floats, or raise EditError if a document may not hold it."""
    x, y = vector
    if abs(x) <= MAX_MAGNITUDE and abs(y) <= MAX_MAGNITUDE:
        return (float(x), float(y))
    return (checked(x, f"The x of {subject}"), checked(y, f"The y of {subject}"))


def are_within(values: Sequence[float]) -> bool:
    """Return whether all numbers are plain floats that a document may hold; fast for many."""
    if not values:
        return True
    # A sum is NaN if any number is, while min and max may ignore NaN.
    is_plain = set(map(type, values)) == {float} and not math.isnan(sum(values))
    return is_plain and min(values) >= -MAX_MAGNITUDE and max(values) <= MAX_MAGNITUDE


def not_after(index: int, parameters: Sequence[float]) -> EditError:
    """Return the error that the t of a point is not greater than that of the point before it."""
    before = t_text(parameters[index - 1], parameters)
    return EditError(f"The t of point {index} must be greater than {before}, the t of point {index - 1}.")


def t_text(t: float, parameters: Sequence[float]) -> str:
    """Return the text of a parameter among others, with as many digits as show a thousandth of them."""
    return number(t, 6, step=(max(parameters) - min(parameters)) / 1000.0)
