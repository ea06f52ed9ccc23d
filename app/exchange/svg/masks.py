"""Masks of SVG as those of a document, in its plane.

Reference: CSS Masking Module Level 1, sections 8 and 9.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
from msgspec import structs

from curvecore.arrays import FloatArray

from ...document.gradient import MOST_LETTERS, Tile
from ...document.mask import MOST_MASKS, Mask
from ...document.model import MAX_MAGNITUDE
from ...view_model.geometry.extents import extent_of
from ..errors import ExchangeError
from .elements import Elements
from .flaw import Flaw
from .groups import Drawn
from .lengths import Viewport, length
from .matrices import Box, combined, inverse_of, moved, transform_of
from .state import State
from .tiles import TileBody
from .xml_tree import speaks_to_us, tag_of

_UNKNOWN = Flaw("a mask covers some of it", "it comes in whole")
_TOGETHER = Flaw("it is masked as a whole", "each of its shapes is")
_BOX = "objectBoundingBox"
_USUAL = {"x": "-10%", "y": "-10%", "width": "120%", "height": "120%"}
_ROUNDING = 1e-9
_MOST_COMPARED = 200


class Masks:
    """The masks of one file."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements

    def over(
        self, drawn: list[Drawn], declared: Mapping[str, str], state: State
    ) -> tuple[list[Drawn], tuple[Flaw, ...]]:
        """Return what an element draws under the `mask` that it declares, and what is to be told of that.

        What cannot be known of a mask leaves all as it is.
        """
        if not drawn:
            return drawn, ()
        try:
            with np.errstate(all="ignore"):
                mask = self._mask(declared, state, drawn)
        except (ExchangeError, np.linalg.LinAlgError):
            mask = None
        if mask is None or any(len(each.path.look.style.masks) >= MOST_MASKS for each in drawn):
            return drawn, (_UNKNOWN,)
        return [_under(mask, each) for each in drawn], (_TOGETHER,) if _do_any_meet(drawn) else ()

    def _mask(self, declared: Mapping[str, str], state: State, drawn: Sequence[Drawn]) -> Mask | None:
        element = self._elements.referred(declared["mask"])
        if element is None or tag_of(element) != "mask" or element.get("color-interpolation") == "linearRGB":
            return None
        box = _box(drawn, state.matrix)
        is_of_box = element.get("maskContentUnits") == _BOX
        content = np.array([[box[2], 0, box[0]], [0, box[3], box[1]]]) if is_of_box else np.eye(2, 3)
        region = _region(element, state.viewport, box)
        holder = element
        parts = [each for each in element if speaks_to_us(each) and tag_of(each) != "defs"]
        view = _seen(region, content)
        if len(parts) == 1 and _is_plain_group(parts[0]):
            # As it is written here: the rest of its plane is that of the group.
            inner = combined(content, transform_of(parts[0].get("transform", "")))
            if (within := _seen(region, inner)) is not None:
                holder, view = parts[0], within
        if view is None:
            return None
        x, y, width, height = region
        corners = moved(np.array([(x, y), (x + width, y), (x, y + height)]), state.matrix)
        body = TileBody(self._elements).of_pattern(element, holder)
        if len(body) > MOST_LETTERS or not (np.abs(np.append(corners, view)) <= MAX_MAGNITUDE).all():
            return None
        start, end, side = [(float(a), float(b)) for a, b in corners]
        is_alpha = self._elements.declared(element).get("mask-type") == "alpha"
        return Mask(Tile(body, view), start, end, side, is_alpha)


def _region(mask: ET.Element, viewport: Viewport, box: Box) -> Box:
    """Return the part of the plane of an element beyond which a mask shows nothing.

    Raises
    ------
    ExchangeError
        If it has no size that is known.
    """
    is_of_box = mask.get("maskUnits", _BOX) == _BOX
    sides = Viewport(1.0, 1.0) if is_of_box else viewport
    found = [length(mask.get(name, usual), sides.side(name)) for name, usual in _USUAL.items()]
    x, y, width, height = (math.nan if each is None else each for each in found)
    if is_of_box:
        x, y = box[0] + x * box[2], box[1] + y * box[3]
        width, height = width * box[2], height * box[3]
    if not (width > 0 and height > 0 and math.isfinite(x + y)):
        raise ExchangeError("A mask needs a width and a height.")
    return x, y, width, height


def _seen(region: Box, content: FloatArray) -> Box | None:
    """Return a region in the units of what a mask shows; None where it is turned there, or upside down."""
    x, y, width, height = region
    corners = moved(np.array([(x, y), (x + width, y), (x, y + height)]), inverse_of(content))
    (left, top), across, down = corners[0], corners[1] - corners[0], corners[2] - corners[0]
    room = _ROUNDING * (abs(across[0]) + abs(down[1]))
    if abs(across[1]) > room or abs(down[0]) > room or not (across[0] > 0 and down[1] > 0):
        return None
    # Without a zero that has a sign.
    return float(left) + 0.0, float(top) + 0.0, float(across[0]), float(down[1])


def _is_plain_group(element: ET.Element) -> bool:
    return tag_of(element) == "g" and set(element.attrib) <= {"transform", "id"} and bool(len(element))


def _box(drawn: Sequence[Drawn], matrix: FloatArray) -> Box:
    """Return the box around what an element draws, in its units."""
    back = inverse_of(matrix)
    pieces = np.concatenate([moved(each.path.pieces, back) for each in drawn])
    (left, top), (right, bottom) = extent_of(pieces).tolist()
    return left, top, right - left, bottom - top


def _under(mask: Mask, drawn: Drawn) -> Drawn:
    look = drawn.path.look
    style = structs.replace(look.style, masks=(*look.style.masks, mask))
    return replace(drawn, path=replace(drawn.path, look=replace(look, style=style)))


def _do_any_meet(drawn: Sequence[Drawn]) -> bool:
    """Whether shapes of a masked group may lie one over the other, which then show through each other."""
    boxes: dict[int, list[FloatArray]] = {}
    for each in drawn:
        boxes.setdefault(each.element, []).append(extent_of(each.path.pieces))
    if len(boxes) > _MOST_COMPARED:
        return True
    whole = [(np.min(each, axis=0)[0], np.max(each, axis=0)[1]) for each in boxes.values()]
    return any(
        bool((one[0] < other[1]).all() and (other[0] < one[1]).all()) for one, other in combinations(whole, 2)
    )
