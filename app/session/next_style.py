"""The style of what is drawn next."""

from __future__ import annotations

from collections.abc import Callable, Collection
from enum import Enum, auto
from typing import TYPE_CHECKING

from msgspec.structs import replace

from ..document.contents import is_content
from ..document.model import Document
from ..document.paper import drawn_style, line_width
from ..document.selection import with_points
from ..document.style import Style

if TYPE_CHECKING:
    from .selection import Selection


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


class NextStyle:
    """Style of what is drawn next: that which the person chose or set last, in any document.

    Attributes
    ----------
    last
        That style; None before anything was chosen.
    marked
        How what is selected came to be so.
    """

    def __init__(self) -> None:
        self.last: Style | None = None
        self._usual: float | None = None
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
        style = document.curves[active].style
        is_lent = self._is_as_active(marked) and not is_content(document.curves[active])
        if document.curves[active].points and not is_lent:
            style = self.last or blank().curves[0].style
            if self.last is not None and self._usual != line_width(document):
                # A width in another unit would be any width here.
                style = replace(style, width=None)
        return drawn_style(document, style)

    def note(self, document: Document, marked: Collection[int], active: int) -> None:
        """Take note of the style of what was chosen until now; of several, of the active or front one.

        Texts and pictures are painted otherwise than curves.
        """
        if self.marked is Marked.ASKED and (lending := with_points(document.curves, marked)):
            self.take(document, document.curves[active if active in lending else max(lending)].style)

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
        self.last, self._usual = style, line_width(document)


def choose_brought(selected: Selection, places: Collection[int]) -> None:
    """Choose curves that have come from the clipboard or a file: nobody chose their looks."""
    # Before, too: what is chosen until now is taken note of.
    selected.next_style.marked = Marked.BROUGHT
    selected.choose(places)
    selected.next_style.marked = Marked.BROUGHT
