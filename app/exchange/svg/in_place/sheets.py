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

_SAME_ANGLE = 1e-4
"""Degrees."""


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
    """Move, lock, take out and put in guides; what else is said of one stays, such as its colour."""
    sheet = reading.sheet
    if (page := sheet.page) is None:
        return
    room = _ROUNDING * max(page.width, page.height)

    def is_same(one: Guide, other: Guide) -> bool:
        is_as_steep = one.axis is other.axis and abs(one.lean - other.lean) <= _SAME_ANGLE
        return is_as_steep and other.distance(one.point) <= room

    known = [(node, guide) for node, guide in reading.guides if guide is not None]
    new = [each for each in wanted if not any(is_same(each, guide) for _, guide in known)]
    for node, guide in known:
        if same := [each for each in wanted if is_same(guide, each)]:
            _lock(source, node, guide, same[0])
            continue
        moved = next((each for each in new if each.axis is guide.axis), None)
        if moved is None:
            node.take_out()
        else:
            new.remove(moved)
            _put(node, moved, sheet, page)
            _lock(source, node, guide, moved)
    for guide in new:
        node = Node(source.sodipodi("guide"))
        _put(node, guide, sheet, page)
        if guide.locked:
            node.set(source.inkscape("locked"), "true")
        node.put_last(_view(source))


def _lock(source: Source, node: Node, old: Guide, new: Guide) -> None:
    """Say whether a guide is locked, where the file says otherwise."""
    if new.locked is not old.locked:
        node.set(source.inkscape("locked"), "true" if new.locked else "false")


def _view(source: Source) -> Node:
    found = next((each for each in source.root.elements if each.tag == "namedview"), None)
    if found is None:
        found = Node(source.sodipodi("namedview"))
        found.set("id", "namedview")
        found.put_before(source.root.elements[0])
    return found


def _put(node: Node, guide: Guide, sheet: Sheet, page: Page) -> None:
    """Say where a guide is, from the lower left corner in user units."""
    user = np.array([sheet.viewport.width or page.width, sheet.viewport.height or page.height])
    scale = user / (page.width, page.height)
    x, y = (float(each) for each in (np.array(guide.point) - (page.x, page.y)) * scale)
    if guide.lean:
        across, up = (float(each) for each in np.array(guide.way) * scale)
        place, normal = f"{number(x)},{number(y)}", f"{number(-up)},{number(across)}"
    elif guide.axis is Axis.X:
        place, normal = f"{number(x)},0", "1,0"
    else:
        place, normal = f"0,{number(y)}", "0,1"
    node.set("position", place)
    node.set("orientation", normal)
