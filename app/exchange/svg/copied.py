"""What Inkscape copies, and pastes: an SVG that says where on the page its drawing was."""

from __future__ import annotations

import dataclasses
import math

from msgspec.structs import replace

from ...document.model import Document, Page, Vector
from ..corner import shifted
from ..cubics_in import Imported
from ..drawing.trim import painted_box
from ..rescaled import factor_between
from .names import CLIPBOARD
from .numbers import number
from .reader import read_svg
from .xml_tree import parsed


def read_copied(data: bytes, tolerance: float | None = None) -> Imported:
    """Return the curves of what Inkscape copied, without the groups that it put around.

    They are where they were on their page, whose upper left corner is that of the page here.

    Raises
    ------
    ExchangeError
        As `read_svg`.
    """
    found = read_svg(data, tolerance, is_in_groups=True)
    page = found.document.page
    if (place := _place_in(data)) is None or page is None:
        return found
    factor = factor_between("px", found.document.unit)
    moved = shifted(found.document, (place[0] * factor, -place[1] * factor))
    return dataclasses.replace(found, document=replace(moved, page=page))


def _place_in(data: bytes) -> Vector | None:
    """Return where the upper left corner of a drawing was on its page, in pixels, down; None if unsaid."""
    element = parsed(data).find(CLIPBOARD)
    try:
        x, y = map(float, element.get("min", "").split(",")) if element is not None else (math.nan, math.nan)
    except ValueError:
        return None
    return (x, y) if math.isfinite(x) and math.isfinite(y) else None


def place_element(document: Document, page: Page | None) -> str:
    """Return the element that says where a drawing in pixels was, with its strokes, on a page.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    """
    low, high = painted_box(document).tolist()
    left, top = (page.x, page.y + page.height) if page is not None else (0.0, 0.0)
    least = f"{number(low[0] - left)},{number(top - high[1])}"
    most = f"{number(high[0] - left)},{number(top - low[1])}"
    return f'  <inkscape:clipboard min="{least}" max="{most}"/>'
