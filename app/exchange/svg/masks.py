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
from .xml_tree import tag_of

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
                masks = self._masks(declared["mask"], state, _box(drawn, state.matrix), 0)
        except (ExchangeError, np.linalg.LinAlgError):
            masks = ()
        most = max(len(each.path.look.style.masks) for each in drawn)
        if not masks or most + len(masks) > MOST_MASKS:
            return drawn, (_UNKNOWN,)
        return [_under(masks, each) for each in drawn], (_TOGETHER,) if _do_any_meet(drawn) else ()

    def _masks(self, value: str, state: State, box: Box, depth: int) -> tuple[Mask, ...]:
        """Return a mask and those that all of it is masked by; none if one is not known."""
        element = self._elements.referred(value)
        if element is None or tag_of(element) != "mask" or element.get("color-interpolation") == "linearRGB":
            return ()
        group, rest = _lone_group(element, {"mask"}), tuple[Mask, ...]()
        if group is not None and depth < MOST_MASKS and self._is_in_plane(group.get("mask", "")):
            rest = self._masks(group.get("mask", ""), state, box, depth + 1)
        holder = element if group is None or not rest else group
        mask = self._mask(element, holder, state, box)
        return () if mask is None else (mask, *rest)

    def _is_in_plane(self, value: str) -> bool:
        """Whether a mask hangs on no box."""
        mask = self._elements.referred(value)
        return mask is not None and (
            mask.get("maskUnits", _BOX) != _BOX and mask.get("maskContentUnits") != _BOX
        )

    def _mask(self, element: ET.Element, holder: ET.Element, state: State, box: Box) -> Mask | None:
        """Return the mask of an element, with what a `holder` in it holds."""
        is_of_box = element.get("maskContentUnits") == _BOX
        content = np.array([[box[2], 0, box[0]], [0, box[3], box[1]]]) if is_of_box else np.eye(2, 3)
        region = _region(element, state.viewport, box)
        shown = self._within_group(holder, content, region)
        if shown is None:
            view = _seen(region, content)
            if view is None:
                return None
            shown = holder, view, content
        holder, view, content = shown
        x, y, width, height = view
        places = np.array([(x, y), (x + width, y), (x, y + height)])
        corners = moved(places, combined(state.matrix, content))
        body = TileBody(self._elements).of_pattern(element, holder)
        if len(body) > MOST_LETTERS or not (np.abs(np.append(corners, view)) <= MAX_MAGNITUDE).all():
            return None
        start, end, side = [(float(a), float(b)) for a, b in corners]
        is_alpha = self._elements.declared(element).get("mask-type") == "alpha"
        return Mask(Tile(body, view), start, end, side, is_alpha)

    def _within_group(
        self, holder: ET.Element, content: FloatArray, region: Box
    ) -> tuple[ET.Element, Box, FloatArray] | None:
        """Return the group that is all of a mask, what is shown of its plane, and the way from that.

        So they are written here: with the rectangle as a clip in the group where that is turned. None where
        nothing is gained.
        """
        group = _lone_group(holder, {"transform", "id"})
        if group is None:
            return None
        inner = combined(content, transform_of(group.get("transform", "")))
        if (view := _seen(region, inner)) is not None:
            return group, view, inner
        cut = _lone_group(group, {"clip-path"})
        clip = None if cut is None else self._elements.referred(cut.get("clip-path", ""))
        if cut is None or clip is None or [tag_of(each) for each in clip] != ["rect"]:
            return None
        if set(clip.attrib) != {"id"} or set(clip[0].attrib) != set(_USUAL):
            return None
        left, top, wide, high = (length(clip[0].get(name, "")) or 0.0 for name in _USUAL)
        corners = np.array([(left + i * wide, top + j * high) for i in (0, 1) for j in (0, 1)])
        low, size = np.array(region[:2]), np.array(region[2:])
        share = (moved(corners, inner) - low) / size
        is_in = bool((np.abs(share - 0.5) <= 0.5 + _ROUNDING).all()) and wide > 0 and high > 0
        return (cut, (left, top, wide, high), inner) if is_in else None


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


def _lone_group(holder: ET.Element, attributes: set[str]) -> ET.Element | None:
    """Return the group that is all of an element, if it says no more than these; None otherwise."""
    parts = [each for each in holder if tag_of(each) != "defs"]
    found = parts[0] if len(parts) == 1 else None
    is_plain = found is not None and tag_of(found) == "g" and len(found) and set(found.attrib) <= attributes
    return found if is_plain else None


def _box(drawn: Sequence[Drawn], matrix: FloatArray) -> Box:
    """Return the box around what an element draws, in its units."""
    back = inverse_of(matrix)
    pieces = np.concatenate([moved(each.path.pieces, back) for each in drawn])
    (left, top), (right, bottom) = extent_of(pieces).tolist()
    return left, top, right - left, bottom - top


def _under(masks: tuple[Mask, ...], drawn: Drawn) -> Drawn:
    look = drawn.path.look
    style = structs.replace(look.style, masks=(*look.style.masks, *masks))
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
