"""The pieces of the contours of several regions, in one array and of a size of about 1."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.bezier.arcs import Arcs
from curvecore.bezier.bernstein_algebra import derivative, sign_changes
from curvecore.scaling import SMALLEST
from curvecore.vectors import cross, vector_lengths

_SAME = 1e-10
"""Share of the size of a contour, and sine, up to which what is straight may be bent by roundings."""

FINEST = 2.0**-44
"""Share of the largest coordinate below which roundings hide what is there."""


class Outlines(NamedTuple):
    """All pieces of some contours.

    Attributes
    ----------
    exact : ndarray, shape (n, 4, 2)
        Their control points.
    controls : ndarray, shape (n, 4, 2)
        The same, moved and scaled: the largest is about 1.
    region : ndarray of int, shape (n,)
        The region that each is of.
    following : ndarray of int, shape (n,)
        The piece that goes on where each ends.
    middle : ndarray, shape (2,)
    size : float
        exact = middle + size * controls.
    """

    exact: FloatArray
    controls: FloatArray
    region: IntArray
    following: IntArray
    middle: FloatArray
    size: float

    @property
    def rounding(self) -> float:
        """What a place may be off by rounding alone, in units of `controls`."""
        return FINEST * float(np.abs(self.exact).max(initial=0.0)) / self.size


def closed_contour(contour: FloatArray) -> FloatArray:
    """Return a contour (k, 4, 2) with a straight line back to where it began, unless it is there."""
    start, end = contour[0, 0], contour[-1, 3]
    if (start == end).all():
        return contour
    return np.concatenate([contour, [straight_piece(end, start)]])


def straight_piece(start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the straight piece (4, 2) between two places, run through at an even pace."""
    steps = np.arange(4)[:, None] / 3.0
    piece: FloatArray = (1.0 - steps) * start + steps * end
    piece[3] = end
    return piece


def with_whole_lines(contour: FloatArray, stays: BoolArray | None = None) -> FloatArray:
    """Return a closed contour (k, 4, 2) in which straight pieces that go on in one line are one piece.

    Where the end of a piece `stays`, it does.
    """
    chord = contour[:, 3] - contour[:, 0]
    straight = _are_straight(contour)
    following, lengths = np.roll(chord, -1, axis=0), vector_lengths(chord)
    turn = np.abs(cross(chord, following)) / np.maximum(lengths * np.roll(lengths, -1), SMALLEST)
    goes_on = straight & np.roll(straight, -1) & (turn <= _SAME) & ((chord * following).sum(axis=1) > 0.0)
    if stays is not None:
        goes_on &= ~stays
    if not goes_on.any() or goes_on.all():
        return contour
    # From a joint that stays.
    first = int(np.argmin(goes_on)) + 1
    contour, goes_on = np.roll(contour, -first, axis=0), np.roll(goes_on, -first)
    last = np.flatnonzero(~goes_on)
    begin = np.append(0, last[:-1] + 1)
    whole = [
        straight_piece(contour[a, 0], contour[b, 3]) if b > a else contour[a]
        for a, b in zip(begin, last, strict=True)
    ]
    return np.stack(whole)


def without_specks(contour: FloatArray, length: float) -> FloatArray:
    """Return a closed contour (k, 4, 2) in which neighbouring pieces of a length together are a point.

    Their length is that of the polygon of their control points. The contour moves by less than that.
    """
    lengths = np.hypot(*np.diff(contour, axis=1).T).sum(axis=0)
    kept, left = np.ones(len(contour), dtype=bool), length
    # From the end of the longest piece, which stays.
    for place in np.roll(np.arange(len(contour)), -1 - int(np.argmax(lengths))).tolist():
        kept[place] = lengths[place] > left
        left = length if kept[place] else left - float(lengths[place])
    if kept.all() or kept.sum() < 2:
        return contour
    straight, found = _are_straight(contour)[kept], contour[kept]
    ahead = np.roll(np.arange(len(found)), -1)
    # A line keeps its direction where the piece on the other side bends.
    at = np.where((straight[ahead] & ~straight)[:, None], found[ahead, 0], found[:, 3])
    found[:, 2] += at - found[:, 3]
    found[ahead, 1] += at - found[ahead, 0]
    found[:, 3], found[ahead, 0] = at, at
    for place in np.flatnonzero(straight).tolist():
        found[place] = straight_piece(found[place, 0], found[place, 3])
    return found


