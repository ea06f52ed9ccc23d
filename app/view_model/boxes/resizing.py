"""Points and curves given a width, a height or both, about a place that stays."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ...document.edits import EditError
from ...document.model import Document, Vector
from ...document.point_group import PointGroup
from ...document.several_curves import changeable, whole_curves
from ...document.shape_edits import objects
from ...document.transforms import scaling
from ...document.words import number
from ..curve.curve_view import CurveView
from .bounds import BARE, Strokes, bounds_of
from .stretch import stretched

Wanted = tuple[float | None, float | None]
"""A width and a height; None for one that nobody asks for."""

SIDES = ("width", "height")
"""What a length along x and along y is called."""


def resized(
    document: Document,
    views: Sequence[CurveView],
    group: PointGroup,
    size: Wanted,
    strokes: Strokes,
    about: Vector,
    *,
    keeps_proportions: bool = False,
) -> Document:
    """Return the document with a group of another size about a place.

    A side that has no length stays so, and with `keeps_proportions` a single one takes the other along.

    Raises
    ------
    EditError
        If the sides asked for have no length, or are no longer than strokes that shall not scale.
    """
    bounds, bare = bounds_of(views, group, strokes), bounds_of(views, group, BARE)
    if bounds is None or bare is None:
        return document
    axes = [axis for axis in (0, 1) if size[axis] is not None and bare.size[axis] > 0.0]
    if not axes:
        raise EditError(f"What has no {' or '.join(_asked(size))} cannot be given one.")
    factors = [1.0, 1.0]
    for axis in axes:
        length = size[axis] or 0.0
        _refuse_length(document, length, axis, bounds.size[axis] - bare.size[axis], strokes)
        factors[axis] = length / bounds.size[axis]
    even = axes[0] if keeps_proportions and len(axes) == 1 else None
    x, y = factors if even is None else (factors[even], factors[even])
    by = scaling(x, y, about)
    corners = by.point(bounds.low), by.point(bounds.high)
    return stretched(document, views, group, corners, strokes, even=even, about=about)


def _asked(size: Wanted) -> list[str]:
    return [word for word, length in zip(SIDES, size, strict=True) if length is not None]


def _refuse_length(document: Document, length: float, axis: int, thickness: float, strokes: Strokes) -> None:
    """Refuse a length along an axis along which strokes are so thick, where it is none that can be had."""
    if length <= 0.0:
        raise EditError(f"A {SIDES[axis]} is greater than 0; Flip mirrors.")
    if length <= thickness and not strokes.scaled:
        taken = f"{number(thickness, 6)} {document.unit}".rstrip()
        raise EditError(f"The strokes alone take {taken}; let them scale, or measure without.")


def resized_apart(
    document: Document,
    views: Sequence[CurveView],
    curves: Collection[int],
    size: Wanted,
    strokes: Strokes,
    *,
    keeps_proportions: bool = False,
) -> Document:
    """Return the document with each object of some curves of another size about its own middle.

    Raises
    ------
    EditError
        If that is possible of none of them, or not of one for its strokes.
    """
    new, refusal = document, ""
    for node in objects(document, changeable(document, curves)):
        group = whole_curves(document, node.places)
        if (bounds := bounds_of(views, group, strokes)) is None:
            continue
        try:
            new = resized(
                new, views, group, size, strokes, bounds.centre, keeps_proportions=keeps_proportions
            )
        except EditError as reason:
            refusal = str(reason)
    if new is document and refusal:
        raise EditError(refusal)
    return new


def size_of(views: Sequence[CurveView], strokes: Strokes) -> Vector | None:
    """Return width and height of all curves together; None where there are no points."""
    points = tuple((place, frozenset(range(len(view.points)))) for place, view in enumerate(views))
    bounds = bounds_of(views, PointGroup(points, is_whole=True), strokes)
    return None if bounds is None else bounds.size
