"""Clips whose outlines are edited: what they cut follows, with every change and every frame of a drag."""

from __future__ import annotations

from collections.abc import Collection

from ..document.model import Document
from ..view_model.shapes.clip_outlines import followed_outlines, has_shape


class EditedClips:
    """The outlines of clips that were made to be edited, by the names of their shapes and curves.

    They are kept when the outline has gone: undo brings it back.
    """

    def __init__(self) -> None:
        self.outlines: frozenset[frozenset[str]] = frozenset()
        self._before: Document | None = None
        self._there: list[frozenset[str]] = []

    def begin(self, outlines: Collection[frozenset[str]]) -> None:
        """Have what these cut follow them."""
        self.outlines, self._before = self.outlines.union(outlines), None

    def forget(self) -> None:
        """Take all outlines for shapes like others: the document is another one."""
        self.outlines, self._before, self._there = frozenset(), None, []

    def followed(self, document: Document, before: Document) -> Document:
        """Return the document whose clips are as their outlines run now."""
        if not self.outlines:
            return document
        if self._before is not before:
            # Once for a drag, not for each of its frames: most of the time none is there any more.
            self._before, self._there = before, [names for names in self.outlines if has_shape(before, names)]
        return followed_outlines(document, before, self._there) if self._there else document
