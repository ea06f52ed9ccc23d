"""Curves of a file in the document that they come to, with the views of them."""

from __future__ import annotations

from collections.abc import Callable

from ... import exchange
from ...document.groups import tidy_shapes
from ...document.model import Document
from ...document.plain_numbers import with_plain_numbers
from ...document.several_curves import add_imported, ignored_on_import, is_blank
from ...document.words import names_of
from ...view_model.curve.transformed import views_ahead
from ...view_model.paste import AddedCurves

MANY_POINTS = 1000
"""Points of curves whose views are made beside the window."""


def points_of(document: Document) -> int:
    """Return the number of points of all curves."""
    return sum(len(curve.points) for curve in document.curves)


def intake(
    document: Document,
    new: Document,
    report: Callable[[float], object] | None = None,
) -> AddedCurves:
    """Return a document with the curves of another in front, and their views if there is a `report`.

    Lengths are converted to the unit of the document; an empty document gets the unit and the guides.
    """
    new = _sized_for(document, new)
    filled, first = add_imported(document, new)
    # As the session will store it, so that the views are of the same curves.
    filled = tidy_shapes(with_plain_numbers(filled, document), document)
    indices = range(first, first + len(new.curves))
    views = views_ahead(filled.curves[indices.start : indices.stop], report) if report is not None else ()
    return AddedCurves(filled, indices, tuple(views))


def rest_message(document: Document, new: Document) -> str:
    """Return sentences on the content that is not added to a document with the curves of another."""
    sentences = []
    sized = _sized_for(document, new)
    if sized.unit != new.unit:
        sentences.append(f"Lengths are converted from {new.unit} to {sized.unit}.")
    if rest := ignored_on_import(document, sized):
        verb = "is" if len(rest) == 1 and not rest[0].endswith("guides") else "are"
        words = names_of(rest)
        sentences.append(f"{words[0].upper()}{words[1:]} {verb} left out.")
    return " ".join(sentences)


def _sized_for(document: Document, new: Document) -> Document:
    """Return the document to add in the unit of another; unchanged where the other has no curves."""
    if is_blank(document):
        return new
    return exchange.units.in_unit(new, document.unit)
