"""Edits of the plane that a document is drawn in: its unit and its grid."""

from __future__ import annotations

from msgspec.structs import replace

from .limits import checked
from .model import Document


def set_unit(document: Document, unit: str) -> Document:
    """Call a length of one by another name; every number stays, and means that from now on."""
    return replace(document, unit=unit)


def set_grid_spacing(document: Document, spacing: float) -> Document:
    """Draw the lines of the grid at another distance; 0 adapts it to the zoom."""
    return replace(document, grid_spacing=checked(spacing, "The spacing"))
