"""Hermite segments as Taylor expansions about the places where one of their functions vanishes.

Horner's rule in t minus such a place takes two operations a power and coordinate, and has the accuracy of the
factored functions of `hermite_basis` without their double-double arithmetic: see `vanishing_places`. What
needs more than 53 bits is only how far the double that stands for a place lies from it, which enters the
coefficients.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, IntArray, extremes
from curvecore.double_double import DoubleDouble, add, difference, multiply

if TYPE_CHECKING:
    from curvecore.bezier.vanishing_places import VanishingPlaces

_CHUNK = 12_288  # parameters at a time, so that the few working arrays stay in the second-level cache
_SHORT = 2.0**-50  # segments shorter, or data smaller, by powers of these could leave the range
_SMALL = 2.0**-500
_RUN = 8  # ascending parameters a piece, from which on it is the breaks that are sought among them
_FEW = 1000  # parameters, of which it does not pay to ask whether they ascend


class TaylorPieces(NamedTuple):
    """Polynomial pieces of one derivative of a curve, in t.

    Attributes
    ----------
    breaks : ndarray, shape (k - 1,)
        Where one piece ends and the next begins, ascending; a break belongs to the piece after it.
    origins : ndarray, shape (k,)
        What is subtracted from t.
    coefficients : tuple of ndarray, shape (k, dim)
        Highest power first.
    domain : tuple of float
        The beginning of the first and the end of the last piece.
    """

    breaks: FloatArray
    origins: FloatArray
    coefficients: tuple[FloatArray, ...]
    domain: tuple[float, float]

    def evaluate(self, t: FloatArray) -> FloatArray | None:
        """Return the values at parameters, (m, dim), m > 0; None where some lie outside the domain."""
        least, most = extremes(t)
        if least < self.domain[0] or most > self.domain[1]:
            return None
        result = np.empty((t.size, self.coefficients[0].shape[1]))
        ascend = t.size > _FEW and not np.count_nonzero(t[1:] < t[:-1])
        with np.errstate(under="ignore"):
            for first in range(0, t.size, _CHUNK):
                some = slice(first, first + _CHUNK)
                self._put(t[some], ascend, result[some])
        return result

    def _put(self, t: FloatArray, ascend: bool, result: FloatArray) -> None:
        """Write the values at parameters by Horner's rule."""
        gathered = self._gathering(t, ascend)
        highest, *lower = self.coefficients
        if not lower:
            result[:] = gathered(highest)
            return
        lowest = lower.pop()
        x = np.empty_like(result)
        np.subtract(t, gathered(self.origins), out=x[:, 0])
        # A copy for each coordinate costs less than arithmetic along a short axis.
        for k in range(1, x.shape[1]):
            x[:, k] = x[:, 0]
        value = gathered(highest)
        for each in lower:
            value *= x
            value += gathered(each)
        value *= x
        np.add(value, gathered(lowest), out=result)

    def _gathering(self, t: FloatArray, ascend: bool) -> Callable[[FloatArray], FloatArray]:
        """Return what makes of numbers for each piece, (k, ...), those for the pieces of parameters."""
        if ascend:
            first, last = (int(self.breaks.searchsorted(end, side="right")) for end in (t[0], t[-1]))
            breaks = self.breaks[first:last]
            if t.size >= _RUN * len(breaks):
                return _repetition(slice(first, last + 1), t, breaks)
            piece = _count_breaks(t, breaks) + first
        else:
            piece = self.breaks.searchsorted(t, side="right")
        return lambda numbers: numbers.take(piece, axis=0)


def _repetition(pieces: slice, t: FloatArray, breaks: FloatArray) -> Callable[[FloatArray], FloatArray]:
    """Return what repeats the numbers of pieces as often as ascending parameters lie on each of them."""
    counts = np.empty(len(breaks) + 1, dtype=np.intp)
    counts[:-1] = ends = t.searchsorted(breaks)
    counts[-1] = t.size
    counts[1:] -= ends
    return lambda numbers: numbers[pieces].repeat(counts, axis=0)


