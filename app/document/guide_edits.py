"""Edits of the guides: pure functions like those of `edits`."""

from __future__ import annotations

from msgspec.structs import replace

from .limits import EditError, checked
from .model import Axis, Document, Guide
from .words import number

_DIGITS = 9


def place_words(guide: Guide, unit: str = "") -> str:
    """Return where a guide lies: "x = 20 mm"."""
    return f"{guide.axis.value} = {number(guide.position, _DIGITS)}{f' {unit}' if unit else ''}"


def add_guide(document: Document, axis: Axis, position: float) -> Document:
    """Draw a guide more; refused where there is one."""
    guide = Guide(axis, checked(position, f"The {axis.value} of a guide"))
    if guide in document.guides:
        raise EditError(f"There is a guide at {place_words(guide)} already.")
    return replace(document, guides=(*document.guides, guide))


def move_guide(document: Document, place: int, position: float) -> Document:
    """Move a guide, given by its place in the document."""
    guide = _guide(document, place)
    moved = replace(guide, position=checked(position, f"The {guide.axis.value} of a guide"))
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


def _guide(document: Document, place: int) -> Guide:
    if not 0 <= place < len(document.guides):
        raise EditError("There is no such guide.")
    return document.guides[place]
