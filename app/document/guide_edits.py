"""Edits of the guides: pure functions like those of `edits`."""

from __future__ import annotations

from msgspec.structs import replace

from .limits import AlreadySoError, EditError, checked
from .model import Axis, Document, Guide
from .words import number

_DIGITS = 9


def place_words(guide: Guide, unit: str = "") -> str:
    """Return where a guide lies: "x = 20 mm", "30° through (5, 20) mm"."""
    suffix = f" {unit}" if unit else ""
    if guide.lean:
        x, y = (number(each, _DIGITS) for each in guide.point)
        return f"{number(guide.angle, _DIGITS)}° through ({x}, {y}){suffix}"
    return f"{guide.axis.value} = {number(guide.position, _DIGITS)}{suffix}"


def add_guide(
    document: Document, axis: Axis, position: float, lean: float = 0.0, across: float = 0.0
) -> Document:
    """Draw a guide more, of these values; refused where there is one."""
    guide = _checked(Guide(axis, position, lean, across))
    if guide in document.guides:
        raise AlreadySoError(f"There is a guide at {place_words(guide)} already.")
    return replace(document, guides=(*document.guides, guide))


def move_guide(document: Document, place: int, to: Guide) -> Document:
    """Put another guide in the place of one of the document."""
    _guide(document, place)
    moved = _checked(to)
    return replace(document, guides=(*document.guides[:place], moved, *document.guides[place + 1 :]))


def remove_guide(document: Document, place: int) -> Document:
    """Remove a guide."""
    _guide(document, place)
    return replace(document, guides=(*document.guides[:place], *document.guides[place + 1 :]))


def clear_guides(document: Document) -> Document:
    """Remove all guides."""
    if not document.guides:
        raise EditError("There are no guides.")
    return replace(document, guides=())


def _checked(guide: Guide) -> Guide:
    position = checked(guide.position, f"The {guide.axis.value} of a guide")
    return guide.through(position, checked(guide.across, f"The {guide.axis.other.value} of a guide"))


def _guide(document: Document, place: int) -> Guide:
    if not 0 <= place < len(document.guides):
        raise EditError("There is no such guide.")
    return document.guides[place]
