"""Edits of the plane that a document is drawn in: its unit, its grid and its page."""

from __future__ import annotations

from msgspec.structs import replace

from .limits import checked
from .model import Document, Page


def set_unit(document: Document, unit: str) -> Document:
    """Call a length of one by another name; every number stays, and means that from now on."""
    return replace(document, unit=unit)


def set_grid_spacing(document: Document, spacing: float) -> Document:
    """Draw the lines of the grid at another distance; 0 adapts it to the zoom."""
    return replace(document, grid_spacing=checked(spacing, "The spacing"))


def set_page(document: Document, page: Page | None) -> Document:
    """Let pictures show a part of the plane; None for what the curves take."""
    return replace(document, page=page)
