"""New documents, as the person usually has them."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.model import Document, empty_document
from ..settings.preferences import Preferences

NEW_NAME = empty_document().curves[0].name
"""The name that a curve has before anyone gives it one."""


def as_usual(document: Document, preferences: Preferences) -> Document:
    """Return a document with the unit and the grid of new ones."""
    return replace(document, unit=preferences.unit_name, grid_spacing=preferences.grid_spacing)


def blank_document(preferences: Preferences) -> Document:
    """Return what a new document is."""
    curve = preferences.new_curve
    document = as_usual(Document((curve,)), preferences)
    return document.with_curve(0, replace(curve, style=preferences.new_style))
