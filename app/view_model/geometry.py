"""Geometry of the plane without curves of a document.

Points and vectors are arrays (k, 2). Three subjects, in this order: sizes and directions of vectors;
parameters along a curve with given knots, as many in every segment as a purpose needs; insides of outlines.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from curvecore.arithmetic import vector_lengths
from curvecore.arrays import FloatArray, IntArray
from curvecore.parametrization import spread

from ..document.style import FillRule


def size_of(points: FloatArray) -> float:
    """Return the larger side of the box around points, at least one."""
    return float(np.ptp(points, axis=0).max())


def polygon_length(points: FloatArray) -> float:
    """Return the length of the polygon through points (n, 2)."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def at_knots(points: FloatArray, *, closed: bool) -> FloatArray:
    """Return the rows of points (n, …) at the knots of their curve: a closed one ends with the first row."""
    return np.vstack([points, points[:1]]) if closed else points


def unit_tangents(velocities: FloatArray) -> FloatArray:
    """Return vectors (m, 2) of length 1 in the same directions, zero for zero."""
    lengths = vector_lengths(velocities)
    return velocities / np.where(lengths > 0, lengths, 1.0)[:, None]


def to_the_left(vectors: FloatArray) -> FloatArray:
    """Return vectors (m, 2) turned to the left by a right angle."""
    return np.column_stack([-vectors[:, 1], vectors[:, 0]])


def usual_length(vectors: FloatArray, longest: float) -> float:
    """Return the length that nine tenths of the vectors keep, or the longest if that is not far above.

    One huge vector, at a cusp for instance, must not make all others invisible.
    """
    with np.errstate(over="ignore"):
        lengths = np.hypot(vectors[:, 0], vectors[:, 1])
    lengths = lengths[np.isfinite(lengths)]
    if not len(lengths):
        return 0.0
    usual = float(np.quantile(lengths, 0.9, method="lower"))
    return min(float(lengths.max()), longest * usual) if usual > 0 else float(lengths.max())


# Parameters along a curve


def within_segments(knots: FloatArray, shares: FloatArray) -> FloatArray:
    """Return the parameters at these shares (m,) of every segment, (k - 1, m)."""
    return knots[:-1, None] + np.diff(knots)[:, None] * shares


def all_along(knots: FloatArray, per_segment: int) -> FloatArray:
    """Return `per_segment` parameters of every segment, its first knot included, and the last knot."""
    shares = np.arange(per_segment) / per_segment
    return np.append(within_segments(knots, shares).ravel(), knots[-1])


def crowded_at_ends(start: float, end: float, count: int) -> FloatArray:
    """Return parameters from `start` to `end`, closer at both ends, where a polynomial swings most."""
    return spread(_crowded_shares(count), start, end)


@lru_cache(maxsize=4)
def _crowded_shares(count: int) -> FloatArray:
    u = np.linspace(0.0, 1.0, count)
    shares: FloatArray = 0.5 * u + 0.5 * np.sin(0.5 * np.pi * u) ** 2
    shares.flags.writeable = False
    return shares


class Samples(NamedTuple):
    """A curve at some parameters (m,): its points and its first and second derivatives there, (m, 2) each."""

    parameters: FloatArray
    points: FloatArray
    velocities: FloatArray
    accelerations: FloatArray


class OneSided(NamedTuple):
    """Parameters of which the last in every segment lies just before the knot, and belongs to that segment.

    Attributes
    ----------
    t
        The parameters (m,).
    first
        The index of the first one of each segment, and the end, (k,).
    """

    t: FloatArray
    first: IntArray


def one_sided(knots: FloatArray, counts: IntArray) -> OneSided:
    """Return `counts` (k - 1,) parameters of the segments, both ends of each included."""
    spacing = np.diff(knots)
    first = np.concatenate([[0], np.cumsum(counts)])
    segment = np.repeat(np.arange(len(spacing)), counts)
    shares = (np.arange(first[-1]) - first[segment]) / (counts[segment] - 1)
    t = knots[segment] + shares * spacing[segment]
    t[first[1:] - 1] = np.nextafter(knots[1:], knots[:-1])
    t[-1] = knots[-1]
    return OneSided(t, first)


def segment_at(knots: FloatArray, t: float) -> int:
    """Return the segment of `t`; at a knot the one after it, but at the last knot the one before."""
    return int(np.clip(np.searchsorted(knots, t, side="right") - 1, 0, len(knots) - 2))


# Insides of outlines

_PROBES = 24
"""Points of an outline that are tested for lying within the others."""


def windings(outlines: Sequence[FloatArray], points: FloatArray) -> npt.NDArray[np.int64]:
    """Return winding numbers of outlines (k, 2), closed by straight lines, around points (m, 2)."""
    turns = np.zeros(len(points), dtype=np.int64)
    for outline in outlines:
        starts, ends = outline, np.roll(outline, -1, axis=0)
        along = ends - starts
        above = starts[:, 1] <= points[:, 1:]
        rises = above & (ends[:, 1] > points[:, 1:])
        falls = ~above & (ends[:, 1] <= points[:, 1:])
        # The side of each line on which the points lie; ignored where it does not cross their height.
        side = along[:, 0] * (points[:, 1:] - starts[:, 1]) - along[:, 1] * (points[:, :1] - starts[:, 0])
        turns += (rises & (side > 0)).sum(axis=1) - (falls & (side < 0)).sum(axis=1)
    return turns


def is_inside(turns: npt.NDArray[np.int64], rule: FillRule) -> npt.NDArray[np.bool_]:
    """Return the mask of points inside, given the winding numbers around them."""
    return np.asarray(turns != 0 if rule is FillRule.NONZERO else turns % 2 == 1)


def fills_holes(outlines: Sequence[FloatArray]) -> bool:
    """Whether the nonzero rule fills holes of the even-odd rule: an outline within another.

    It does where both run in the same direction.
    """
    low, high = (np.array([ends(outline, axis=0) for outline in outlines]) for ends in (np.min, np.max))
    for index, outline in enumerate(outlines):
        # An outline winds around nothing outside of its box: of thousands few are tested.
        near = np.flatnonzero(((low <= high[index]) & (low[index] <= high)).all(axis=1)).tolist()
        others = [outlines[other] for other in near if other != index]
        around = windings(others, outline[:: max(1, len(outline) // _PROBES)])
        # Where it crosses the others it lies in none of them.
        if len(set(around.tolist())) == 1 and around[0] % 2 == 1 and around[0] + _turn(outline) != 0:
            return True
    return False


def _turn(outline: FloatArray) -> int:
    """Return 1 for an outline that runs to the left around its inside, −1 for one to the right."""
    x, y = (outline - outline[0]).T
    return 1 if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0 else -1
