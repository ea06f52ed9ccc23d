"""Words that several hints share: of a move, of selected points, of locked curves, of snapping."""

from __future__ import annotations

from ..document.point_group import PointGroup
from .pointer import Pointer

LOCKED = "“{}” is locked. Unlock it in the list of curves to change it."


def selected(group: PointGroup) -> str:
    """Return "Point 3 selected", "5 points in 2 curves selected"."""
    words = f"{group.label} selected" if group.parts else "no point selected"
    return f"{words[0].upper()}{words[1:]}"


def to_move(what: str, pointer: Pointer) -> str:
    """Return the effect of a drag of points or curves with the keys that are held."""
    axis = " along one axis" if pointer.is_constrained else ""
    return f"Drag to move {what}{axis}"


def snap_key(*, snaps: bool) -> str:
    """Return the present effect of the key for snapping."""
    return f"%: {'no snap' if snaps else 'snap'}"
