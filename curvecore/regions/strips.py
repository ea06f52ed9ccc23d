"""Strips around cubic pieces, between offset curves to their left and right.

An offset curve is followed by cubic pieces with its own tangents at their
ends [1]_, which pass its middle; they are halved until they keep a tolerance.

References
----------
.. [1] W. Tiller and E. G. Hanson, "Offsets of two-dimensional profiles", IEEE
   Computer Graphics and Applications 4 (1984) 36-46.
"""

from __future__ import annotations

import math

import numpy as np

from curvecore.arrays import BoolArray, FloatArray
from curvecore.bezier.bernstein_algebra import derivative, values
from curvecore.regions.outlines import monotone_arcs, straight_piece
from curvecore.scaling import SMALLEST
from curvecore.vectors import cross, vector_lengths

_ROUNDS = 14
_SAMPLES = (np.arange(9) + 0.5) / 9.0
_MOST_STRETCHED = 0.5
"""Share by which handles may be longer or shorter than velocities have them."""

_INSIDE = 1e-6
"""Share of a piece at its ends where its normal is taken not to turn: it may be at rest there."""


def strips_of(pieces: FloatArray, half: float, tolerance: float) -> tuple[list[FloatArray], list[FloatArray]]:
    """Return strips around stretches of pieces, to the left of their contours, and those that fold."""
    arcs = monotone_arcs(pieces).controls
    arcs = arcs[(arcs != arcs[:, :1]).any(axis=(1, 2))]
    which, low, high = np.arange(len(arcs)), np.zeros(len(arcs)), np.ones(len(arcs))
    plain, folded = list[FloatArray](), list[FloatArray]()
    for step in range(_ROUNDS):
        sides = [_followed(arcs[which], low, high, side * half) for side in (-1.0, 1.0)]
        off = np.maximum(
            *(
                _deviation(arcs[which], low, high, each, side * half)
                for each, side in zip(sides, (-1.0, 1.0), strict=True)
            )
        )
        fine = off <= (tolerance if step < _ROUNDS - 1 else math.inf)
        folds = _folds(arcs[which], low, high, half)
        for place in np.flatnonzero(fine).tolist():
            right, left = (each[place] for each in sides)
            strip = np.stack(
                [right, straight_piece(right[3], left[3]), left[::-1], straight_piece(left[0], right[0])]
            )
            (folded if folds[place] else plain).append(strip)
        which, low, high = which[~fine], low[~fine], high[~fine]
        if not len(which):
            break
        middle = (low + high) / 2.0
        which = np.concatenate([which, which])
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
    return plain, folded


def normals(arcs: FloatArray, at: FloatArray) -> FloatArray:
    """Return the unit vectors to the left of arcs (k, 4, 2) at places (k,)."""
    slope = values(derivative(arcs), at)
    at_rest = vector_lengths(slope) <= 2.0**-40 * np.abs(arcs - arcs[:, :1]).max(axis=(1, 2))
    if at_rest.any():
        inner = np.clip(at[at_rest], _INSIDE, 1.0 - _INSIDE)
        slope[at_rest] = values(derivative(arcs[at_rest]), inner)
    slope /= np.maximum(vector_lengths(slope), SMALLEST)[:, None]
    return np.stack((-slope[:, 1], slope[:, 0]), axis=1)


def _bends(arcs: FloatArray, at: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the velocities of arcs and their curvature at places just inside."""
    inner = np.clip(at, _INSIDE, 1.0 - _INSIDE)
    first = derivative(arcs)
    slope, turn = values(first, inner), values(derivative(first), inner)
    speed = np.maximum(vector_lengths(slope), SMALLEST)
    with np.errstate(all="ignore"):
        bend = np.nan_to_num(cross(slope, turn) / speed**3)
    return slope, bend


def _followed(arcs: FloatArray, low: FloatArray, high: FloatArray, aside: float) -> FloatArray:
    """Return cubic pieces (k, 4, 2) that follow what runs beside stretches, with its tangents.

    They pass its middle where handles of some length do that, and else have its velocities.
    """
    ends, handles = [], []
    step = ((high - low) / 3.0)[:, None]
    for at in (low, high):
        slope, bend = _bends(arcs, at)
        aside_of, speed = normals(arcs, at), vector_lengths(slope)
        ends.append(values(arcs, at) + aside * aside_of)
        # The offset curve is run through 1 - κ d as fast.
        way = np.stack((aside_of[:, 1], -aside_of[:, 0]), axis=1)
        handles.append(step * way * (speed * (1.0 - aside * bend))[:, None])
    middle = _beside(arcs, (low + high) / 2.0, aside)
    wanted = (8.0 * middle - 4.0 * (ends[0] + ends[1])) / 3.0
    turn = cross(*handles)
    with np.errstate(all="ignore"):
        shares = np.stack((cross(wanted, handles[1]), cross(wanted, handles[0])), axis=1) / turn[:, None]
    usable = (np.abs(shares - 1.0) <= _MOST_STRETCHED).all(axis=1, keepdims=True)
    shares = np.where(usable, shares, 1.0)
    return np.stack(
        (ends[0], ends[0] + shares[:, :1] * handles[0], ends[1] - shares[:, 1:] * handles[1], ends[1]), axis=1
    )


def _beside(arcs: FloatArray, at: FloatArray, aside: float) -> FloatArray:
    return values(arcs, at) + aside * normals(arcs, at)


def _deviation(
    arcs: FloatArray, low: FloatArray, high: FloatArray, pieces: FloatArray, aside: float
) -> FloatArray:
    """Return how far pieces are from what they follow, measured at feet on that."""
    worst = np.zeros(len(arcs))
    for share in _SAMPLES:
        at = low + share * (high - low)
        found = values(pieces, np.full(len(arcs), share))
        for _ in range(2):
            slope, bend = _bends(arcs, at)
            way = slope * (1.0 - aside * bend)[:, None]
            gap = found - _beside(arcs, at, aside)
            with np.errstate(all="ignore"):
                step = np.nan_to_num((gap * way).sum(axis=1) / np.square(way).sum(axis=1))
            at = np.clip(at + step, low, high)
        worst = np.maximum(worst, np.hypot(*(found - _beside(arcs, at, aside)).T))
    return worst


def _folds(arcs: FloatArray, low: FloatArray, high: FloatArray, half: float) -> BoolArray:
    tightest = np.zeros(len(arcs))
    for share in (0.0, *_SAMPLES, 1.0):
        tightest = np.maximum(tightest, np.abs(_bends(arcs, low + share * (high - low))[1]))
    folds: BoolArray = tightest * half >= 0.999
    return folds
