"""Guides of Inkscape's as those of a document, and the other way round."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from ...document.guide import Axis, Guide, guide_at
from ...document.model import MAX_MAGNITUDE
from ...document.paper import PAPER_UNITS
from ..drawing.frames import Frame
from .names import LOCKED, SODIPODI
from .numbers import number
from .sheet import Sheet

_ANGLE_DIGITS = 5
"""Decimals of an angle in degrees: those of its normal are as many as those of places."""

_SIGNIFICANT = 7
"""Digits of a place: Inkscape writes eight, the last of them often off by one."""


def guides_of(root: ET.Element, sheet: Sheet) -> Iterator[tuple[ET.Element, Guide | None]]:
    """Yield the elements that are guides, each with the document's; None where a document has no such."""
    for element in root.findall(f"{SODIPODI}namedview/{SODIPODI}guide"):
        yield element, _guide(element, sheet)


def _guide(element: ET.Element, sheet: Sheet) -> Guide | None:
    """Return a guide; its place is in user units, from the lower left corner."""
    place, normal = _pair(element.get("position", "")), _pair(element.get("orientation", ""))
    page, viewport = sheet.page, sheet.viewport
    if place is None or normal is None or page is None or not viewport.width or not viewport.height:
        return None
    across, up = page.width / viewport.width, page.height / viewport.height
    point = (page.x + place[0] * across, page.y + place[1] * up)
    # Along it, in the unit of the document.
    way = (-normal[1] * across, normal[0] * up)
    # Written so that NaN fails.
    if not (0 < math.hypot(*way) < math.inf and max(map(abs, point)) <= MAX_MAGNITUDE):
        return None
    guide = guide_at(point, round(math.degrees(math.atan2(way[1], way[0])), _ANGLE_DIGITS))
    return replace(guide, locked=element.get(LOCKED) == "true")


def view_elements(guides: Sequence[Guide], frame: Frame, unit: str) -> list[str]:
    """Return what Inkscape keeps of its window, in lines of SVG: the unit that it tells, and guides.

    Their places are from the lower left corner.
    """
    told = f' inkscape:document-units="{unit}"' if unit in PAPER_UNITS else ""
    if not guides:
        return [f'  <sodipodi:namedview id="namedview"{told}/>'] if told else []
    lines = [f"    {_element(each, frame)}" for each in guides]
    return [f'  <sodipodi:namedview id="namedview"{told}>', *lines, "  </sodipodi:namedview>"]


def _element(guide: Guide, frame: Frame) -> str:
    (x, y), (across, up) = guide.point, guide.way
    if guide.lean:
        place = f"{number(x - frame.left)},{number(y - frame.bottom)}"
        normal = f"{number(-up)},{number(across)}"
    elif guide.axis is Axis.X:
        place, normal = f"{number(x - frame.left)},0", "1,0"
    else:
        place, normal = f"0,{number(y - frame.bottom)}", "0,1"
    lock = ' inkscape:locked="true"' if guide.locked else ""
    return f'<sodipodi:guide position="{place}" orientation="{normal}"{lock}/>'


def _pair(text: str) -> tuple[float, float] | None:
    """Return two numbers of an attribute; None where it is something else."""
    try:
        first, second = (float(f"{float(each):.{_SIGNIFICANT}g}") for each in text.split(","))
    except ValueError:
        return None
    return first, second
