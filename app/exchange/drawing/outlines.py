"""Outlines: curves as the cubic Bézier pieces that pictures are made of."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from operator import attrgetter

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.style import PLAIN_STYLE, Style
from ...view_model.stroke_box import around_dot, extent_of, half_width, line_of, stroke_box, turns_within


class Outline(msgspec.Struct, frozen=True):
    """One curve as cubic Bézier pieces.

    Attributes
    ----------
    name
        The curve's name.
    control_points
        (k, 4, 2); a piece begins where the one before it ends.
    points
        The points that the curve goes through, or control points beside it, (n, 2).
    deviation, is_bound
        Largest distance from the true curve, zero where the curve is a chain of cubics itself; and whether it
        is nowhere more.
    closed
        Whether the last piece ends where the first begins, and goes on there.
    style
        Stroke and fill; its width is in the unit of the control points.
    shape, groups, visible, locked
        As in `Curve`.
    letters
        Of what kind each point is; see ``node_types``. None where pieces do not end at points.
    """

    name: str
    control_points: FloatArray
    points: FloatArray
    deviation: float
    closed: bool = False
    style: Style = PLAIN_STYLE
    shape: str = ""
    groups: tuple[str, ...] = ()
    visible: bool = True
    locked: bool = False
    letters: str = ""
    is_bound: bool = True

    @property
    def colour(self) -> str:
        """The paint that the curve is known by, "#rrggbb", or empty for the ink of the picture."""
        return self.style.colour

    @property
    def is_dot(self) -> bool:
        """Whether it is of no length."""
        return bool((self.control_points == self.control_points[0, 0]).all())


def painted_extent(outline: Outline) -> FloatArray:
    """Return the corners, (2, 2), of the box of a curve with its stroke: with its caps, joins and miters."""
    controls = outline.control_points
    if half_width(outline.style) == 0.0:
        return extent_of(controls)
    line = line_of(controls, turns_within(controls), is_closed=outline.closed)
    return around_dot(controls[0, 0], outline.style) if line is None else stroke_box(line, outline.style)


def by_shape(outlines: Iterable[Outline]) -> list[tuple[Outline, ...]]:
    """Return outlines that follow each other in one shape together, and the others each by itself."""
    return [
        each
        for shape, together in groupby(outlines, attrgetter("shape"))
        for each in ([tuple(together)] if shape else [(outline,) for outline in together])
    ]


def length_within(shape: Iterable[Outline]) -> float:
    """Return a length that no outline of a shape is longer than."""
    return float(sum(np.hypot(*np.diff(each.control_points, axis=1).T).sum() for each in shape))
