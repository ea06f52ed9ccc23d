"""Clips whose outlines are edited: what they cut follows, with every change and every frame of a drag."""

from __future__ import annotations

from collections.abc import Collection

from ..document.model import Document
from ..view_model.shapes.clip_outlines import followed_outlines


class EditedClips:
    """The outlines of clips that were made to be edited, by the names of their shapes and curves.

    They are kept when the outline has gone: undo brings it back.
    """

    def __init__(self) -> None:
        self.outlines: frozenset[frozenset[str]] = frozenset()

    def begin(self, outlines: Collection[frozenset[str]]) -> None:
        """Have what these cut follow them."""
        self.outlines = self.outlines.union(outlines)

    def forget(self) -> None:
        """Take all outlines for shapes like others: the document is another one."""
        self.outlines = frozenset()

    def followed(self, document: Document, before: Document) -> Document:
        """Return the document whose clips are as their outlines run now."""
        return followed_outlines(document, before, self.outlines) if self.outlines else document
