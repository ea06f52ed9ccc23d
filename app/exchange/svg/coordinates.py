"""Coordinates of SVG: lengths in user units, transforms (2, 3), view boxes, and the page of a file.

Reference: Scalable Vector Graphics 2, section 8; CSS Values and Units 4, section 6; CSS Transforms 1,
sections 5, 8 and 13.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, isfinite, pi, radians, sin, tan

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray

from ...document.lengths import MILLIMETRES
from ...document.limits import MAX_MAGNITUDE
from ...document.model import Axis, Guide
from ..drawing.outlines import Frame
from ..errors import ExchangeError

NUMBER = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
"""Regular expression of a number."""

_LENGTH = re.compile(rf"({NUMBER})\s*(px|in|cm|mm|pt|pc|q|em|ex|ch|rem|%)?", re.IGNORECASE)
_IN_FONTS = re.compile(rf"(?<![\w.]){NUMBER}(?:em|ex|ch|rem)\b", re.IGNORECASE)
_PIXELS = {"": 1.0, "q": 96 / 101.6} | {
    unit: MILLIMETRES[unit] / MILLIMETRES["px"] for unit in ("px", "in", "cm", "mm", "pt", "pc")
}
_FONT_SHARES = {"em": 1.0, "ex": 0.5, "ch": 0.5}
"""Units of a font as parts of its size. Of a font that is not there CSS takes half for x and for 0."""

_UNKNOWN = ("vw", "vh", "vi", "vb", "vmin", "vmax", "cap", "ic", "lh", "auto", ")")
_MEDIUM = 16.0
_FONT_SIZES = {
    "xx-small": 9.0,
    "x-small": 10.0,
    "small": 13.0,
    "medium": _MEDIUM,
    "initial": _MEDIUM,
    "large": 18.0,
    "x-large": 24.0,
    "xx-large": 32.0,
    "xxx-large": 48.0,
}
"""Pixels, as browsers have them."""

_STEPS = {"smaller": "0.8333333333333334em", "larger": "1.2em"}


@dataclass(frozen=True)
class Viewport:
    """Reference lengths of percentages and fonts, in user units; None where unknown.

    Attributes
    ----------
    width, height
        Size that percentages refer to.
    em, rem
        The font size of the element, and of the root.
    """

    width: float | None = None
    height: float | None = None
    em: float = _MEDIUM
    rem: float = _MEDIUM

    def side(self, name: str) -> float | None:
        """Return the length that percentages of this attribute refer to."""
        if name in ("x", "width", "cx", "x1", "x2", "rx"):
            return self.width
        if name in ("y", "height", "cy", "y1", "y2", "ry"):
            return self.height
        if self.width is None or self.height is None:
            return None
        return math.hypot(self.width, self.height) / math.sqrt(2)

    def length(self, text: str, name: str = "") -> float | None:
        """Return the length of an attribute or a property, in user units; see `length`."""
        return length(text, self.side(name), self.em, self.rem)

    def sized(self, width: float, height: float) -> Viewport:
        """Return a viewport of another size with the same fonts."""
        return replace(self, width=width, height=height)

    def with_font(self, size: str) -> Viewport:
        """Return the viewport within an element that declares this font size; an invalid size is ignored."""
        word = _STEPS.get(size.lower(), size.lower())
        try:
            em = _FONT_SIZES[word] if word in _FONT_SIZES else length(word, self.em, self.em, self.rem)
        except ExchangeError:
            return self
        return replace(self, em=em) if em is not None and 0 <= em <= MAX_MAGNITUDE else self

    def in_pixels(self, text: str) -> str:
        """Return a list of lengths with those in units of a font converted to numbers."""
        return _IN_FONTS.sub(lambda match: repr(length(match[0], None, self.em, self.rem)), text)


def length(text: str, of: float | None = None, em: float | None = None, rem: float = _MEDIUM) -> float | None:
    """Return a length in user units; None where its reference length is unknown.

    Raises
    ------
    ExchangeError
        If it is no length.
    """
    if text.strip().lower().endswith(_UNKNOWN):
        return None
    match = _LENGTH.fullmatch(text.strip())
    if match is None or not math.isfinite(float(match[1])):
        raise ExchangeError(f"“{text[:20]}” is not a length.")
    value, unit = float(match[1]), (match[2] or "").lower()
    if unit == "%":
        return None if of is None else of * value / 100
    if unit == "rem":
        return value * rem
    if unit in _FONT_SHARES:
        return None if em is None else value * em * _FONT_SHARES[unit]
    return value * _PIXELS[unit]


def with_unit(text: str, em: float) -> tuple[float, str] | None:
    """Return a positive length as a number and its unit; None for other lengths, and for percentages.

    Parameters
    ----------
    text
        The length.
    em
        The font size of the root: lengths in units of its font are pixels.
    """
    match = _LENGTH.fullmatch(text.strip())
    if match is None or (match[2] or "").lower() == "%":
        return None
    value, unit = float(match[1]), (match[2] or "px").lower()
    if unit == "q":
        value, unit = value / 4, "mm"
    elif unit == "rem" or unit in _FONT_SHARES:
        value, unit = value * em * _FONT_SHARES.get(unit, 1.0), "px"
    return (value, unit) if 0 < value < math.inf else None


# Transforms and view boxes


_REST = re.compile(r"[ \t\r\n,]*\Z")
_CALL = re.compile(r"[\s,]*([A-Za-z]+(?:3[dD])?)\s*\(([^()]*)\)")
_ARGUMENT = re.compile(rf"({NUMBER})(%|[a-z]*)", re.IGNORECASE)
_DEGREES = {"": 1.0, "deg": 1.0, "grad": 0.9, "rad": 180 / pi, "turn": 360.0}
_KEYWORDS = {"left": "0", "top": "0", "center": "50%", "right": "100%", "bottom": "100%"}
_NO_BOX = Viewport()
_ALIGN = re.compile(r"\s*(?:defer\s+)?x(Min|Mid|Max)Y(Min|Mid|Max)(?:\s+(meet|slice))?\s*")
_SHARES = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}

Box = tuple[float, float, float, float]
"""x, y, width and height, y down."""


def transform_of(
    text: str, box: Viewport = _NO_BOX, origin: str = "", corner: tuple[float, float] = (0.0, 0.0)
) -> FloatArray:
    """Return the matrix of a list of transforms, as attributes and as CSS have them.

    Parameters
    ----------
    text
        The list.
    box
        Box that percentages refer to.
    origin
        Origin of the transforms in the box, as in `transform-origin`; by default its corner.
    corner
        The corner of the box.

    Raises
    ------
    ExchangeError
        With the position or the part of the list that is invalid, is no transform of a plane, or has
        a length of unknown size.
    """
    result, position = np.eye(2, 3), 0
    # Every match advances the position, and no text is copied.
    while not _REST.match(text, position):
        match = _CALL.match(text, position)
        if match is None:
            raise ExchangeError(f"at character {position + 1}")
        result = composed(result, _one_transform(match[1], match[2], box))
        position = match.end()
    x, y = _origin_in(box, origin) if origin else (0.0, 0.0)
    return _transform_about(corner[0] + x, corner[1] + y, result)


def _one_transform(name: str, arguments: str, box: Viewport) -> FloatArray:
    try:
        kinds, matrix = _MATRICES[name.lower()]
        words = _ARGUMENT.findall(arguments)
        if _ARGUMENT.sub("", arguments).strip(" \t\r\n,") or len(words) > len(kinds):
            raise ValueError
        values = [_argument(kind, word, box) for kind, word in zip(kinds, words, strict=False)]
        return np.array(matrix(*values), dtype=float)
    except (KeyError, TypeError, ValueError):
        raise ExchangeError(f"“{name}({arguments})"[:40] + "”") from None


def _argument(kind: str, word: tuple[str, str], box: Viewport) -> float:
    """Return a number ("n"), an angle in degrees ("a"), or a length along x or y ("x", "y")."""
    number, unit = word
    if kind in "xy":
        value = box.length(number + unit, kind)
    elif kind == "a":
        value = float(number) * _DEGREES[unit.lower()]
    else:
        value = float(number) / {"": 1.0, "%": 100.0}[unit]
    if value is None or not isfinite(value):
        raise ValueError
    return value


def _origin_in(box: Viewport, origin: str) -> tuple[float, float]:
    """Return the position of a `transform-origin` in a box."""
    words = [*origin.lower().split()[:2], "center"]
    if words[0] in ("top", "bottom") or words[1] in ("left", "right"):
        words[:2] = words[1::-1]
    try:
        x, y = (box.length(_KEYWORDS.get(word, word), axis) for word, axis in zip(words, "xy", strict=False))
    except ExchangeError:
        x = y = None
    if x is None or y is None:
        raise ExchangeError(f"about “{origin[:40]}”")
    return x, y


def _transform_about(x: float, y: float, matrix: FloatArray) -> FloatArray:
    """Return a transform about the origin as one about another position."""
    result = matrix.copy()
    with np.errstate(all="ignore"):
        result[:, 2] += (x, y) - result[:, :2] @ (x, y)
    return result


def _rotation(degrees: float, *centre: float) -> FloatArray:
    angle = radians(degrees)
    x, y = centre or (0.0, 0.0)
    return _transform_about(x, y, np.array([[cos(angle), -sin(angle), 0.0], [sin(angle), cos(angle), 0.0]]))


_MATRICES: dict[str, tuple[str, Callable[..., ArrayLike]]] = {
    "matrix": ("nnnnxy", lambda a, b, c, d, e, f: ((a, c, e), (b, d, f))),
    "translate": ("xy", lambda x, y=0.0: ((1, 0, x), (0, 1, y))),
    "translatex": ("x", lambda x: ((1, 0, x), (0, 1, 0))),
    "translatey": ("y", lambda y: ((1, 0, 0), (0, 1, y))),
    "translate3d": ("xyx", lambda x, y, _z: ((1, 0, x), (0, 1, y))),
    "translatez": ("x", lambda _z: np.eye(2, 3)),
    "scale": ("nn", lambda x, y=None: ((x, 0, 0), (0, x if y is None else y, 0))),
    "scalex": ("n", lambda x: ((x, 0, 0), (0, 1, 0))),
    "scaley": ("n", lambda y: ((1, 0, 0), (0, y, 0))),
    "scale3d": ("nnn", lambda x, y, _z: ((x, 0, 0), (0, y, 0))),
    "rotate": ("axy", _rotation),
    "rotatez": ("a", _rotation),
    "skew": ("aa", lambda x, y=0.0: ((1, tan(radians(x)), 0), (tan(radians(y)), 1, 0))),
    "skewx": ("a", lambda x: ((1, tan(radians(x)), 0), (0, 1, 0))),
    "skewy": ("a", lambda y: ((1, 0, 0), (tan(radians(y)), 1, 0))),
}
"""The kinds of arguments of each transform, see `_argument`, and its matrix (2, 3)."""


def composed(outer: FloatArray, inner: FloatArray) -> FloatArray:
    """Return the product of matrices that applies the inner one first."""
    with np.errstate(all="ignore"):
        result = outer[:, :2] @ inner
        result[:, 2] += outer[:, 2]
    return result


def transform_points(points: FloatArray, matrix: FloatArray) -> FloatArray:
    """Return points (…, 2) transformed by a matrix."""
    with np.errstate(all="ignore"):
        return np.asarray(points @ matrix[:, :2].T + matrix[:, 2])


def translation(x: float, y: float) -> FloatArray:
    """Return the matrix of a translation."""
    return np.array([[1.0, 0.0, x], [0.0, 1.0, y]])


def largest_scale(matrix: FloatArray) -> float:
    """Return the largest factor by which a matrix stretches."""
    return float(np.linalg.norm(matrix[:, :2], 2))


def mean_scale(matrix: FloatArray) -> float:
    """Return the square root of the factor by which a matrix enlarges areas."""
    with np.errstate(all="ignore"):
        return float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))


def is_uneven(matrix: FloatArray) -> bool:
    """Whether a matrix stretches more in one direction than in another."""
    most, least = np.linalg.svd(matrix[:, :2], compute_uv=False)
    return bool(most > least * (1 + 1e-4))


def box_of(text: str) -> Box | None:
    """Return a view box; None for an invalid or empty one."""
    try:
        x, y, width, height = (float(number) for number in re.split(r"[\s,]+", text.strip()))
    except ValueError:
        return None
    is_usable = width > 0 and height > 0 and bool(np.isfinite((x, y, width, height)).all())
    return (x, y, width, height) if is_usable else None


def fitted_box(box: Box, area: Box, ratio: str) -> FloatArray:
    """Return the matrix from a view box to the area that it fills, by `preserveAspectRatio`."""
    across, down = area[2] / box[2], area[3] / box[3]
    match = _ALIGN.fullmatch(ratio or "xMidYMid")
    x_share = y_share = 0.0
    if ratio.strip().split(" ")[0] != "none":
        x_share, y_share = (_SHARES[match[1]], _SHARES[match[2]]) if match else (0.5, 0.5)
        is_slice = match is not None and match[3] == "slice"
        across = down = max(across, down) if is_slice else min(across, down)
    x = area[0] + (area[2] - across * box[2]) * x_share - across * box[0]
    y = area[1] + (area[3] - down * box[3]) * y_share - down * box[1]
    return np.array([[across, 0.0, x], [0.0, down, y]])


# The page


_ROUNDING = 1e-5
"""By how much a size in a file may differ from its view box and mean the same."""


@dataclass(frozen=True, eq=False)
class Page:
    """Map of the user units of a file to those of a document.

    Attributes
    ----------
    unit
        Unit of the document; empty where the file has no size.
    matrix
        Matrix from user units, y down, to the document, y up. The origin stays.
    viewport
        Viewport that percentages refer to.
    pixel
        Length of a CSS pixel in the document.
    frame
        Frame that the file shows, in the document; None where it is unknown.
    """

    unit: str
    matrix: FloatArray
    viewport: Viewport
    pixel: float = 1.0
    frame: Frame | None = None

    @property
    def edges(self) -> tuple[Guide, ...]:
        """The edges of the frame that the file shows, as guides."""
        if (frame := self.frame) is None:
            return ()
        across, up = (frame.left, frame.left + frame.width), (frame.bottom, frame.top)
        return (*(Guide(Axis.X, x) for x in across), *(Guide(Axis.Y, y) for y in up))


def page_of(root: ET.Element, font_size: str = "", *, is_nominal: bool = False) -> Page:
    """Return the page of a file whose root declares a font size; a nominal size is ignored."""
    em = Viewport().with_font(font_size).em
    fonts = Viewport(em=em, rem=em)
    box = box_of(root.get("viewBox", ""))
    size = None if is_nominal else _size(root, box, em)
    if size is None:
        viewport = fonts.sized(*box[2:]) if box else fonts
        return Page("", _scaling(1.0, 1.0), viewport, frame=_frame(box) if box else None)
    width, height, unit = size
    pixel = MILLIMETRES["px"] / MILLIMETRES[unit]
    area = (0.0, 0.0, width, height)
    if box is None:
        viewport = fonts.sized(width / pixel, height / pixel)
        return Page(unit, _scaling(pixel, pixel), viewport, pixel, _frame(area))
    fit = fitted_box(box, area, root.get("preserveAspectRatio", ""))
    across, down = (_snapped(fit[axis, axis]) for axis in (0, 1))
    frame = _frame((-fit[0, 2], -fit[1, 2], width, height))
    return Page(unit, _scaling(across, down), fonts.sized(*box[2:]), pixel, frame)


def _size(root: ET.Element, box: Box | None, em: float) -> tuple[float, float, str] | None:
    """Return width and height of a file in one unit; None where they are not both known."""
    across, down = (with_unit(root.get(name, ""), em) for name in ("width", "height"))
    first = across or down
    if first is None or (box is None and (across is None or down is None)):
        return None
    unit = first[1]

    def in_unit(given: tuple[float, str] | None, other: tuple[float, str] | None, share: float) -> float:
        if given is not None:
            return given[0] * (1.0 if given[1] == unit else MILLIMETRES[given[1]] / MILLIMETRES[unit])
        assert other is not None
        return in_unit(other, None, 1.0) * share

    share = box[2] / box[3] if box else 1.0
    return in_unit(across, down, share), in_unit(down, across, 1 / share), unit


def _snapped(scale: float) -> float:
    return 1.0 if abs(scale - 1.0) < _ROUNDING else float(scale)


def _scaling(across: float, down: float) -> FloatArray:
    return np.array([[across, 0.0, 0.0], [0.0, -down, 0.0]])


def _frame(box: Box) -> Frame | None:
    """Return the frame that a file shows; None where a document cannot hold it."""
    x, y, width, height = (float(value) + 0.0 for value in box)
    bottom = -(y + height) + 0.0
    is_sound = max(abs(edge) for edge in (x, x + width, y, bottom)) <= MAX_MAGNITUDE
    return Frame(x, bottom, width, height) if is_sound and min(width, height) > 0 else None
