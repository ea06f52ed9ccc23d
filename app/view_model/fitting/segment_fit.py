"""One segment in the place of a piece of curve: with its directions at the ends, and as near as can be.

The lengths of the handles, and derivatives of higher orders, are unknowns of a linear least-squares problem
for given parameters of places along the piece; these move to the feet of their perpendiculars, and so on, as
in P. J. Schneider, "An algorithm for automatically fitting digitized curves", Graphics Gems, Academic Press
1990, 612-626.
"""

from __future__ import annotations

import math

import numpy as np

from curvecore.arrays import FloatArray

from ...families import Family
from ..curve.curve_view import ParametricCurve

_ROUNDS = 24
_STEPS = 6
"""Steps of Newton's to the feet of perpendiculars."""

_LEAST = 1e-3
"""Share of the chord below which a length is none: the curve would stop there."""


def segment_near(family: Family, places: FloatArray, directions: FloatArray) -> FloatArray:
    """Return the jets, (2, R, 2), of the segment over [0, 1] that is near to all `places` (m, 2).

    `directions` are those at its ends, (2, 2), of length one.
    """
    steps = np.hypot(*np.diff(places, axis=0).T)
    length = float(steps.sum())
    u = np.concatenate([[0.0], np.cumsum(steps)]) / length
    best, least = _thirds(family, places, directions, length), math.inf
    for _ in range(_ROUNDS):
        jets = _solved(family, places, directions, u, length)
        curve = family.curve_class.from_jets(jets, np.array([0.0, 1.0]))
        u = _feet(curve, places, u, 0.0, 1.0)
        away = _largest(curve.evaluate(u) - places)
        if away < least:
            best, least = jets, away
    return best


def farthest(curve: ParametricCurve, places: FloatArray, start: float, end: float) -> float:
    """Return how far places (m, 2) are from a curve between two parameters, at which first and last lie."""
    t = np.linspace(start, end, 4 * len(places))
    apart = places[:, None] - curve.evaluate(t)[None]
    feet = t[np.argmin(np.einsum("mnd,mnd->mn", apart, apart), axis=1)]
    for _ in range(_STEPS):
        feet = _feet(curve, places, feet, start, end)
    return _largest(curve.evaluate(feet) - places)


def _largest(ways: FloatArray) -> float:
    return float(np.hypot(ways[:, 0], ways[:, 1]).max())


def _thirds(family: Family, places: FloatArray, directions: FloatArray, length: float) -> FloatArray:
    """Return jets of a segment that is run through at an even pace."""
    jets = np.zeros((2, family.derivatives + 1, 2))
    jets[:, 0], jets[:, 1] = places[[0, -1]], length * directions
    return jets


def _solved(
    family: Family, places: FloatArray, directions: FloatArray, u: FloatArray, length: float
) -> FloatArray:
    """Return the jets of the segment that is nearest to the places at the parameters `u`."""
    jets = _thirds(family, places, directions, length)
    functions = family.curve_class.from_jets(jets, np.array([0.0, 1.0])).basis(u)
    rest = places - functions[:, :, 0] @ jets[:, 0]
    # Columns: the two speeds, then x and y of each higher derivative at each end; rows: x, then y.
    speeds = np.stack([np.outer(directions[end], functions[:, end, 1]).ravel() for end in (0, 1)], axis=1)
    higher = functions[:, :, 2:].reshape(len(u), -1)
    free = np.kron(np.eye(2), higher)
    found = np.linalg.lstsq(np.hstack([speeds, free]), rest.T.ravel(), rcond=None)[0]
    if found[:2].min() < _LEAST * length:
        return jets
    jets[:, 1] = found[:2, None] * directions
    jets[:, 2:] = np.moveaxis(found[2:].reshape(2, 2, -1), 0, -1)
    return jets


def _feet(curve: ParametricCurve, places: FloatArray, u: FloatArray, start: float, end: float) -> FloatArray:
    """Return parameters nearer to the feet of the perpendiculars from places to a curve; the ends stay."""
    away, velocity, bend = curve.evaluate(u) - places, curve.evaluate(u, 1), curve.evaluate(u, 2)
    slope = (away * velocity).sum(axis=1)
    rise = (velocity * velocity).sum(axis=1) + (away * bend).sum(axis=1)
    step = np.divide(slope, rise, out=np.zeros_like(u), where=rise > 0.0)
    furthest = 0.1 * (end - start)
    moved = np.clip(u - np.clip(step, -furthest, furthest), start, end)
    moved[[0, -1]] = start, end
    there = curve.evaluate(moved) - places
    is_nearer = (there * there).sum(axis=1) < (away * away).sum(axis=1)
    nearer: FloatArray = np.where(is_nearer, moved, u)
    return nearer
