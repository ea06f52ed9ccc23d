"""Clip paths: upright rectangles, which programs put around all that they draw, and other outlines."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence

import numpy as np

from curvecore.arrays import FloatArray

from ...document.clip import MOST_CLIPS, MOST_NUMBERS, MOST_RINGS, Clip, ring_of
from ...document.model import MAX_MAGNITUDE
from ...document.style import Style
from ...view_model.geometry.extents import extent_of
from ..errors import ExchangeError
from .elements import Elements
from .lengths import Viewport
from .matrices import Box, combined, moved, transform_of
from .path_data import Subpath
from .shapes import SHAPES, subpaths_of
from .state import State
from .xml_tree import tag_of

_DEEPEST = 8
"""Clips of clips."""

_DRAWS = (*SHAPES, "use", "g", "text", "image")


class Clips:
    """The clip paths of one file."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements
        self._known: dict[tuple[object, ...], tuple[Clip, ...] | None] = {}

    def box(self, declared: Mapping[str, str], viewport: Viewport) -> Box | None:
        """Return the upright rectangle that a `clip-path` is, in the units of what has it; else None."""
        clip = self._referred(declared)
        if clip is None or _hangs_on_box(clip) or "clip-path" in self._elements.declared(clip):
            return None
        parts = [each for each in clip if tag_of(each) in _DRAWS]
        if len(parts) != 1:
            return None
        part = parts[0]
        if tag_of(part) == "use" and not (part.get("x") or part.get("y")):
            # An element without others in it counts as false.
            target = self._elements.used(part)
            part = part if target is None else target
        if tag_of(part) not in SHAPES or any(each.get("transform") for each in (clip, parts[0], part)):
            return None
        try:
            return _rectangle(subpaths_of(part, viewport, None))
        except ExchangeError:
            return None

    def of_shape(
        self, declared: Mapping[str, str], state: State, outlines: Sequence[FloatArray], style: Style
    ) -> tuple[Clip, ...]:
        """Return all that cuts off some of a shape, whose outlines are in its own units."""
        clips, clip, extent = state.clips, self._referred(declared), extent_of(np.concatenate(outlines))
        if clip is not None and _hangs_on_box(clip):
            (left, top), (right, bottom) = extent.tolist()
            box = (left, top, right - left, bottom - top)
            clips = (*clips, *(self.of(declared, state.matrix, state.viewport, box) or ()))
        if not state.windows:
            return clips
        reach = (style.width or 0.0) / 2 if style.has_stroke else 0.0
        extent = extent_of(np.concatenate([moved(each, state.matrix) for each in outlines]))
        cutting = [each for each in state.windows if not each.holds(extent, reach)]
        return (*clips, *(clip_of_box(each.box, each.matrix) for each in cutting))

    def is_known(self, declared: Mapping[str, str], state: State, *, has_box: bool) -> bool:
        """Whether it is known what a `clip-path` cuts off; `has_box` of shapes, of which the box is known."""
        if declared.get("clip-path", "none") == "none":
            return True
        box = (0.0, 0.0, 1.0, 1.0) if has_box else None
        return (
            self.box(declared, state.viewport) is not None
            or self.of(declared, state.matrix, state.viewport, box) is not None
        )

    def of(
        self, declared: Mapping[str, str], matrix: FloatArray, viewport: Viewport, box: Box | None = None
    ) -> tuple[Clip, ...] | None:
        """Return what a `clip-path` cuts off in the plane of the document, y up; None of what is not known.

        Parameters
        ----------
        declared
            What the element declares that has it.
        matrix
            From the units of that to the plane.
        viewport
            What percentages are parts of.
        box
            That around the element, in its units; None where nobody knows.
        """
        value = declared.get("clip-path", "none")
        if value == "none":
            return ()
        key = (value, matrix.tobytes(), viewport, box)
        if key not in self._known:
            try:
                self._known[key] = self._read(declared, matrix, viewport, box, 0)
            except ExchangeError:
                self._known[key] = None
        return self._known[key]

    def _read(
        self,
        declared: Mapping[str, str],
        matrix: FloatArray,
        viewport: Viewport,
        box: Box | None,
        depth: int,
    ) -> tuple[Clip, ...] | None:
        clip = self._referred(declared)
        if clip is None or depth > _DEEPEST:
            return None
        declared = self._elements.declared(clip)
        around = self._outer(declared, matrix, viewport, box, depth)
        if around is None:
            return None
        if _hangs_on_box(clip):
            if box is None:
                return None
            x, y, width, height = box
            matrix = combined(matrix, np.array([[width, 0.0, x], [0.0, height, y]]))
            viewport = Viewport(1.0, 1.0)
        matrix = _placed(matrix, clip, declared)
        rule = declared.get("clip-rule", "nonzero")
        parts = [each for each in clip if tag_of(each) in _DRAWS]
        if len(parts) == 1:
            outer = self._elements.declared(parts[0])
            own = self._outer(outer, _placed(matrix, parts[0]), viewport, None, depth)
            if own is None:
                return None
            around = (*around, *own)
        elif any(self._elements.declared(each).get("clip-path", "none") != "none" for each in parts):
            return None
        found = self._together([self._rings(each, matrix, viewport, rule) for each in parts])
        return (*around, found) if found is not None and len(around) < MOST_CLIPS else None

    def _outer(
        self, declared: Mapping[str, str], matrix: FloatArray, viewport: Viewport, box: Box | None, depth: int
    ) -> tuple[Clip, ...] | None:
        """Return what cuts a clip itself."""
        is_cut = declared.get("clip-path", "none") != "none"
        return self._read(declared, matrix, viewport, box, depth + 1) if is_cut else ()

    def _referred(self, declared: Mapping[str, str]) -> ET.Element | None:
        clip = self._elements.referred(declared.get("clip-path", "none"))
        return clip if clip is not None and tag_of(clip) == "clipPath" else None

    def _rings(
        self, part: ET.Element, matrix: FloatArray, viewport: Viewport, rule: str
    ) -> tuple[list[FloatArray], bool] | None:
        """Return the rings of a part in the plane, each (k, 4, 2), and whether two of them make a hole."""
        declared = self._elements.declared(part)
        if declared.get("display") == "none" or declared.get("visibility") in ("hidden", "collapse"):
            return [], False
        matrix, rule = _placed(matrix, part, declared), declared.get("clip-rule", rule)
        if tag_of(part) == "use":
            target = self._elements.used(part)
            if target is None or tag_of(target) not in SHAPES:
                return None
            x, y = (float(part.get(name) or 0.0) for name in ("x", "y")) if _is_plain(part) else (None, None)
            if x is None or y is None:
                return None
            declared = self._elements.declared(target)
            matrix = _placed(combined(matrix, np.array([[1.0, 0.0, x], [0.0, 1.0, y]])), target, declared)
            part, rule = target, declared.get("clip-rule", rule)
        if tag_of(part) not in SHAPES:
            return None
        rings = [moved(each.controls, matrix) for each in subpaths_of(part, viewport, None) if each.pieces]
        return rings, rule == "evenodd"

    def _together(self, parts: Sequence[tuple[list[FloatArray], bool] | None]) -> Clip | None:
        """Return the area of all parts; None where no one rule tells it."""
        known = [each for each in parts if each is not None]
        if len(known) < len(parts):
            return None
        known = [each for each in known if each[0]]
        evenodd = any(rings[1:] and is_evenodd for rings, is_evenodd in known)
        if len(known) > 1:
            if evenodd:
                return None
            # All to the left, so that none takes anything from another.
            known = [(_to_the_left(rings), False) for rings, _ in known]
        rings = [ring for each, _ in known for ring in each]
        sizes = [6 * len(ring) + 2 for ring in rings]
        if len(rings) > MOST_RINGS or max(sizes, default=0) > MOST_NUMBERS:
            return None
        if not all((np.abs(ring) <= MAX_MAGNITUDE).all() for ring in rings):
            return None
        return Clip(tuple(ring_of(_places(ring)) for ring in rings), evenodd)


