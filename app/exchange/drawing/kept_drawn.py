"""Texts and pictures of other programs in a drawing."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

from msgspec.structs import replace

from ...document.kept import KeptPicture, KeptText
from ...document.model import Vector
from ...document.words import count_of

_Kept = TypeVar("_Kept", KeptText, KeptPicture)


def placed(
    kept: Iterable[_Kept], place: Callable[[Vector], Vector], way: Callable[[Vector], Vector]
) -> tuple[_Kept, ...]:
    """Return texts or pictures where a map puts them, which says so of places and of ways."""
    found = []
    for each in kept:
        x, y = place((each.x, each.y))
        clips = tuple(clip.mapped(place) for clip in each.clips)
        found.append(replace(each, x=x, y=y, across=way(each.across), down=way(each.down), clips=clips))
    return tuple(found)


def words_about_missing(pictures: Iterable[KeptPicture]) -> tuple[str, ...]:
    """Return the sentence that tells of pictures whose files are not in the document; none without such."""
    count = sum(not each.data for each in pictures)
    if not count:
        return ()
    verb, whose = ("is", "its file lies") if count == 1 else ("are", "their files lie")
    return (f"{count_of(count, 'picture')} {verb} not drawn; {whose} elsewhere.",)
