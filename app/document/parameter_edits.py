"""Edits of several parameters at once."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from app.document.edits import checked, freeze_parameters
from app.document.limits import not_after
from app.document.model import Document


def set_parameters(document: Document, curve: int, parameters: Sequence[float]) -> Document:
    """Make `parameters`, one for each knot, the manual parameters; their order must be that of the points."""
    parameters = [checked(t, f"The t of point {index}") for index, t in enumerate(parameters)]
    for index, (before, after) in enumerate(pairwise(parameters), start=1):
        if not after > before:
            raise not_after(index, before)
    return freeze_parameters(document, curve, parameters)
