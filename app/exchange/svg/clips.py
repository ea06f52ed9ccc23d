"""Clip paths that are no more than an upright rectangle: programs put one around all that they draw."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping

import numpy as np

from ..errors import ExchangeError
from .lengths import Viewport
from .matrices import Box
from .path_data import Subpath
from .shapes import SHAPES, subpaths_of
from .xml_tree import reference_of, tag_of

_REFERENCE = re.compile(r"url\(\s*['\"]?#([^'\")]*)['\"]?\s*\)")


def clip_box(value: str, by_id: Mapping[str, ET.Element], viewport: Viewport) -> Box | None:
    """Return the rectangle that a `clip-path` refers to; None for every other value."""
    match = _REFERENCE.fullmatch(value.strip())
    clip = by_id.get(match[1]) if match else None
    if clip is None or tag_of(clip) != "clipPath" or clip.get("clipPathUnits") == "objectBoundingBox":
        return None
    parts = [each for each in clip if tag_of(each) in (*SHAPES, "use", "g", "text")]
    if len(parts) != 1:
        return None
    part = parts[0]
    if tag_of(part) == "use" and not (part.get("x") or part.get("y")):
        part = by_id.get(reference_of(part).removeprefix("#"), part)
    if tag_of(part) not in SHAPES or any(each.get("transform") for each in (clip, parts[0], part)):
        return None
    try:
        return _rectangle(subpaths_of(part, viewport, None))
    except ExchangeError:
        return None


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
