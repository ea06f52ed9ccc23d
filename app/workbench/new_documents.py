"""New documents, as the person usually has them."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.model import Document, Page, empty_document
from ..document.paper import begun_for_paper, drawn_style
from ..families import HERMITE
from ..settings.preferences import Preferences

NEW_NAME = empty_document().curves[0].name
"""The name that a curve has before anyone gives it one."""

_A4 = Page(0.0, 0.0, 210.0, 297.0)
"""The page of a drawing, in millimetres, where no other is usual."""


def as_usual(document: Document, preferences: Preferences) -> Document:
    """Return a document with the unit, the grid, the page and the way of y of new ones."""
    unit, spacing, page = preferences.unit_name, preferences.grid_spacing, preferences.new_page
    return replace(document, unit=unit, grid_spacing=spacing, page=page, y_up=not preferences.y_down)


def blank_document(preferences: Preferences) -> Document:
    """Return what a new document is."""
    curve = preferences.new_curve
    document = as_usual(Document((curve,)), preferences)
    return document.with_curve(0, replace(curve, style=drawn_style(document, preferences.new_style)))


def blank_drawing(preferences: Preferences) -> Document:
    """Return a page to draw on."""
    usual = blank_document(preferences)
    usual = replace(usual, curves=(usual.curves[0].with_family(HERMITE),))
    return usual if usual.page is not None else begun_for_paper(usual, replace(usual, unit="mm", page=_A4))


def blank_sketch(preferences: Preferences) -> Document:
    """Return a plane without a page."""
    usual = blank_document(preferences)
    if usual.page is None:
        return usual
    # Units and lines of paper were chosen along with the page.
    curve = usual.curves[0]
    plain_line = replace(curve, style=replace(curve.style, width=None))
    return replace(usual, page=None, unit="", curves=(plain_line,))
