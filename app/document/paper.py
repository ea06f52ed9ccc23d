"""Documents that are drawn for paper: they have a page, or a unit that paper is measured in."""

from __future__ import annotations

from typing import Final

from msgspec.structs import replace

from ..families import HERMITE
from .derivatives import DERIVATIVES
from .model import Document
from .style import INK, LineCap, LineJoin, Style
from .words import NamedEnum

PAPER_UNITS: Final = frozenset({"mm", "cm", "in", "pt", "pc", "px"})
"""Units of pages. A length of one metre, or of one second, is a course's."""


class DocumentKind(NamedEnum):
    """What a document is worked on as: the window is arranged for that."""

    SKETCH = "sketches", "A sketch"
    DRAWING = "drawings", "A drawing"

    @property
    def noun(self) -> str:
        """The word for one of them."""
        return self.name.lower()


def kind_of(document: Document) -> DocumentKind:
    """Return the kind of a document: a drawing has a page, a sketch or a lesson has none."""
    return DocumentKind.SKETCH if document.page is None else DocumentKind.DRAWING


def vector_word(document: Document, order: int, *, many: bool = False) -> str:
    """Return what people call the derivative that a handle of a point sets: in a drawing it is a handle."""
    if order == 1 and kind_of(document) is DocumentKind.DRAWING:
        return "handles" if many else "handle"
    derivative = DERIVATIVES[order - 1]
    return derivative.plural if many else derivative.name


def object_word(document: Document, *, many: bool = False) -> str:
    """Return what people call whatever is drawn: on a page it is an object, be it a curve or not."""
    return f"{'object' if kind_of(document) is DocumentKind.DRAWING else 'curve'}{'s' * many}"


_LINES: Final = {"mm": 0.3, "cm": 0.03, "in": 0.01, "pt": 0.75, "pc": 0.06, "px": 1.0}
"""Width of a new line by the unit of paper: about that of one of 96 to the inch."""


def is_for_paper(document: Document) -> bool:
    """Whether a document is drawn to be printed, cut or handed on, so that its numbers are lengths there."""
    return document.page is not None or document.unit in PAPER_UNITS


_NUDGES: Final = {"mm": 1.0, "cm": 0.1, "in": 0.05, "pt": 2.0, "pc": 0.2, "px": 2.0}
"""Step of an arrow key by the unit of paper."""


def nudge_of(document: Document) -> float | None:
    """Return how far an arrow key goes in a document for paper: as far at any zoom; None in any other."""
    return _NUDGES.get(document.unit)


def line_width(document: Document) -> float | None:
    """Return the width of new lines of a document, in its unit; None where it is not for paper."""
    if document.unit in PAPER_UNITS:
        return _LINES[document.unit]
    return None if document.page is None else float(f"{document.page.usual_width / 2:.0e}")


_BLACK: Final = "#000000"


def drawn_style(document: Document, style: Style) -> Style:
    """Return a style as new curves of a document have it: on paper a line is as wide as it prints."""
    if style.width is not None:
        return style
    style = replace(style, width=line_width(document))
    if kind_of(document) is not DocumentKind.DRAWING:
        return style
    # Nobody has chosen another: black on paper, with the ends and corners that SVG has.
    inked = {paint: _BLACK for paint in ("stroke", "fill") if getattr(style, paint) == INK}
    ends = {"cap": LineCap.BUTT, "join": LineJoin.MITER} if "stroke" in inked else {}
    return replace(style, **inked, **ends)


def begun_for_paper(before: Document, after: Document) -> Document:
    """Return a document of another unit or page; as long as nothing is drawn, its curve is of that kind.

    On paper it has handles: a polynomial through all points, which new documents may begin with, leaves any
    page. Its line, where nobody has chosen another, is that of new lines.
    """
    first, *others = after.curves
    if others or first.points:
        return after
    becomes = is_for_paper(after) and not is_for_paper(before)
    curve = first.with_family(HERMITE) if becomes and not first.family.derivatives else first
    if first.style.width in (None, line_width(before)):
        curve = replace(curve, style=drawn_style(after, replace(curve.style, width=None)))
    return after.with_curve(0, curve)
