"""The outlines of SVG elements that draw something: paths, and basic shapes as paths."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from ..errors import ExchangeError
from .basic_shapes import LENGTHS, polyline, shape_of_lengths
from .lengths import Viewport, length
from .path_data import Subpath, read_path_data
from .xml_tree import tag_of

SHAPES = ("path", "polyline", "polygon", *LENGTHS)
"""The elements that draw."""


class UnknownLengthError(ExchangeError):
    """A length that hangs on a font, or on a size that nobody says."""


def subpaths_of(element: ET.Element, viewport: Viewport, tolerance: float | None) -> list[Subpath]:
    """Return the outline of one of `SHAPES`, in its own units.

    Raises
    ------
    UnknownLengthError
        For lengths that nobody can know.
    ExchangeError
        For what is broken.
    """
    tag = tag_of(element)
    if tag == "path":
        return read_path_data(element.get("d", ""), tolerance)
    if tag not in LENGTHS:
        return polyline(element.get("points", ""), closed=tag == "polygon")
    lengths = [length_of(element, name, viewport) for name in LENGTHS[tag]]
    for name, value in zip(LENGTHS[tag], lengths, strict=True):
        if value is None and element.get(name, "auto").strip() not in ("", "auto"):
            raise UnknownLengthError
    return shape_of_lengths(tag, lengths, tolerance)


def length_of(element: ET.Element, name: str, viewport: Viewport) -> float | None:
    """Return a length that an attribute says, in user units; None without, and where nobody can know."""
    text = element.get(name)
    if text is None or not text.strip():
        return None
    try:
        return length(text, viewport.side(name))
    except ExchangeError as problem:
        raise ExchangeError(f"its {name} {problem}") from None
