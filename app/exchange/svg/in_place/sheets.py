"""Page and guides of a document in the source of a file."""

from __future__ import annotations

import numpy as np

from ....document.model import Axis, Guide, Page
from ...units import css_length, known_unit
from ..numbers import number
from ..sheet import Sheet
from .found import Reading
from .source import Node, Source, SourceError

_ROUNDING = 1e-6


def set_page(source: Source, sheet: Sheet, page: Page | None, unit: str) -> None:
    """Show another page, in the plane of the file, where the document has another.

    Raises
    ------
    SourceError
        If the file has a page and the document has none, or the other way round.
    """
    if (page is None) != (sheet.page is None):
        raise SourceError("there is a page in one only")
    if page is None or sheet.page is None or (_is_same(page, sheet.page) and unit == sheet.unit):
        return
    across, down = abs(sheet.matrix[0, 0]), abs(sheet.matrix[1, 1])
    box = (page.x / across, -(page.y + page.height) / down, page.width / across, page.height / down)
    source.root.set("viewBox", " ".join(number(float(each)) for each in box))
    if known := known_unit(unit):
        source.root.set("width", css_length(page.width, known))
        source.root.set("height", css_length(page.height, known))


def _is_same(one: Page, other: Page) -> bool:
    room = _ROUNDING * max(one.width, one.height)
    sides = [(each.x, each.y, each.width, each.height) for each in (one, other)]
    return all(abs(a - b) <= room for a, b in zip(*sides, strict=True))


def set_guides(source: Source, reading: Reading, wanted: tuple[Guide, ...]) -> None:
    """Take out the guides that the document has no more, and put in those that the file has not."""
    sheet = reading.sheet
    if (page := sheet.page) is None:
        return
    room = _ROUNDING * max(page.width, page.height)

    def is_same(one: Guide, other: Guide) -> bool:
        return one.axis is other.axis and abs(one.position - other.position) <= room

    known: list[Guide] = []
    for node, guide in reading.guides:
        if guide is not None and any(is_same(guide, each) for each in wanted):
            known.append(guide)
        elif guide is not None:
            node.take_out()
    new = [each for each in wanted if not any(is_same(each, other) for other in known)]
    for guide in new:
        _element(source, guide, sheet, page).put_last(_view(source))


def _view(source: Source) -> Node:
    found = next((each for each in source.root.elements if each.tag == "namedview"), None)
    if found is None:
        found = Node(source.sodipodi("namedview"))
        found.set("id", "namedview")
        found.put_before(source.root.elements[0])
    return found


def _element(source: Source, guide: Guide, sheet: Sheet, page: Page) -> Node:
    user = np.array([sheet.viewport.width or page.width, sheet.viewport.height or page.height])
    scale = user / (page.width, page.height)
    node = Node(source.sodipodi("guide"))
    if guide.axis is Axis.X:
        node.set("position", f"{number(float((guide.position - page.x) * scale[0]))},0")
        node.set("orientation", "1,0")
    else:
        node.set("position", f"0,{number(float((guide.position - page.y) * scale[1]))}")
        node.set("orientation", "0,1")
    return node
