"""Words that several hints share: what a drag moves, what is selected, what is locked."""

from __future__ import annotations

from ..document.point_group import PointGroup
from .pointer import Pointer

LOCKED = "“{}” is locked. Unlock it in the list of curves to change it."


def selected(group: PointGroup) -> str:
    """Return how many points are selected: "Point 3 selected", "5 points in 2 curves selected"."""
    words = f"{group.label} selected" if group.parts else "no point selected"
    return f"{words[0].upper()}{words[1:]}"


def to_move(what: str, pointer: Pointer) -> str:
    """Return what a drag of points or curves does with the keys that are held."""
    axis = " along one axis" if pointer.holds_line else ""
    return f"Drag to move {what}{axis}"


def snap_key(*, snaps: bool) -> str:
    """Return what the key of snapping does now."""
    return f"%: {'no snap' if snaps else 'snap'}"
