"""Hermite segments as Taylor expansions about the places where one of their functions vanishes.

Horner's rule in t minus such a place takes two operations a power and coordinate, and has the accuracy of the
factored functions of `hermite_basis` without their double-double arithmetic: see `vanishing_places`. What
needs more than 53 bits is only how far the double that stands for a place lies from it, which enters the
coefficients.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, IntArray, extremes
from curvecore.double_double import DoubleDouble, add, difference, multiply

if TYPE_CHECKING:
    from curvecore.bezier.vanishing_places import VanishingPlaces

_CHUNK = 12_288  # parameters at a time, so that the working arrays stay in the second-level cache
_SHORT = 2.0**-50  # segments shorter, or data smaller, by powers of these could leave the range
_SMALL = 2.0**-500
_FEW = 300  # parameters, of which it does not pay to ask whether they ascend
_LONG = 4000  # the same, of less than so many a piece
_RUN = 2  # ascending parameters a piece, from which on it is the ends that are sought among them


class TaylorPieces(NamedTuple):
    """Polynomial pieces of one derivative of a curve, in t.

    Attributes
    ----------
    ends : ndarray, shape (k,)
        The first double behind each piece, ascending.
    numbers : ndarray, shape (K + 1, dim, k)
        Coefficients, the highest power first; then, unless there is but one, what is subtracted from t, for
        each coordinate again: arithmetic of NumPy's is the fastest of arrays of one shape.
    domain : tuple of float
        The beginning of the first and the end of the last piece.
    """

    ends: FloatArray
    numbers: FloatArray
    domain: tuple[float, float]

    def evaluate(self, t: FloatArray) -> FloatArray | None:
        """Return the values at parameters, (m, dim), m > 0; None where some are not inside the domain.

        In memory one coordinate follows the other.
        """
        is_few = t.size <= _FEW or t.size < min(_RUN * self.ends.size, _LONG)
        values = self._few_values if is_few else self._many_values
        try:
            return values(t)
        except IndexError:  # There is no piece behind the last one.
            return None
        except FloatingPointError:
            # Where errors are asked for: to keep them off beforehand takes as long as a power of t.
            with np.errstate(under="ignore"):
                return values(t)

    def _few_values(self, t: FloatArray) -> FloatArray | None:
        if not t.item(t.argmin()) >= self.domain[0]:
            return None
        return _polynomials(self.numbers.take(self.ends.searchsorted(t, "right"), 2), t).T

    def _many_values(self, t: FloatArray) -> FloatArray | None:
        ascend = np.count_nonzero(t[1:] >= t[:-1]) == t.size - 1
        least, most = (t.item(0), t.item(-1)) if ascend else extremes(t)
        if not (least >= self.domain[0] and most <= self.domain[1]):
            return None
        if t.size <= _CHUNK:
            return _polynomials(self._gathered(t, ascend), t).T
        result = np.empty((self.numbers.shape[1], t.size))
        for first in range(0, t.size, _CHUNK):
            some = slice(first, first + _CHUNK)
            result[:, some] = _polynomials(self._gathered(t[some], ascend), t[some])
        return result.T

    def _gathered(self, t: FloatArray, ascend: bool) -> FloatArray:
        """Return the numbers of the pieces that hold parameters, (K + 1, dim, m)."""
        if not ascend:
            return self.numbers.take(self.ends.searchsorted(t, "right"), 2)
        ends, numbers = self.ends, self.numbers
        if t.size < _RUN * len(ends):
            first, last = (int(ends.searchsorted(end, "right")) for end in (t.item(0), t.item(-1)))
            ends, numbers = ends[first : last + 1], numbers[:, :, first : last + 1]
        if t.size >= _RUN * len(ends):
            counts = t.searchsorted(ends)
            counts[1:] -= counts[:-1].copy()
            return numbers.repeat(counts, 2)
        return numbers.take(_count_breaks(t, ends[:-1]), 2)


def _polynomials(numbers: FloatArray, t: FloatArray) -> FloatArray:
    """Return polynomials at parameters, (dim, m), by Horner's rule; the numbers are overwritten."""
    value: FloatArray = numbers[0]
    last = len(numbers) - 1
    if last:
        x = t - numbers[last]
        for k in range(1, last):
            value *= x
            value += numbers[k]
    return value


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
        cuts = np.empty_like(origins)
        cuts[:, -1] = ends
        # What lies at a joint belongs to it, however short the segment.
        least = np.nextafter(starts, ends)[:, None]
        np.maximum(starts[:, None] + h[:, None] * places.cuts, least, out=cuts[:, :-1])
        cuts[-1, -1] = np.nextafter(ends[-1], np.inf)
    numbers = coefficients[::-1].reshape(-1, origins.size, first.shape[2]).swapaxes(1, 2)
    if len(numbers) > 1:
        numbers = np.concatenate([numbers, np.broadcast_to(origins.ravel(), (1, *numbers.shape[1:]))])
    return TaylorPieces(cuts.ravel(), np.ascontiguousarray(numbers), (float(starts[0]), float(ends[-1])))


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