def clip_of_box(box: Box, matrix: FloatArray) -> Clip:
    """Return a box of an element as a clip of the plane."""
    x, y, width, height = box
    corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)]
    ends = moved(np.array(corners), matrix)
    thirds = [ends[:-1] + share * np.diff(ends, axis=0) for share in (0.0, 1 / 3, 2 / 3)]
    return Clip((ring_of(_places(np.stack([*thirds, ends[1:]], axis=1))),))


def _places(pieces: FloatArray) -> list[tuple[float, float]]:
    rest = pieces[:, 1:].reshape(-1, 2)
    return [(x, y) for x, y in [pieces[0, 0].tolist(), *rest.tolist()]]


def _placed(matrix: FloatArray, element: ET.Element, declared: Mapping[str, str] | None = None) -> FloatArray:
    text = (declared or {}).get("transform", "none")
    text = element.get("transform", "") if text == "none" else text
    return combined(matrix, transform_of(text)) if text.strip() else matrix


def _is_plain(part: ET.Element) -> bool:
    """Whether x and y of an element are numbers without units."""
    try:
        return all(np.isfinite(float(part.get(name) or 0.0)) for name in ("x", "y"))
    except ValueError:
        return False


def _to_the_left(rings: list[FloatArray]) -> list[FloatArray]:
    """Return rings of one part the other way round if most of them runs to the right."""
    area = 0.0
    for ring in rings:
        x, y = (ring.reshape(-1, 2) - ring[0, 0]).T
        area += float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    return rings if area >= 0 else [ring[::-1, ::-1] for ring in rings]


def _hangs_on_box(clip: ET.Element) -> bool:
    """Whether a clip is a share of the box around what has it."""
    return clip.get("clipPathUnits") == "objectBoundingBox"


def _rectangle(subpaths: list[Subpath]) -> Box | None:
    if len(subpaths) != 1:
        return None
    controls = subpaths[0].controls
    ends = [tuple(point) for point in controls[:, 0].tolist()]
    steps = controls[:, 3] - controls[:, 0]
    # Four sides, each along an axis, and straight: all control points of each lie on it.
    is_upright = len(ends) == 4 and bool((np.count_nonzero(np.ptp(controls, axis=1), axis=1) == 1).all())
    if not is_upright or not np.array_equal(steps[:2], -steps[2:]):
        return None
    low, high = controls.min(axis=(0, 1)).tolist(), controls.max(axis=(0, 1)).tolist()
    return (low[0], low[1], high[0] - low[0], high[1] - low[1])
