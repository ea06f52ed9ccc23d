"""What a click of the pen makes: a corner after a straight line, or a smooth point."""

from __future__ import annotations

from ..document.model import Document
from ..document.paper import is_for_paper
from ..document.words import NamedEnum


class PenClick(NamedEnum):
    """What a click of the pen makes, where points have velocities; Alt makes the other.

    Designers know clicks that make corners, with handles only where they drag. A course is about tangents
    that rules estimate from the points.
    """

    BY_DOCUMENT = "by_document", "As the document is"
    CORNERS = "corners", "Clicks make corners"
    SMOOTH = "smooth", "Clicks make smooth points"

    def makes_corners(self, document: Document) -> bool:
        """Whether it is a corner; where nobody has chosen, in documents for paper."""
        return is_for_paper(document) if self is PenClick.BY_DOCUMENT else self is PenClick.CORNERS
