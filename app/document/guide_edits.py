"""Edits of the guides: pure functions like those of `edits`."""

from __future__ import annotations

from collections.abc import Iterable

from msgspec.structs import replace

from .limits import AlreadySoError, EditError, checked
from .model import Axis, Document, Guide
from .readings import Readings, readings_of
from .words import number

_DIGITS = 9


def place_words(guide: Guide, readings: Readings, unit: str = "") -> str:
    """Return where a guide lies, as it is told: "x = 20 mm", "30° through (5, 20) mm"."""
    suffix = f" {unit}" if unit else ""
    if guide.lean:
        x, y = (number(each, _DIGITS) for each in readings.shown(guide.point))
        return f"{number(readings.line_angle(guide.angle), _DIGITS)}° through ({x}, {y}){suffix}"
    position = readings.shown_at(guide.axis.coordinate, guide.position)
    return f"{guide.axis.value} = {number(position, _DIGITS)}{suffix}"


def locked_words(guide: Guide, readings: Readings) -> str:
    """Return why a guide is neither moved nor removed."""
    return f"The guide at {place_words(guide, readings)} is locked."


def add_guide(
    document: Document, axis: Axis, position: float, lean: float = 0.0, across: float = 0.0
) -> Document:
    """Draw a guide more, of these values; refused where there is one."""
    guide = _checked(Guide(axis, position, lean, across))
    if any(replace(each, locked=False) == guide for each in document.guides):
        raise AlreadySoError(f"There is a guide at {place_words(guide, readings_of(document))} already.")
    return replace(document, guides=(*document.guides, guide))


def add_guides(document: Document, guides: Iterable[Guide]) -> Document:
    """Draw guides where there are none yet."""
    free = [replace(each, locked=False) for each in document.guides]
    new = [each for each in dict.fromkeys(map(_checked, guides)) if each not in free]
    if not new:
        raise AlreadySoError("There are guides there already.")
    return replace(document, guides=(*document.guides, *new))


def move_guide(document: Document, place: int, to: Guide) -> Document:
    """Put another guide in the place of one of the document."""
    _refuse_locked(document, place)
    return _with_guide(document, place, _checked(to))


def lock_guide(document: Document, place: int, *, locked: bool = True) -> Document:
    """Keep a guide where it is, or let it be moved and removed again."""
    return _with_guide(document, place, replace(_guide(document, place), locked=locked))


def remove_guide(document: Document, place: int) -> Document:
    """Remove a guide."""
    _refuse_locked(document, place)
    return _with_guide(document, place)


def clear_guides(document: Document) -> Document:
    """Remove all guides but those that are locked."""
    if not document.guides:
        raise EditError("There are no guides.")
    kept = tuple(each for each in document.guides if each.locked)
    if kept == document.guides:
        raise EditError("All guides are locked.")
    return replace(document, guides=kept)


def _checked(guide: Guide) -> Guide:
    position = checked(guide.position, f"The {guide.axis.value} of a guide")
    return guide.through(position, checked(guide.across, f"The {guide.axis.other.value} of a guide"))


def _with_guide(document: Document, place: int, *other: Guide) -> Document:
    return replace(document, guides=(*document.guides[:place], *other, *document.guides[place + 1 :]))


def _refuse_locked(document: Document, place: int) -> None:
    guide = _guide(document, place)
    if guide.locked:
        raise EditError(locked_words(guide, readings_of(document)))


def _guide(document: Document, place: int) -> Guide:
    if not 0 <= place < len(document.guides):
        raise EditError("There is no such guide.")
    return document.guides[place]
