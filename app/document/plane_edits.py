"""Edits of the plane that a document is drawn in: its unit, its grid and its page."""

from __future__ import annotations

from msgspec.structs import replace

from .limits import EditError, checked
from .model import Document, Page
from .paper import begun_for_paper


def set_unit(document: Document, unit: str) -> Document:
    """Call a length of one by another name; every number stays, and means that from now on."""
    return begun_for_paper(document, replace(document, unit=unit))


def set_grid_spacing(document: Document, spacing: float) -> Document:
    """Draw the lines of the grid at another distance; 0 adapts it to the zoom."""
    return replace(document, grid_spacing=checked(spacing, "The spacing"))


def set_page(document: Document, page: Page | None) -> Document:
    """Let pictures show a part of the plane; None for what the curves take."""
    return begun_for_paper(document, replace(document, page=page))


def with_page_size(document: Document, width: float, height: float) -> Document:
    """Give the page another size, its lower left corner kept; where there is none, put one at the origin."""
    x, y = (document.page.x, document.page.y) if document.page is not None else (0.0, 0.0)
    for value, what in ((width, "The width"), (height, "The height")):
        if not checked(value, f"{what} of the page") > 0:
            raise EditError(f"{what} of the page must be greater than 0.")
    return set_page(document, Page(x, y, width, height))
