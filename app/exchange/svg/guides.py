"""Guides of Inkscape's as those of a document, and the other way round."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

from ...document.model import MAX_MAGNITUDE, Axis, Guide
from ..drawing.frames import Frame
from ..errors import Flaw
from .numbers import number
from .sheet import Sheet
from .xml_tree import SODIPODI

_ODD = Flaw("guide", "without a position left out")
_LEANING = Flaw("leaning guide")

_LEVEL = 1e-5
"""Share of its normal by which a level or upright guide leans: it is written with few digits."""

_SIGNIFICANT = 7
"""Digits of a place: Inkscape writes eight, the last of them often off by one."""


def guides_of(root: ET.Element, sheet: Sheet) -> Iterator[tuple[ET.Element, Guide | Flaw]]:
    """Yield the elements that are guides, each with the document's, or with why a document has none such."""
    for element in root.findall(f"{SODIPODI}namedview/{SODIPODI}guide"):
        yield element, _guide(element, sheet)


def _guide(element: ET.Element, sheet: Sheet) -> Guide | Flaw:
    """Return a guide; its place is in user units, from the lower left corner."""
    place, normal = _pair(element.get("position", "")), _pair(element.get("orientation", ""))
    frame, viewport = sheet.frame, sheet.viewport
    if place is None or normal is None or frame is None or not viewport.width or not viewport.height:
        return _ODD
    across, up = (abs(each) for each in normal)
    # Written so that NaN fails.
    if not 0 < max(across, up) < math.inf:
        return _ODD
    if min(across, up) > _LEVEL * max(across, up):
        return _LEANING
    axis = Axis.X if across > up else Axis.Y
    start, size, user = (
        (frame.left, frame.width, viewport.width)
        if axis is Axis.X
        else (frame.bottom, frame.height, viewport.height)
    )
    position = start + place[axis.coordinate] * (size / user)
    return Guide(axis, position) if abs(position) <= MAX_MAGNITUDE else _ODD


def view_elements(guides: Sequence[Guide], frame: Frame) -> list[str]:
    """Return guides as Inkscape keeps them with its window, in lines of SVG; from the lower left corner."""
    if not guides:
        return []
    lines = [f"    {_element(each, frame)}" for each in guides]
    return ['  <sodipodi:namedview id="namedview">', *lines, "  </sodipodi:namedview>"]


def _element(guide: Guide, frame: Frame) -> str:
    if guide.axis is Axis.X:
        place, normal = f"{number(guide.position - frame.left)},0", "1,0"
    else:
        place, normal = f"0,{number(guide.position - frame.bottom)}", "0,1"
    return f'<sodipodi:guide position="{place}" orientation="{normal}"/>'


def _pair(text: str) -> tuple[float, float] | None:
    """Return two numbers of an attribute; None where it is something else."""
    try:
        first, second = (float(f"{float(each):.{_SIGNIFICANT}g}") for each in text.split(","))
    except ValueError:
        return None
    return first, second
