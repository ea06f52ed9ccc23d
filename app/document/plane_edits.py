"""Edits of the plane that a document is drawn in: its unit, its grid and its guides."""

from __future__ import annotations

from msgspec.structs import replace

from .limits import AlreadySoError, EditError, checked
from .model import Axis, Document, Guide
from .words import number


def set_unit(document: Document, unit: str) -> Document:
    """Call a length of one by another name; every number stays, and means that from now on."""
    return replace(document, unit=unit)


def set_grid_spacing(document: Document, spacing: float) -> Document:
    """Draw the lines of the grid at another distance; 0 adapts it to the zoom."""
    return replace(document, grid_spacing=checked(spacing, "The spacing"))


_DIGITS = 9


def place_words(guide: Guide, unit: str = "") -> str:
    """Return where a guide lies: "x = 20 mm"."""
    position = number(guide.position, _DIGITS)
    return f"{guide.axis.value} = {position} {unit}".rstrip()


def add_guide(document: Document, axis: Axis, position: float) -> Document:
    """Draw a guide more; refused where there is one."""
    guide = Guide(axis, _checked(axis, position))
    if guide in document.guides:
        raise AlreadySoError(f"There is a guide at {place_words(guide)} already.")
    return replace(document, guides=(*document.guides, guide))


def move_guide(document: Document, place: int, position: float) -> Document:
    """Put a guide elsewhere along its axis."""
    guide = _guide(document, place)
    return _with_guide(document, place, replace(guide, position=_checked(guide.axis, position)))


def remove_guide(document: Document, place: int) -> Document:
    """Remove a guide."""
    _guide(document, place)
    return _with_guide(document, place)


def clear_guides(document: Document) -> Document:
    """Remove all guides."""
    if not document.guides:
        raise EditError("There are no guides.")
    return replace(document, guides=())


def _checked(axis: Axis, position: float) -> float:
    return checked(position, f"The {axis.value} of a guide")


def _with_guide(document: Document, place: int, *other: Guide) -> Document:
    return replace(document, guides=(*document.guides[:place], *other, *document.guides[place + 1 :]))


def _guide(document: Document, place: int) -> Guide:
    if not 0 <= place < len(document.guides):
        raise EditError("There is no such guide.")
    return document.guides[place]
