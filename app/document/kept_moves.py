"""A text or a picture of another program moved or removed: each is told by its place in the document."""

from __future__ import annotations

from typing import NamedTuple, TypeVar

from msgspec.structs import replace

from .decimals import decimal_sum
from .edits import EditError
from .kept import KeptPicture, KeptText
from .model import Document, Vector

_Kept = TypeVar("_Kept", KeptText, KeptPicture)

_LONGEST = 40
"""Letters of a text that are told."""

_GONE = "The text or picture is not there any more."


class KeptPlace(NamedTuple):
    """The place of a picture, or of the first line of a text, among all of its kind."""

    is_text: bool
    at: int


def parts_of(document: Document, place: KeptPlace) -> tuple[KeptText, ...] | tuple[KeptPicture, ...]:
    """Return the lines of a text, or a picture; nothing where there is none."""
    if not place.is_text:
        return document.kept_pictures[place.at : place.at + 1]
    return document.kept_texts[place.at : _end(document.kept_texts, place.at)]


def whole_texts(texts: tuple[KeptText, ...]) -> tuple[tuple[KeptText, ...], ...]:
    """Return lines as texts, each with all of its lines."""
    starts = [at for at in range(len(texts)) if not at or not texts[at].follows]
    return tuple(texts[at : _end(texts, at)] for at in starts)


def place_of(document: Document, kept: KeptText | KeptPicture) -> KeptPlace | None:
    """Return the place of a picture, or of the text that a line is of; None where there is none."""
    is_text = isinstance(kept, KeptText)
    of_kind = document.kept_texts if is_text else document.kept_pictures
    index = next((at for at, each in enumerate(of_kind) if each is kept), -1)
    while is_text and index > 0 and document.kept_texts[index].follows:
        index -= 1
    return KeptPlace(is_text, index) if index >= 0 else None


def _end(texts: tuple[KeptText, ...], start: int) -> int:
    rest = range(start + 1, len(texts))
    return next((at for at in rest if not texts[at].follows), len(texts))


def is_locked(document: Document, place: KeptPlace) -> bool:
    """Whether it stays where it is: locked itself, or with all that is in one of its groups."""
    parts = parts_of(document, place)
    groups = set(parts[0].groups) if parts else set[str]()
    free = {name for curve in document.curves if not curve.locked for name in curve.groups}
    there = {name for curve in document.curves for name in curve.groups}
    locked = (there - free) | {each.name for each in document.empty_layers if each.locked}
    return any(each.locked for each in parts) or not groups.isdisjoint(locked)


def words_of(document: Document, place: KeptPlace) -> str:
    """Return what it is called: “Text “Dear Sir””, or “Picture”."""
    if not place.is_text:
        return "Picture"
    lines = document.kept_texts[place.at : _end(document.kept_texts, place.at)]
    line = " ".join(" ".join(each.words for each in lines).split())
    return f"Text “{line if len(line) <= _LONGEST else f'{line[: _LONGEST - 1]}…'}”"


def move_kept(document: Document, place: KeptPlace, by: Vector) -> Document:
    """Move a text with all of its lines, or a picture, with the areas that they are seen in."""

    def moved(kept: _Kept) -> _Kept:
        x, y = to((kept.x, kept.y))
        return replace(kept, x=x, y=y, clips=tuple(clip.mapped(to) for clip in kept.clips))

    def to(at: Vector) -> Vector:
        return (decimal_sum(at[0], by[0]), decimal_sum(at[1], by[1]))

    start, end = _span(document, place)
    if not place.is_text:
        pictures = document.kept_pictures
        own = map(moved, pictures[start:end])
        return replace(document, kept_pictures=(*pictures[:start], *own, *pictures[end:]))
    texts = document.kept_texts
    return replace(document, kept_texts=(*texts[:start], *map(moved, texts[start:end]), *texts[end:]))


def remove_kept(document: Document, place: KeptPlace) -> Document:
    """Remove a text with all of its lines, or a picture."""
    start, end = _span(document, place)
    if not place.is_text:
        pictures = document.kept_pictures
        return replace(document, kept_pictures=(*pictures[:start], *pictures[end:]))
    texts = document.kept_texts
    return replace(document, kept_texts=(*texts[:start], *texts[end:]))


def _span(document: Document, place: KeptPlace) -> tuple[int, int]:
    """Return where its parts begin and end among all of its kind."""
    count = len(parts_of(document, place))
    if not count:
        raise EditError(_GONE)
    return place.at, place.at + count
