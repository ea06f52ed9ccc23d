"""The style of what is drawn next."""

from __future__ import annotations

from collections.abc import Callable, Collection
from enum import Enum, auto
from typing import NamedTuple

from msgspec.structs import replace

from ..document.model import Document
from ..document.style import Style


class Marked(Enum):
    """How the curves that are seen to be selected came to be so."""

    ASKED = auto()
    """The person chose or drew them."""
    OPENED = auto()
    """They came so with their document."""
    LENT = auto()
    """A tool took up the active curve while none was edited and none chosen."""
    BROUGHT = auto()
    """They came from the clipboard or a file, or a transform has changed their looks: nobody chose these."""


class _Kept(NamedTuple):
    """A style, and the unit of its width: in another one that would be any width."""

    style: Style
    unit: str

    def in_document(self, document: Document) -> Style:
        """Return it as it is there."""
        return self.style if self.unit == document.unit else replace(self.style, width=None)


class NextStyle:
    """Style of what is drawn next: that which the person chose or set last, in any document.

    Attributes
    ----------
    marked
        How what is selected came to be so.
    """

    def __init__(self) -> None:
        self._kept: _Kept | None = None
        self.marked = Marked.OPENED

    def is_of_active(self, marked: Collection[int]) -> bool:
        """Whether a style that is set now is that of what is selected, not only of what is drawn next."""
        return bool(marked) and self.marked is not Marked.LENT

    def _is_as_active(self, marked: Collection[int]) -> bool:
        """Whether what is drawn next looks like the active curve: the person edits or has chosen it."""
        return self.is_of_active(marked) and self.marked is not Marked.BROUGHT

    def in_document(
        self, document: Document, marked: Collection[int], active: int, blank: Callable[[], Document]
    ) -> Style:
        """Return the style of what is drawn next; `blank` tells that of new documents."""
        curve = document.curves[active]
        if not curve.points:
            return curve.style
        if self._is_as_active(marked):
            return curve.style
        if self._kept is not None:
            return self._kept.in_document(document)
        return blank().curves[0].style

    def note(self, document: Document, marked: Collection[int], active: int) -> None:
        """Take note of the style of what was chosen until now; of several, of the active or front one.

        Nobody means to draw what has no paint.
        """
        if self.marked is Marked.ASKED and marked:
            style = document.curves[active if active in marked else max(marked)].style
            if style.has_fill or style.has_stroke:
                self.take(document, style)

    def follow(self, before: Document, after: Document, active: int) -> None:
        """Take note of what a step has made of the active curve: begun or worked on, it is chosen.

        A look that changes with the shape, as widths do under scaling, is one that nobody set: what is drawn
        next has the one before.
        """
        curve = after.curves[active]
        if self.marked is Marked.BROUGHT or any(each is curve for each in before.curves):
            return
        was_chosen, self.marked = self.marked is Marked.ASKED, Marked.ASKED
        if was_chosen and len(before.curves) == len(after.curves):
            old = before.curves[active]
            if old.points not in ((), curve.points) and old.style != curve.style:
                self.take(before, old.style)
                self.marked = Marked.BROUGHT

    def take(self, document: Document, style: Style) -> None:
        """Draw with a style of a document from now on."""
        self._kept = _Kept(style, document.unit)
