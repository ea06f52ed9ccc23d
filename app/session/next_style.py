"""The style of what is drawn next."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from enum import Enum, auto

from ..document.model import Curve
from ..document.style import Style


class Marked(Enum):
    """How the curves that are seen to be selected came to be so."""

    ASKED = auto()
    """The person chose or drew them."""
    OPENED = auto()
    """They came so with their document."""
    LENT = auto()
    """A tool took up the active curve while none was edited and none chosen."""


class NextStyle:
    """Style of what is drawn next where nothing is chosen: that of what was chosen last, in any document.

    Attributes
    ----------
    last
        That style; None before anything was chosen.
    marked
        How what is selected came to be so.
    """

    def __init__(self) -> None:
        self.last: Style | None = None
        self.marked = Marked.OPENED

    def is_of_active(self, marked: Collection[int]) -> bool:
        """Whether what is drawn next looks like the active curve: the person edits or has chosen it."""
        return bool(marked) and self.marked is not Marked.LENT

    def note(self, curves: Sequence[Curve], marked: Collection[int], active: int) -> None:
        """Take note of the style of what was chosen until now; of several, of the active or front one."""
        if marked and self.marked is Marked.ASKED:
            self.last = curves[active if active in marked else max(marked)].style
