"""Edits of what paints fills and strokes: nothing, a colour, or a gradient with its stops.

`paint` is the field of the style, "fill" or "stroke"; `curves` are places in the document, and what is done
to one curve of a shape is done to all of it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import NamedTuple

from msgspec.structs import replace

from .contents import with_shown_style
from .gradient import Box, Gradient, GradientKind, Stop, Tile, filling, size_of
from .model import Document, Vector
from .patterns import PATTERNS, laid_across
from .shapes import shape_of
from .style import GRADIENTS, INK, NO_PAINT, Style
from .words import NamedEnum

BoxOf = Callable[[range], Box]
"""Tells the box around the curves of a shape, by their places."""


class PaintedStop(NamedTuple):
    """A stop, by the first curve of its shape, the paint, "fill" or "stroke", and its place there."""

    curve: int
    paint: str
    stop: int


class PaintKind(NamedEnum):
    """Kind of paint."""

    NONE = "none", "None"
    FLAT = "flat", "Flat"
    LINEAR = "linear", "Linear"
    RADIAL = "radial", "Radial"
    PATTERN = "pattern", "Pattern"

    @property
    def gradient(self) -> GradientKind | None:
        """The kind of gradient; None where it is none."""
        return next((kind for kind in GradientKind if kind.value == self.value), None)


def gradient_of(style: Style, paint: str) -> Gradient | None:
    """Return the gradient of a paint; None where it is a colour, or nothing."""
    return style.gradients.get(GRADIENTS[paint])


def paint_kind(style: Style, paint: str) -> PaintKind:
    """Return the kind of a paint."""
    if getattr(style, paint) == NO_PAINT:
        return PaintKind.NONE
    gradient = gradient_of(style, paint)
    return PaintKind.FLAT if gradient is None else PaintKind(gradient.kind.value)


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
            with_shown_style(curve, styles[place]) if place in styles else curve
            for place, curve in enumerate(document.curves)
        ),
    )


def with_paint_kind(
    document: Document, curves: Collection[int], paint: str, kind: PaintKind, box_of: BoxOf
) -> Document:
    """Give curves a kind of paint.

    A colour becomes a gradient that fades out, across the shape; a gradient becomes its first colour, or one
    of the other kind with the same stops.
    """
    return with_shape_styles(
        document, curves, lambda shape, style: _painted(style, paint, kind, lambda: box_of(shape))
    )


def _painted(style: Style, paint: str, kind: PaintKind, box: Callable[[], Box]) -> Style:
    before, gradient = paint_kind(style, paint), gradient_of(style, paint)
    if before is kind:
        return style
    if kind is PaintKind.NONE:
        return style.with_fields({paint: NO_PAINT})
    colour: str = INK if before is PaintKind.NONE else getattr(style, paint)
    if kind is PaintKind.PATTERN:
        return style.with_gradient(paint, laid_across(box(), PATTERNS[0].tile, colour))
    if kind.gradient is None:
        return style.with_fields({paint: gradient.stops[0].colour if gradient is not None else colour})
    if before in (PaintKind.NONE, PaintKind.FLAT) or gradient is None:
        return style.with_gradient(paint, filling(box(), kind.gradient, fading(colour)))
    return style.with_gradient(paint, filling(box(), kind.gradient, gradient.stops, gradient.spread))


def fading(colour: str) -> tuple[Stop, Stop]:
    """Return the stops of a colour that fades out."""
    return Stop(0.0, colour), Stop(1.0, colour, 0.0)


def with_gradient(
    document: Document, curves: Collection[int], paint: str, change: Callable[[Gradient], Gradient]
) -> Document:
    """Return the document with what `change` makes of the gradients of some curves."""

    def edit(_shape: range, style: Style) -> Style:
        gradient = gradient_of(style, paint)
        return style if gradient is None else style.with_gradient(paint, change(gradient))

    return with_shape_styles(document, curves, edit)


def with_stops(document: Document, curves: Collection[int], paint: str, stops: tuple[Stop, ...]) -> Document:
    """Give the gradients of curves other stops; where they lie stays."""
    return with_gradient(document, curves, paint, lambda gradient: replace(gradient, stops=stops))


def with_tile(document: Document, curves: Collection[int], paint: str, tile: Tile, box_of: BoxOf) -> Document:
    """Paint curves with a pattern; where they have one, another of the same size and in the same place."""

    def edit(shape: range, style: Style) -> Style:
        gradient = gradient_of(style, paint)
        if gradient is not None and gradient.tile is not None:
            return style.with_gradient(paint, replace(gradient, tile=tile))
        colour: str = getattr(style, paint)
        ink = INK if colour == NO_PAINT else colour
        return style.with_gradient(paint, laid_across(box_of(shape), tile, ink))

    return with_shape_styles(document, curves, edit)


def without_stop(document: Document, curves: Collection[int], paint: str, stop: int) -> Document:
    """Return the document without a stop of gradients; one of two leaves the colour of the other."""

    def edit(_shape: range, style: Style) -> Style:
        gradient = gradient_of(style, paint)
        if gradient is None or stop >= len(gradient.stops):
            return style
        rest = (*gradient.stops[:stop], *gradient.stops[stop + 1 :])
        if len(rest) > 1:
            return style.with_gradient(paint, replace(gradient, stops=rest))
        opacity = f"{paint}_opacity"
        return style.with_fields({paint: rest[0].colour, opacity: getattr(style, opacity) * rest[0].opacity})

    return with_shape_styles(document, curves, edit)


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