def _are_straight(contour: FloatArray) -> BoolArray:
    """Tell which pieces run straight from one end to the other, at whatever pace."""
    chord = contour[:, 3] - contour[:, 0]
    size = float(np.ptp(contour.reshape(-1, 2), axis=0).max())
    lengths = np.maximum(vector_lengths(chord), SMALLEST)
    ways = contour[:, 1:3] - contour[:, :1]
    aside = np.abs(cross(ways, chord[:, None])) / lengths[:, None]
    along = (ways * chord[:, None]).sum(axis=2) / lengths[:, None]
    beyond = np.maximum(-along, along - lengths[:, None])
    straight: BoolArray = (np.maximum(aside, beyond) <= _SAME * size).all(axis=1)
    return straight


def outlines_of(regions: Sequence[Sequence[FloatArray]]) -> Outlines:
    """Return the pieces of the closed contours of regions, at least one piece in all."""
    contours = [contour for contours in regions for contour in contours]
    exact = np.concatenate(contours)
    counts = [sum(map(len, contours)) for contours in regions]
    following = np.arange(1, len(exact) + 1)
    ends = np.cumsum([len(contour) for contour in contours])
    following[ends - 1] = np.append(0, ends[:-1])
    flat = exact.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    middle = low + (high - low) / 2.0
    size = float((high - low).max()) or 1.0
    return Outlines(
        exact, (exact - middle) / size, np.repeat(np.arange(len(counts)), counts), following, middle, size
    )


def monotone_arcs(controls: FloatArray) -> Arcs:
    """Return the arcs between the places of pieces (n, 4, 2) where x or y turns back.

    They run from i to i + 1 in the measure that is i + t on piece i, in order.
    """
    slopes = derivative(controls)
    noise = 2.0**-50 * np.abs(controls).max(axis=(1, 2))
    turns = [sign_changes(slopes[:, :, axis], noise) for axis in (0, 1)]
    piece = np.concatenate([np.arange(len(controls)), *(each.piece for each in turns)])
    place = np.concatenate([np.zeros(len(controls)), *(each.place for each in turns)])
    start, _ = np.unique(piece + np.clip(place, 0.0, 1.0 - 2.0**-40), return_index=True)
    end = np.append(start[1:], float(len(controls)))
    piece = np.floor(start).astype(np.intp)
    # The end of the last arc of a piece is the piece's own.
    return Arcs(stretches(controls[piece], start - piece, end - piece), start, end)


def stretches(controls: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the control points (k, 4, 2) of pieces between two places each, by de Casteljau's scheme."""
    t, u = start[:, None, None], end[:, None, None]
    found = []
    for arguments in ((t, t, t), (t, t, u), (t, u, u), (u, u, u)):
        level = controls
        for each in arguments:
            level = (1.0 - each) * level[:, :-1] + each * level[:, 1:]
        found.append(level[:, 0])
    return np.stack(found, axis=1)


def stretch_of(pieces: FloatArray, start: float, end: float) -> FloatArray:
    """Return the stretch of a line between two places, in pieces from its beginning."""
    first, last = int(start), min(int(np.ceil(end)), len(pieces))
    found = pieces[first:last].copy()
    low, high = np.zeros(len(found)), np.ones(len(found))
    low[0], high[-1] = start - first, end - (last - 1)
    ends = np.array([0, len(found) - 1])
    found[ends] = stretches(found[ends], low[ends], high[ends])
    found[1:, 0] = found[:-1, 3]
    return found


def is_small(controls: FloatArray, size: float) -> BoolArray:
    """Tell which pieces (k, 4, 2) are not larger than that, along either axis."""
    result: BoolArray = np.ptp(controls, axis=1).max(axis=1) <= size
    return result
