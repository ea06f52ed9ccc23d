"""The size of an SVG file: what one is in it, and the rectangle that it shows."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np

from curvecore.arrays import FloatArray

from ...document.model import MAX_MAGNITUDE, Axis, Guide
from ...document.units import MILLIMETRES
from ..drawing.frames import Frame
from .lengths import Viewport, with_unit
from .matrices import Box, box_of, fitted_box

_ROUNDING = 1e-5
"""By how much a size in a file may differ from its view box and mean the same."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """Map of the user units of a file to those of a document.

    Attributes
    ----------
    unit
        The document's; empty where the file has no size.
    matrix
        From user units, y down, to the document, y up. The origin stays.
    viewport
        What percentages are parts of.
    pixel
        A CSS pixel in the document.
    frame
        What the file shows, in the document; None where nobody says.
    """

    unit: str
    matrix: FloatArray
    viewport: Viewport
    pixel: float = 1.0
    frame: Frame | None = None

    @property
    def edges(self) -> tuple[Guide, ...]:
        """The edges of what the file shows, as guides."""
        if (frame := self.frame) is None:
            return ()
        across, up = (frame.left, frame.left + frame.width), (frame.bottom, frame.top)
        return (*(Guide(Axis.X, x) for x in across), *(Guide(Axis.Y, y) for y in up))


def sheet_of(root: ET.Element, font_size: str = "", *, is_nominal: bool = False) -> Sheet:
    """Return the sheet of a file whose root declares a font size; a nominal size means nothing."""
    em = Viewport().with_font(font_size).em
    fonts = Viewport(em=em, rem=em)
    box = box_of(root.get("viewBox", ""))
    size = None if is_nominal else _size(root, box, em)
    if size is None:
        viewport = fonts.sized(*box[2:]) if box else fonts
        return Sheet("", _scaling(1.0, 1.0), viewport, frame=_frame(box) if box else None)
    width, height, unit = size
    pixel = MILLIMETRES["px"] / MILLIMETRES[unit]
    place = (0.0, 0.0, width, height)
    if box is None:
        viewport = fonts.sized(width / pixel, height / pixel)
        return Sheet(unit, _scaling(pixel, pixel), viewport, pixel, _frame(place))
    fit = fitted_box(box, place, root.get("preserveAspectRatio", ""))
    across, down = (_snapped(fit[axis, axis]) for axis in (0, 1))
    frame = _frame((-fit[0, 2], -fit[1, 2], width, height))
    return Sheet(unit, _scaling(across, down), fonts.sized(*box[2:]), pixel, frame)


def _size(root: ET.Element, box: Box | None, em: float) -> tuple[float, float, str] | None:
    """Return width and height of a file in one unit; None where it does not say both, in any way."""
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
    """Return what a file shows; None where a document cannot hold it."""
    x, y, width, height = (float(each) + 0.0 for each in box)
    bottom = -(y + height) + 0.0
    is_sound = max(abs(each) for each in (x, x + width, y, bottom)) <= MAX_MAGNITUDE
    return Frame(x, bottom, width, height) if is_sound and min(width, height) > 0 else None
