"""The letters of a text among the curves of a document."""

from __future__ import annotations

from collections.abc import Collection

from msgspec.structs import replace

from .content import Lettering
from .curve_edits import with_each
from .model import Curve, Document
from .text import Text


def text_around(document: Document, curve: int) -> range:
    """Return the places of the letters of the text that a curve is of; none where it is of no text.

    What was put between them or taken from them by hand is not among them. The frame of a text stands for all
    of its letters.
    """
    if isinstance(document.curves[curve].form, Lettering):
        return range(curve, curve + 1)
    curves, (groups, text) = document.curves, _known(document.curves[curve])
    if text is None:
        return range(0)
    start, end = curve, curve + 1
    while start > 0 and not _begins(curves[start]) and _known(curves[start - 1]) == (groups, text):
        start -= 1
    while end < len(curves) and not _begins(curves[end]) and _known(curves[end]) == (groups, text):
        end += 1
    return range(start, end)


def _known(curve: Curve) -> tuple[tuple[str, ...], Text | None]:
    """Return what the letters of a text have in common."""
    return curve.groups, None if curve.text is None else replace(curve.text, begins=False)


def _begins(curve: Curve) -> bool:
    return curve.text is not None and curve.text.begins


def with_text_known(document: Document, places: range, text: Text) -> Document:
    """Return the document whose curves at some places tell that they are the letters of a text."""
    first = replace(text, begins=True)
    return with_each(document, places, lambda curve: replace(curve, text=text)).with_curve(
        places.start, replace(document.curves[places.start], text=first)
    )


def words_of(document: Document, curve: int) -> str:
    """Return the first line of the text that a curve is a letter of; empty for no text."""
    text, form = document.curves[curve].text, document.curves[curve].form
    if isinstance(form, Lettering):
        return form.words
    return " ".join(text.words.split()) if text is not None else ""


def text_chosen(document: Document, chosen: Collection[int]) -> int:
    """Return the place of the text, or of its first letter, that is chosen and nothing else; or −1."""
    first = min(chosen, default=-1)
    return first if first >= 0 and frozenset(text_around(document, first)) == frozenset(chosen) else -1
