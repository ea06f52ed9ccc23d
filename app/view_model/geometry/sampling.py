"""Parameters all along a curve with given knots, (k,): as many in every segment as a purpose needs."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, IntArray
from curvecore.parametrization import spread


def within_segments(knots: FloatArray, shares: FloatArray) -> FloatArray:
    """Return the parameters at these shares (m,) of every segment, (k - 1, m)."""
    result: FloatArray = knots[:-1, None] + np.diff(knots)[:, None] * shares
    return result


def all_along(knots: FloatArray, per_segment: int) -> FloatArray:
    """Return so many parameters of every segment, its knot the first of them, and the last knot."""
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
    """Parameters of which the last in every segment lies a hair before the knot: it counts to that segment.

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
    """Return the segment that holds `t`; at a knot the one after it, but at the last knot the one before."""
    return int(np.clip(np.searchsorted(knots, t, side="right") - 1, 0, len(knots) - 2))
