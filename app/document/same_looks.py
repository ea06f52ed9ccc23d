"""Which curves look the same, in what a person may ask about."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Final

import msgspec

from .gradient import Gradient
from .model import Document
from .style import Style


class SameLook(msgspec.Struct, frozen=True):
    """A part of how curves look that they may have in common.

    Attributes
    ----------
    name, title
        What it is called by the program, and by people.
    words
        What it is called in a sentence: "this fill".
    part
        Returns it, of a style; equal where it looks the same.
    tip
        What it takes in.
    """

    name: str
    title: str
    words: str
    part: Callable[[Style], object]
    tip: str


def _colours(gradient: Gradient | None) -> object:
    """Return what a gradient looks like wherever it lies."""
    return None if gradient is None else (gradient.kind, gradient.stops, gradient.spread, gradient.tile)


def _fill(style: Style) -> object:
    return style.fill, _colours(style.fill_gradient)


def _stroke(style: Style) -> object:
    return style.stroke, _colours(style.stroke_gradient)


def _line(style: Style) -> object:
    # Of no line nothing is seen.
    return style.has_stroke and (style.width, style.dash, style.dash_offset, style.cap, style.join)


_WHATEVER = ", whatever the opacity"

SAME_LOOKS: Final = (
    SameLook(
        "fillAndStroke",
        "Fill and Stroke",
        "this fill and stroke",
        lambda style: (_fill(style), _stroke(style), _line(style)),
        f"fill, colour of the line and its width and dashes{_WHATEVER}",
    ),
    SameLook("fill", "Fill", "this fill", _fill, f"colour or gradient inside{_WHATEVER}"),
    SameLook("stroke", "Stroke", "this stroke", _stroke, f"colour or gradient of the line{_WHATEVER}"),
    SameLook(
        "line", "Stroke Width and Style", "this line", _line, "width, dashes, ends and corners of the line"
    ),
)
"""What curves can be chosen by, as menus list it."""


def curves_alike(document: Document, curves: Collection[int], look: SameLook) -> frozenset[int]:
    """Return all curves that look as any of some do, those among them."""
    meant = {look.part(document.curves[place].style) for place in curves}
    return frozenset(
        place
        for place, curve in enumerate(document.curves)
        if curve.points and look.part(curve.style) in meant
    )
