"""Short words for people: numbers, points, amounts."""

from __future__ import annotations

import math
from collections.abc import Collection

from app.document.model import Vector
from app.document.several_curves import NodeGroup


def number(value: float) -> str:
    """Return a number with four digits and a true minus sign."""
    text = f"{value + 0.0:.4g}"
    return text.replace("-", "−") if text != "-0" else "0"


def vector(value: Vector) -> str:
    """Return both coordinates."""
    return f"{number(value[0])}, {number(value[1])}"


def points(indices: Collection[int]) -> str:
    """Return "point 3" or "4 points"."""
    return f"point {next(iter(indices))}" if len(indices) == 1 else f"{len(indices)} points"


def group(nodes: NodeGroup) -> str:
    """Return "point 3", "4 points" or "3 curves"."""
    return f"{len(nodes.parts)} curves" if nodes.is_several else points(nodes.parts[0][1])


def point_at(index: int, place: Vector) -> str:
    """Return "Point 3 at 2.4, 5.158"."""
    return f"Point {index} at {vector(place)}"


def polar(value: Vector) -> str:
    """Return length and direction, "3.2 at 45°"."""
    return f"{number(math.hypot(*value))} at {angle(math.degrees(math.atan2(value[1], value[0])))}"


def angle(degrees: float) -> str:
    """Return an angle to a tenth of a degree."""
    rounded = round(degrees, 1) + 0.0
    return f"{rounded:g}°".replace("-", "−")
