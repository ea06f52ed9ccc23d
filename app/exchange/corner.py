"""Documents moved as a whole, lock or not, such as to a corner of a picture."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.decimals import decimal_sum
from ..document.edits import EditError
from ..document.model import Document, Guide, Vector
from ..document.several_curves import stepped, whole_curves


def shifted(document: Document, by: Vector) -> Document:
    """Return a document with its curves, guides and picture elsewhere, by decimals.

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
    image = document.image and replace(
        document.image, x=decimal_sum(document.image.x, by[0]), y=decimal_sum(document.image.y, by[1])
    )
    guides = tuple(_moved(guide, by) for guide in document.guides)
    return replace(document, curves=curves, guides=guides, image=image)


def _moved(guide: Guide, by: Vector) -> Guide:
    return replace(guide, position=decimal_sum(guide.position, by[guide.axis.coordinate]))
