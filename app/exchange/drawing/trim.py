"""Drawings without a margin: at true size a picture is as large as what it shows."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.style import USUAL_WIDTH
from .drawing import Drawing
from .frames import Frame
from .outlines import painted_extent

_SLIMMEST = 0.02
"""Least ratio of the sides: what is slimmer, such as a level line, keeps room beside it."""


def trimmed(drawing: Drawing) -> Drawing:
    """Return a drawing whose frame is the box around its curves with their strokes."""
    low, high = _painted(drawing)
    middle, size = low + (high - low) / 2, high - low
    width, height = np.maximum(size, _SLIMMEST * size.max()).tolist()
    x, y = middle.tolist()
    return replace(drawing, frame=Frame(x - width / 2, y - height / 2, width, height))


def _painted(drawing: Drawing) -> tuple[FloatArray, FloatArray]:
    """Return the corners of the box around the curves of a drawing with their strokes."""
    boxes = np.array([painted_extent(each) for each in drawing.outlines])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    if any(each.style.has_stroke and each.style.width is None for each in drawing.outlines):
        # Of the longer side with these lines.
        reach = float((high - low).max()) * USUAL_WIDTH / (1 - USUAL_WIDTH) / 2
        low, high = low - reach, high + reach
    return low, high
