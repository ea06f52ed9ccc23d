"""Texts and pictures of other programs go with the groups that they are in."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from typing import TypeVar

from msgspec.structs import replace

from .kept import KeptPicture, KeptText
from .model import Document, Vector

_Kept = TypeVar("_Kept", KeptText, KeptPicture)
_EVEN = 1e-4


def seen_kept(document: Document) -> tuple[tuple[KeptText, ...], tuple[KeptPicture, ...]]:
    """Return what is seen of the texts and pictures: not what lies in a group in which all is hidden."""
    if not (document.kept_texts or document.kept_pictures):
        return (), ()
    seen = {name for curve in document.curves if curve.visible for name in curve.groups}
    there = {name for curve in document.curves for name in curve.groups}
    hidden = (there - seen) | {each.name for each in document.empty_layers if not each.visible}

    def of(kept: tuple[_Kept, ...]) -> tuple[_Kept, ...]:
        return tuple(each for each in kept if hidden.isdisjoint(each.groups)) if hidden else kept

    return of(document.kept_texts), of(document.kept_pictures)


def with_kept_if(document: Document, is_meant: Callable[[tuple[str, ...]], bool]) -> Document:
    """Return the document with those of its texts and pictures whose groups are meant."""
    if not (document.kept_texts or document.kept_pictures):
        return document
    return replace(
        document,
        kept_texts=tuple(each for each in document.kept_texts if is_meant(each.groups)),
        kept_pictures=tuple(each for each in document.kept_pictures if is_meant(each.groups)),
    )


def with_kept_mapped(
    document: Document, curves: Collection[int], place: Callable[[Vector], Vector]
) -> Document:
    """Let texts and pictures go with groups of which all curves are mapped; not with layers.

    As in the file, they are only moved, turned, mirrored and scaled evenly.
    """
    if not (document.kept_texts or document.kept_pictures):
        return document
    moved = {name for curve in curves for name in document.curves[curve].groups}
    left = {
        name for index, curve in enumerate(document.curves) if index not in curves for name in curve.groups
    }
    gone = moved - left - set(document.layers)
    kept: tuple[KeptText | KeptPicture, ...] = (*document.kept_texts, *document.kept_pictures)
    if all(gone.isdisjoint(each.groups) for each in kept):
        return document
    origin = place((0.0, 0.0))
    across, up = (_way(origin, place(end)) for end in ((1.0, 0.0), (0.0, 1.0)))
    if not _is_even(across, up):
        return document

    def mapped(kept: _Kept) -> _Kept:
        if gone.isdisjoint(kept.groups):
            return kept
        corner = (kept.x, kept.y)
        x, y = place(corner)
        ends = ((kept.x + way[0], kept.y + way[1]) for way in (kept.across, kept.down))
        right, down = (_way((x, y), place(end)) for end in ends)
        clips = tuple(clip.mapped(place) for clip in kept.clips)
        return replace(kept, x=x, y=y, across=right, down=down, clips=clips)

    return replace(
        document,
        kept_texts=tuple(map(mapped, document.kept_texts)),
        kept_pictures=tuple(map(mapped, document.kept_pictures)),
    )


def _way(start: Vector, end: Vector) -> Vector:
    return (end[0] - start[0], end[1] - start[1])


def _is_even(across: Vector, up: Vector) -> bool:
    """Whether a map with these unit vectors keeps squares square."""
    longer, shorter = math.hypot(*across), math.hypot(*up)
    dot = across[0] * up[0] + across[1] * up[1]
    return abs(longer - shorter) <= _EVEN * longer and abs(dot) <= _EVEN * longer * shorter
