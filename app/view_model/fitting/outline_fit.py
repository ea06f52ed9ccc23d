"""Closed outlines of many places as few cubic pieces, with corners and lines where they have such."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import radians
from typing import NamedTuple

import numpy as np

import curvecore
from curvecore import CurveError
from curvecore.arrays import FloatArray
from curvecore.fitting.joints import sharp_turns

from ...document.edits import EditError
from ...families import HERMITE

_TURN = radians(35.0)
"""Least turn of a corner."""

_REACH = 6.0
"""Places before and after a corner by which its turn is measured."""

_ROUNDED = 3
"""Places from a corner that a picture has rounded."""

_ACROSS = 0.2
"""Sine of the least angle at which two lines meet in a corner of theirs."""


class Line(NamedTuple):
    """The straight line through places.

    Attributes
    ----------
    middle, way
        A place on it, and its direction, of length 1.
    off
        How far the places are from it at most.
    """

    middle: FloatArray
    way: FloatArray
    off: float

    def meeting(self, other: Line) -> FloatArray | None:
        """Return where it meets another one; None where they run along each other."""
        ways = np.stack([self.way, -other.way], axis=1)
        if abs(np.linalg.det(ways)) < _ACROSS:
            return None
        share = np.linalg.solve(ways, other.middle - self.middle)[0]
        place: FloatArray = self.middle + share * self.way
        return place


def fitted_outline(
    places: FloatArray, tolerance: float, heard: Callable[[], object] = lambda: None
) -> FloatArray:
    """Return the closed pieces (k, 4, 2) near an outline (m, 2) whose places are a unit apart.

    It is `heard` now and then that the work goes on; what that raises ends it.

    Raises
    ------
    EditError
        If there are none.
    """
    around = np.append(places, places[:1], axis=0)
    corners = sharp_turns(around, _REACH, _TURN, closed=True) if len(places) > 4 * _REACH else []
    if not corners:
        return _fitted(places, tolerance, heard, closed=True)
    cuts = [*(corner - corners[0] for corner in corners), len(places)]
    around = np.roll(places, -corners[0], axis=0)
    around = np.append(around, around[:1], axis=0)
    runs = [around[start : end + 1].copy() for start, end in pairwise(cuts)]
    lines = [_line_through(run) for run in runs]
    straight = [line.off <= tolerance for line in lines]
    ends = [
        _corner(run[0], lines[k - 1], lines[k]) if straight[k - 1] and straight[k] else run[0]
        for k, run in enumerate(runs)
    ]
    pieces = list[FloatArray]()
    for run, is_straight, start, end in zip(runs, straight, ends, [*ends[1:], ends[0]], strict=True):
        run[0], run[-1] = start, end
        pieces.append(
            np.linspace(start, end, 4)[None] if is_straight else _fitted(run, tolerance, heard, closed=False)
        )
    return np.concatenate(pieces)


def _line_through(run: FloatArray) -> Line:
    """Return the line through a run between two corners, which it need not reach."""
    inner = run[_ROUNDED:-_ROUNDED] if len(run) > 4 * _ROUNDED else run
    middle = inner.mean(axis=0)
    way = np.linalg.svd(inner - middle, full_matrices=False)[2][0]
    off = np.abs((inner - middle) @ np.array([-way[1], way[0]])).max()
    return Line(middle, way, float(off))


def _corner(place: FloatArray, before: Line, after: Line) -> FloatArray:
    """Return where two lines meet, if that is what the picture has rounded there."""
    meeting = before.meeting(after)
    if meeting is None or np.hypot(*(meeting - place)) > _ROUNDED:
        return place
    return meeting


def _fitted(places: FloatArray, tolerance: float, heard: Callable[[], object], *, closed: bool) -> FloatArray:
    try:
        found = curvecore.fit(
            places,
            HERMITE.curve_class,
            tolerance=tolerance,
            closed=closed,
            with_corners=False,
            progress=lambda _share: heard(),
        )
    except CurveError as problem:
        raise EditError(f"An outline could not be fitted: {problem}.") from problem
    return curvecore.bezier_segments(found.curve)
