"""Guides of Inkscape's as those of a document, and the other way round."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence

from ...document.model import MAX_MAGNITUDE, Axis, Guide
from ..drawing.drawing import Frame
from .names import SODIPODI
from .numbers import number
from .sheet import Sheet

_SIGNIFICANT = 7
"""Digits of a place: Inkscape writes eight, the last of them often off by one."""


def guides_of(root: ET.Element, sheet: Sheet) -> Iterator[tuple[ET.Element, Guide | None]]:
    """Yield the elements that are guides, each with the document's; None where a document has no such."""
    for element in root.findall(f"{SODIPODI}namedview/{SODIPODI}guide"):
        yield element, _guide(element, sheet)


def _guide(element: ET.Element, sheet: Sheet) -> Guide | None:
    """Return an upright or a level guide; its place is in user units, from the lower left corner."""
    place, normal = _pair(element.get("position", "")), _pair(element.get("orientation", ""))
    page, viewport = sheet.page, sheet.viewport
    if place is None or normal is None or (normal[0] == 0) == (normal[1] == 0):
        return None
    if page is None or not viewport.width or not viewport.height:
        return None
    if normal[1] == 0:
        guide = Guide(Axis.X, page.x + place[0] * page.width / viewport.width)
    else:
        guide = Guide(Axis.Y, page.y + place[1] * page.height / viewport.height)
    # Written so that NaN fails.
    return guide if abs(guide.position) <= MAX_MAGNITUDE else None


def guide_elements(guides: Sequence[Guide], frame: Frame) -> list[str]:
    """Return guides as Inkscape's, in lines of SVG; their places are from the lower left corner."""
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