def _count_breaks(t: FloatArray, breaks: FloatArray) -> IntArray:
    """Return how many breaks are at most t, both ascending.

    NumPy's linear interpolation looks at the neighbours of its last interval first, and takes a quarter of
    the time of a search.
    """
    # Every interval ends a hair before the next break, so that no rounding leads into the next one.
    knots = np.empty(2 * len(breaks) - 1)
    knots[::2] = breaks
    np.subtract(breaks[1:], 2.0**-52 * np.abs(breaks[1:]), out=knots[1::2])
    if not (knots[1:] > knots[:-1]).all():
        return breaks.searchsorted(t, side="right")
    places: FloatArray = np.interp(t, knots, 1.0 + 0.5 * np.arange(len(knots)), left=0.0)
    return places.astype(np.intp)


def taylor_pieces(
    starts: FloatArray, ends: FloatArray, first: FloatArray, last: FloatArray, order: int
) -> TaylorPieces | None:
    """Expand the order-th derivative of segments; None where the numbers could leave the range of doubles.

    Parameters
    ----------
    starts, ends : ndarray, shape (k,)
        Parameters of the ends of segments, ascending.
    first, last : ndarray, shape (k, R, dim)
        Jets there.
    order : int
        From 0 to 2 R - 1.
    """
    from curvecore.bezier.vanishing_places import vanishing_places  # noqa: PLC0415 - 2 ms for fractions

    places = vanishing_places(first.shape[1], order)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        h = ends - starts
        data = _scaled_data(first, last, h)
        if not _in_range(h, data):
            return None
        coefficients = places.coefficients[:, None, :, 0, None] * data[0, :, None]
        for k, each in enumerate(data[1:], 1):
            coefficients += places.coefficients[:, None, :, k, None] * each[:, None]
        origins = _expand_at_doubles(coefficients, starts, ends, places)
        for power in range(len(coefficients)):
            for _ in range(order + power):
                coefficients[power] /= h[:, None, None]
        breaks = np.empty_like(origins)
        breaks[:, -1] = ends
        # What lies at a joint belongs to it, however short the segment.
        least = np.nextafter(starts, ends)[:, None]
        np.maximum(starts[:, None] + h[:, None] * places.cuts, least, out=breaks[:, :-1])
    rows = tuple(coefficients[::-1].reshape(-1, origins.size, first.shape[2]))
    domain = float(starts[0]), float(ends[-1])
    return TaylorPieces(breaks.ravel()[:-1], origins.ravel(), rows, domain)


def _in_range(h: FloatArray, data: FloatArray) -> bool:
    """Whether no product or quotient of lengths of segments and their data will leave the range."""
    sizes = np.abs(data)
    least = np.where(sizes > 0.0, sizes, 1.0).min()
    lengths_serve = h.min() >= _SHORT and h.max() <= 1.0 / _SHORT
    return bool(lengths_serve and least >= _SMALL and sizes.max() <= 1.0 / _SMALL)


def _scaled_data(first: FloatArray, last: FloatArray, h: FloatArray) -> FloatArray:
    """Return the data of both ends of segments, with derivatives by the local s, (2 R, k, dim)."""
    width = first.shape[1]
    data = np.concatenate([first.swapaxes(0, 1), last.swapaxes(0, 1)])
    for k in range(1, width):
        for _ in range(k):
            data[k::width] *= h[:, None]
    return data


def _expand_at_doubles(
    coefficients: FloatArray, starts: FloatArray, ends: FloatArray, places: VanishingPlaces
) -> FloatArray:
    """Turn polynomials in s minus a place, (K, k, P, dim), into those about the double nearest to it.

    Returns these doubles, (k, P).
    """
    joints = np.stack([starts, ends])[:, :, None]
    h = joints[1] - joints[0]
    origins: FloatArray = joints[0] + h * places.places
    origins[:, places.places == 1.0] = joints[1]
    inner = places.inner
    if inner.size and len(coefficients) > 1:
        near = origins[:, inner]
        # How far that lies behind the place, from exact distances: for some, by less than a rounding.
        high, low = multiply(difference(near, joints), places.shares)
        behind = add(DoubleDouble(high[0], low[0]), DoubleDouble(high[1], low[1]))
        exact = difference(near, behind.high)
        origins[:, inner] = exact.high
        _shift(coefficients, inner, (behind.low - exact.low) / h)
    return origins


def _shift(coefficients: FloatArray, inner: IntArray, offsets: FloatArray) -> None:
    """Make polynomials in s, (K, k, P, dim), at some places those in s minus an offset, (k, places)."""
    some = coefficients[:, :, inner]
    for lowest in range(len(some) - 1):
        for power in range(len(some) - 2, lowest - 1, -1):
            some[power] += offsets[..., None] * some[power + 1]
    coefficients[:, :, inner] = some
