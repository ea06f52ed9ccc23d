"""Pages of drawings that stand on the origin, and pages that hang at it, as those of SVG do."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.decimals import decimal_sum
from ..document.edits import EditError
from ..document.model import Document, Guide, Page, Vector
from ..document.several_curves import stepped, whole_curves


def shifted(document: Document, by: Vector) -> Document:
    """Return a document with its curves, page, guides and picture elsewhere, by decimals.

    Where no document may hold it, it stays where it is.
    """
    # A lock is against what a person does.
    free = replace(document, curves=tuple(replace(curve, locked=False) for curve in document.curves))
    try:
        moved = stepped(free, whole_curves(free, range(len(free.curves))), by)
    except EditError:
        return document
    curves = tuple(
        replace(new, locked=old.locked) for new, old in zip(moved.curves, document.curves, strict=True)
    )
    page, image = (
        each and replace(each, x=decimal_sum(each.x, by[0]), y=decimal_sum(each.y, by[1]))
        for each in (document.page, document.image)
    )
    guides = tuple(_moved(guide, by) for guide in document.guides)
    return replace(document, curves=curves, page=page, guides=guides, image=image)


def _moved(guide: Guide, by: Vector) -> Guide:
    return replace(guide, position=decimal_sum(guide.position, by[guide.axis.coordinate]))


def from_lower_left(document: Document) -> Document:
    """Return a document whose page hangs at the origin so that it stands on it: its numbers are positive."""
    page = document.page
    is_usual = page is not None and page.x == 0.0 and page.y == -page.height
    return shifted(document, (0.0, page.height)) if page is not None and is_usual else document


def from_upper_left(document: Document) -> Document:
    """Return a document whose page hangs at the origin, as that of an SVG file does."""
    page = document.page
    if page is None or page.x == page.top == 0.0:
        return document
    return shifted(document, (-page.x, -page.top))


def into_page(document: Document, page: Page) -> Document:
    """Return a document with the upper left corner of its page where another page has it."""
    own = document.page
    if own is None:
        return document
    by = (page.x - own.x, decimal_sum(decimal_sum(page.y, page.height), -decimal_sum(own.y, own.height)))
    return shifted(document, by) if any(by) else document
