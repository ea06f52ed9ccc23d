"""Documents that are drawn for paper: they have a page, or a unit that paper is measured in."""

from __future__ import annotations

from typing import Final

from ..families import HERMITE
from .model import Document

PAPER_UNITS: Final = frozenset({"mm", "cm", "in", "pt", "pc", "px"})
"""Units of pages. A length of one metre, or of one second, is a course's."""


def is_for_paper(document: Document) -> bool:
    """Whether a document is drawn to be printed, cut or handed on, so that its numbers are lengths there."""
    return document.page is not None or document.unit in PAPER_UNITS


def begun_for_paper(before: Document, after: Document) -> Document:
    """Return a document that has become one for paper; as long as nothing is drawn, its curve has handles.

    A polynomial through all points, which new documents may begin with, leaves any page.
    """
    (first, *others), becomes = after.curves, is_for_paper(after) and not is_for_paper(before)
    if not becomes or others or first.points or first.family.derivatives:
        return after
    return after.with_curve(0, first.with_family(HERMITE))
