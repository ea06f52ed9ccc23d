"""Edits that bring in curves from elsewhere."""

from __future__ import annotations

from msgspec.structs import replace

from app.document.model import Document


def add_imported(document: Document, new: Document) -> tuple[Document, int]:
    """Return the document with the curves of another, and the place of the first of them.

    A lone curve without points is what a new document begins with; it gives way. The other's picture to
    trace comes along where there is none yet.
    """
    begun = document.curves if len(document.curves) > 1 or document.curves[0].points else ()
    curves = (*begun, *new.curves)
    return replace(document, curves=curves, image=document.image or new.image), len(begun)
