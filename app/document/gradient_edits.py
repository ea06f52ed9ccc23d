"""Edits of what paints fills and strokes: nothing, a colour, or a gradient with its stops.

`paint` is the field of the style, "fill" or "stroke"; `curves` are places in the document, and what is done
to one curve of a shape is done to all of it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

from msgspec.structs import replace

from .gradient import Box, size_of
from .model import Document, Vector
from .shapes import shape_of
from .style import Style


def with_shape_styles(
    document: Document, curves: Collection[int], edit: Callable[[range, Style], Style]
) -> Document:
    """Return the document with other styles: what `edit` makes of the places of a shape and its style."""
    styles: dict[int, Style] = {}
    for place in curves:
        if place not in styles:
            shape = shape_of(document, place)
            styles |= dict.fromkeys(shape, edit(shape, document.curves[shape.start].style))
    return replace(
        document,
        curves=tuple(
            replace(curve, style=styles[place]) if place in styles else curve
            for place, curve in enumerate(document.curves)
        ),
    )


def in_unit_box(style: Style, box: Box) -> Style:
    """Return a style for a shape whose box goes from (0, 0) to (1, 1), from that of a shape in a box."""
    (left, bottom), (width, height) = box[0], size_of(box)
    return style.mapped(lambda place: ((place[0] - left) / width, (place[1] - bottom) / height))


def out_of_unit_box(style: Style, box: Box) -> Style:
    """Return the style for a shape in a box, from one for a shape whose box goes from (0, 0) to (1, 1)."""
    (left, bottom), (width, height) = box[0], size_of(box)

    def place(at: Vector) -> Vector:
        return left + at[0] * width, bottom + at[1] * height

    return style.mapped(place)
