"""The outlines of SVG elements that draw something: paths, and basic shapes as paths."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from math import tau

import numpy as np

from ..arcs import arc
from ..cubics_in import lines
from ..errors import ExchangeError
from .lengths import Viewport, length
from .path_data import ReadPath, Subpath, read_path_data, read_points
from .xml_tree import tag_of

LENGTHS = {
    "rect": ("x", "y", "width", "height", "rx", "ry"),
    "circle": ("cx", "cy", "r"),
    "ellipse": ("cx", "cy", "rx", "ry"),
    "line": ("x1", "y1", "x2", "y2"),
}
"""The lengths of each shape that has some; those that are not said are None."""

SHAPES = ("path", "polyline", "polygon", *LENGTHS)
"""The elements that draw."""

_SIZES = ("width", "height", "rx", "ry", "r")
"""The lengths that are not negative."""


class UnknownLengthError(ExchangeError):
    """A length that is a part of something that nobody says."""


def outline_of(element: ET.Element, viewport: Viewport, tolerance: float | None) -> ReadPath:
    """Return the outline of one of `SHAPES`, in its own units, up to the first error in its data.

    Raises
    ------
    UnknownLengthError
        For lengths that nobody can know.
    ExchangeError
        For an outline beyond all numbers.
    """
    tag = tag_of(element)
    if tag == "path":
        return read_path_data(element.get("d", ""), tolerance)
    if tag not in LENGTHS:
        return read_points(element.get("points", ""), closed=tag == "polygon")
    lengths = [length_of(element, name, viewport) for name in LENGTHS[tag]]
    return ReadPath(shape_of_lengths(tag, lengths, tolerance))


def length_of(element: ET.Element, name: str, viewport: Viewport) -> float | None:
    """Return a length that an attribute says, in user units; None without, and for one that is invalid.

    Raises
    ------
    UnknownLengthError
        For one that nobody can know.
    """
    text = element.get(name, "").strip()
    if text.lower() in ("", "auto") or not _is_length(name, text):
        return None
    if (value := viewport.length(text, name)) is None:
        raise UnknownLengthError
    return value


def invalid_lengths(element: ET.Element) -> list[str]:
    """Return the attributes of an element that should be lengths, or sizes, and are not: 'width “44mmx”'."""
    names = LENGTHS.get(tag_of(element), LENGTHS["rect"][:4])
    given = ((name, text) for name in names if (text := element.get(name, "").strip()))
    return [f"{name} “{text[:20]}”" for name, text in given if not _is_length(name, text)]


def _is_length(name: str, text: str) -> bool:
    """Whether an attribute of this name may say so."""
    try:
        value = length(text, 1.0, 1.0)
    except ExchangeError:
        return False
    return value is None or value >= 0 or name not in _SIZES


def shape_of_lengths(tag: str, lengths: list[float | None], tolerance: float | None) -> list[Subpath]:
    """Return a shape of `LENGTHS`, its lengths in their order."""
    values = [0.0 if value is None else value for value in lengths]
    if tag == "line":
        points = np.array(values).reshape(2, 2)
        return [Subpath(points[0], [lines(points)])]
    if tag == "rect":
        x, y, width, height = values[:4]
        return _rectangle((x, y), (width, height), (lengths[4], lengths[5]), tolerance)
    rx, ry = lengths[2], lengths[-1]
    # An ellipse with one radius is a circle.
    return _ellipse(values[0], values[1], _either(rx, ry), _either(ry, rx), tolerance)


def _either(first: float | None, second: float | None) -> float:
    return first if first is not None else second or 0.0


def _rectangle(
    corner: tuple[float, float],
    size: tuple[float, float],
    radii: tuple[float | None, float | None],
    tolerance: float | None,
) -> list[Subpath]:
    (x, y), (width, height), (rx, ry) = corner, size, radii
    if width == 0 or height == 0:
        return []
    across = min(_either(rx, ry), width / 2)
    up = min(_either(ry, rx), height / 2)
    right, bottom = x + width, y + height
    if across == 0 or up == 0:
        return _complete(read_path_data(f"M{x!r} {y!r}H{right!r}V{bottom!r}H{x!r}Z"))
    bend = f"A{across!r} {up!r} 0 0 1"
    # Where two bends meet there is no line between them, not even one of no length.
    top = f"H{right - across!r}" if 2 * across < width else ""
    bottom_line = f"H{x + across!r}" if 2 * across < width else ""
    side = f"V{bottom - up!r}" if 2 * up < height else ""
    other_side = f"V{y + up!r}" if 2 * up < height else ""
    data = (
        f"M{x + across!r} {y!r}{top}{bend} {right!r} {y + up!r}{side}"
        f"{bend} {right - across!r} {bottom!r}{bottom_line}{bend} {x!r} {bottom - up!r}{other_side}"
        f"{bend} {x + across!r} {y!r}Z"
    )
    return _complete(read_path_data(data, tolerance))


def _complete(read: ReadPath) -> list[Subpath]:
    if read.error:
        raise ExchangeError("It is beyond all numbers.")
    return read.subpaths


def _ellipse(x: float, y: float, rx: float, ry: float, tolerance: float | None) -> list[Subpath]:
    if rx == 0 or ry == 0:
        return []
    whole = arc(np.array([x, y]), np.diag([rx, ry]), 0.0, tau, tolerance)
    whole.pieces[-1, 3] = whole.pieces[0, 0]
    return [Subpath(whole.pieces[0, 0], [whole.pieces], closed=True, deviation=whole.deviation)]
