"""Edits of masks: set by what lies in front, and taken away."""

from __future__ import annotations

from collections.abc import Collection

from msgspec.structs import replace

from .curve_edits import with_each
from .curve_tree import Container
from .edits import EditError
from .mask import MOST_MASKS, Mask
from .model import Curve, Document
from .several_curves import add_curves, remove_curves
from .shape_edits import free_group_name
from .shapes import shape_of, whole_shapes


def with_mask_set(
    document: Document, curves: Collection[int], front: Collection[int], mask: Mask
) -> Document:
    """Return the document with some curves masked, and without those that the mask was made of."""

    def masked(curve: Curve) -> Curve:
        masks = tuple(dict.fromkeys((*curve.style.masks, mask)))
        if len(masks) > MOST_MASKS:
            raise EditError(f"At most {MOST_MASKS} masks cover a shape.")
        return replace(curve, style=replace(curve.style, masks=masks))

    return remove_curves(with_each(document, whole_shapes(document, curves), masked), front)


def masked_among(document: Document, curves: Collection[int]) -> frozenset[int]:
    """Return which of some curves are masked."""
    return frozenset(place for place in curves if document.curves[place].style.masks)


def with_masks_released(
    document: Document, curves: Collection[int], objects: Collection[tuple[Curve, ...]]
) -> tuple[Document, frozenset[int]]:
    """Return the document with curves that are seen whole, and where the objects of their masks are.

    These are in front of the foremost of the curves, several of one mask in a group.
    """
    document = with_each(document, curves, lambda curve: replace(curve, style=replace(curve.style, masks=())))
    foremost = max(curves)
    first = at = shape_of(document, foremost).stop
    around = Container(groups=document.curves[foremost].groups)
    for found in objects:
        own = (free_group_name(document, "Mask"),) if len(found) > 1 else ()
        named = [replace(found[0], name="Mask")] if not own and not found[0].shape else found
        inside = [replace(each, groups=(*around.groups, *own, *each.groups)) for each in named]
        document = add_curves(document, inside, at, around)
        at += len(inside)
    return document, frozenset(range(first, at))
