"""Edits of several parameters at once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from app.document.edits import checked, freeze_parameters
from app.document.limits import not_after
from app.document.model import MAX_MAGNITUDE, Document


def set_parameters(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Make `parameters`, one for each knot, the manual parameters; their order must be that of the points."""
    if not _can_be_held(parameters):
        parameters = [checked(t, f"The t of point {index}") for index, t in enumerate(parameters)]
    for index, (before, after) in enumerate(pairwise(parameters), start=1):
        if not after > before:
            raise not_after(index, before)
    return freeze_parameters(document, curve, parameters)


def _can_be_held(numbers: Sequence[float]) -> bool:
    """Tell at once whether a document may hold all of these numbers."""
    return math.isfinite(sum(numbers)) and max(map(abs, numbers), default=0.0) <= MAX_MAGNITUDE
