"""Groups that are seen through among the shapes of a drawing."""

from __future__ import annotations

from collections.abc import Iterable

from ...document.group_look import GroupLook, together
from .outlines import Outline

Unit = tuple[GroupLook | None, list[tuple[Outline, ...]]]
"""A shape, or the look and the shapes of a group that is seen through."""


def units_of(shapes: Iterable[tuple[Outline, ...]], depth: int) -> list[Unit]:
    """Return what is painted as one of shapes in so many groups that are seen through."""
    runs = together(shapes, lambda shape: shape[0].group_looks, depth)
    return [
        unit
        for look, run in runs
        for unit in ([(look, run)] if look is not None else [(None, [shape]) for shape in run])
    ]
