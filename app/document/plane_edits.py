"""Edits of the plane that a document is drawn in: its unit, its grid and its page."""

from __future__ import annotations

from msgspec.structs import replace

from .decimals import decimal_sum
from .limits import EditError, checked
from .model import Document, Page
from .paper import begun_for_paper
from .readings import readings_of


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
    """Give the page another size; the corner that coordinates are told from stays, so that they do.

    Without a page one is put at the origin; where nothing is drawn yet the lower left corner stays.
    """
    for value, what in ((width, "The width"), (height, "The height")):
        if not checked(value, f"{what} of the page") > 0:
            raise EditError(f"{what} of the page must be greater than 0.")
    page = document.page or Page(0.0, 0.0, width, height)
    is_drawn_on = bool(document.guides) or any(curve.points for curve in document.curves)
    keeps_top = is_drawn_on and readings_of(document).is_down
    return set_page(
        document, Page(page.x, decimal_sum(page.top, -height) if keeps_top else page.y, width, height)
    )


def set_y_up(document: Document, *, up: bool) -> Document:
    """Tell y upwards also where there is a page, or downwards; nothing moves."""
    return replace(document, y_up=up)
