"""Hermite segments as Taylor expansions about the parameters where one of their functions vanishes.

Horner's rule in t minus such a parameter takes two operations a power and coordinate, and has the accuracy of
the factored functions of ``hermite_basis`` without their double-double arithmetic: see ``hermite_roots``.
What needs more than 53 bits is only how far the double that stands for a root lies from it, which enters the
coefficients.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

from curvecore.arithmetic import DoubleDouble, add, difference, multiply
from curvecore.arrays import FloatArray, IntArray, extremes

if TYPE_CHECKING:
    from curvecore.bezier.hermite_roots import ExpansionPoints

_CHUNK = 12_288  # parameters at a time, so that the working arrays stay in the second-level cache
_SHORT = 2.0**-50  # segments shorter, or data smaller, by powers of these could leave the range
_SMALL = 2.0**-500
_FEW = 300  # parameters, of which it does not pay to ask whether they ascend
_ENDS = 250  # ends that are sought among ascending parameters, rather than the piece of each parameter,
_RUN = 11  # and parameters for every further end: to seek one takes as long as to find so many pieces
_INTERVALS = 4  # a piece, by which it is found


class PieceIntervals(NamedTuple):
    """Equal intervals of t, by which pieces are found without a search.

    No processor predicts the branches of a binary search for parameters in arbitrary order, so that it takes
    several times as long as all arithmetic. The interval that holds t says how many ends lie before it, and
    seldom holds more than one end itself.

    Attributes
    ----------
    ends : ndarray, shape (k,)
        The first double behind each piece, ascending.
    before : ndarray of int, shape (j,)
        How many of them lie in the intervals before each.
    start, scale : float
        The interval of t is floor((t - start) * scale).
    """

    ends: FloatArray
    before: IntArray
    start: float
    scale: float

    @classmethod
    def of(cls, ends: FloatArray, start: float) -> PieceIntervals:
        """Return the intervals from the beginning of the first piece on."""
        scale = _INTERVALS * ends.size / (ends.item(-1) - start)
        counts = np.bincount(((ends - start) * scale).astype(np.intp))
        return cls(ends, np.concatenate([[0], counts.cumsum()]), start, scale)

    def find(self, t: FloatArray) -> IntArray:
        """Return the index of the piece that holds each t, (m,), inside the domain."""
        # Whatever is rounded, a greater t is never in an earlier interval: all ends in earlier intervals are
        # less than t, all in later ones greater. Those in its own are compared with t, so that this is exact.
        x = t - self.start
        x *= self.scale
        piece: IntArray = self.before.take(x.astype(np.intp))
        piece += t >= self.ends.take(piece)
        others = np.flatnonzero(t >= self.ends.take(piece))
        piece[others] = self.ends.searchsorted(t[others], "right")
        return piece


class TaylorPieces(NamedTuple):
    """Polynomial pieces of one derivative of a curve, in t.

    Attributes
    ----------
    intervals : PieceIntervals
        Where they are.
    numbers : ndarray, shape (K + 1, dim, k)
        Coefficients, the highest power first; then, unless there is but one, what is subtracted from t, for
        each coordinate again: arithmetic of NumPy's is the fastest of arrays of one shape.
    rows : ndarray, shape (K + 1, k, dim)
        The same numbers, of which those of all coordinates are gathered at once, in half the time.
    domain : tuple of float
        The beginning of the first and the end of the last piece.
    """

    intervals: PieceIntervals
    numbers: FloatArray
    rows: FloatArray
    domain: tuple[float, float]

    @classmethod
    def of(cls, intervals: PieceIntervals, numbers: FloatArray, domain: tuple[float, float]) -> Self:
        """Return the pieces with these numbers."""
        return cls(intervals, numbers, np.ascontiguousarray(numbers.swapaxes(1, 2)), domain)

    def evaluate(self, t: FloatArray) -> FloatArray | None:
        """Return the values at parameters, (m, dim), m > 0; None where some are not inside the domain."""
        values = self._few_values if t.size <= _FEW else self._many_values
        try:
            return values(t)
        except IndexError:  # There is no piece behind the last one.
            return None
        except FloatingPointError:
            # Where errors are asked for: to keep them off beforehand takes as long as a power of t.
            with np.errstate(under="ignore"):
                return values(t)

    @staticmethod
    def _values(numbers: FloatArray, t: FloatArray) -> FloatArray:
        """Return polynomials by Horner's rule, shaped as ``numbers[0]``; the numbers are overwritten."""
        value: FloatArray = numbers[0]
        last = len(numbers) - 1
        if last:
            x = numbers[last]
            np.subtract(t, x, x)
            for k in range(1, last):
                value *= x
                value += numbers[k]
        return value

    def _few_values(self, t: FloatArray) -> FloatArray | None:
        if not t.item(t.argmin()) >= self.domain[0]:
            return None
        return self._values(self.numbers.take(self.intervals.ends.searchsorted(t, "right"), 2), t).T

    def _many_values(self, t: FloatArray) -> FloatArray | None:
        ascend = np.count_nonzero(t[1:] >= t[:-1]) == t.size - 1
        least, most = (t.item(0), t.item(-1)) if ascend else extremes(t)
        if not (least >= self.domain[0] and most <= self.domain[1]):
            return None
        if t.size <= _CHUNK:
            return self._values_inside(t, ascend)
        result = np.empty((self.numbers.shape[1], t.size)).T
        for first in range(0, t.size, _CHUNK):
            some = slice(first, first + _CHUNK)
            result[some] = self._values_inside(t[some], ascend)
        return result

    def _values_inside(self, t: FloatArray, ascend: bool) -> FloatArray:
        """Return the values at parameters inside the domain, (m, dim)."""
        if ascend:
            ends, numbers = self.intervals.ends, self.numbers
            most = _ENDS + t.size // _RUN
            if len(ends) > most:
                first, last = (int(ends.searchsorted(end, "right")) for end in (t.item(0), t.item(-1)))
                ends, numbers = ends[first : last + 1], numbers[:, :, first : last + 1]
            if len(ends) <= most:
                counts = t.searchsorted(ends)
                counts[1:] -= counts[:-1].copy()
                return self._values(numbers.repeat(counts, 2), t).T
        rows = self.rows.take(self.intervals.find(t), 1)
        # Of the shape of the numbers, again: a single column would make loops of the length dim.
        return self._values(rows, np.concatenate([t[:, None]] * rows.shape[2], axis=1))


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
    from curvecore.bezier.hermite_roots import expansion_points  # noqa: PLC0415 - 2 ms for fractions

    points = expansion_points(first.shape[1], order)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        h = ends - starts
        data = _scaled_data(first, last, h)
        if not _in_range(h, data):
            return None
        # Segments are the last axis until all is done: loops of NumPy's over one or two numbers are slow.
        coefficients = points.coefficients[:, None, :, 0, None] * data[0, :, None]
        for k, row in enumerate(data[1:], 1):
            coefficients += points.coefficients[:, None, :, k, None] * row[:, None]
        origins = _expand_at_doubles(coefficients, starts, ends, points)
        for power in range(len(coefficients)):
            for _ in range(order + power):
                coefficients[power] /= h
        cuts = np.empty_like(origins)
        cuts[-1] = ends
        # What lies at a joint belongs to it, however short the segment.
        least = np.nextafter(starts, ends)
        np.maximum(starts + h * points.cuts[:, None], least, out=cuts[:-1])
        cuts[-1, -1] = np.nextafter(ends[-1], np.inf)
        intervals = PieceIntervals.of(cuts.T.ravel(), float(starts[0]))
    powers, dim = coefficients.shape[:2]
    numbers = np.empty((powers + (powers > 1), dim, *origins.T.shape))
    numbers[:powers] = coefficients[::-1].swapaxes(2, 3)
    numbers[powers:] = origins.T
    domain = float(starts[0]), float(ends[-1])
    return TaylorPieces.of(intervals, numbers.reshape(len(numbers), dim, origins.size), domain)


def _in_range(h: FloatArray, data: FloatArray) -> bool:
    """Whether no product or quotient of lengths of segments and their data will leave the range."""
    sizes = np.abs(data)
    least = np.where(sizes > 0.0, sizes, 1.0).min()
    lengths_serve = h.min() >= _SHORT and h.max() <= 1.0 / _SHORT
    return bool(lengths_serve and least >= _SMALL and sizes.max() <= 1.0 / _SMALL)


def _scaled_data(first: FloatArray, last: FloatArray, h: FloatArray) -> FloatArray:
    """Return the data of both ends of segments, with derivatives by the local s, (2 R, dim, k)."""
    width = first.shape[1]
    data = np.empty((2 * width, first.shape[2], h.size))  # np.concatenate would keep the order in memory
    data[:width], data[width:] = first.transpose(1, 2, 0), last.transpose(1, 2, 0)
    for k in range(1, width):
        for _ in range(k):
            data[k::width] *= h
    return data


def _expand_at_doubles(
    coefficients: FloatArray, starts: FloatArray, ends: FloatArray, points: ExpansionPoints
) -> FloatArray:
    """Turn polynomials in s minus a position, (K, dim, P, k), into those about the double nearest to it.

    Returns these doubles, (P, k).
    """
    joints = np.stack([starts, ends])[:, None]
    h = ends - starts
    origins: FloatArray = starts + h * points.positions[:, None]
    origins[points.positions == 1.0] = ends
    inner = points.inner
    if inner.size and len(coefficients) > 1:
        near = origins[inner]
        # How far that lies behind the position, from exact distances: for some, by less than a rounding.
        high, low = multiply(difference(near, joints), points.shares)
        behind = add(DoubleDouble(high[0], low[0]), DoubleDouble(high[1], low[1]))
        exact = difference(near, behind.high)
        origins[inner] = exact.high
        _shift(coefficients, inner, (behind.low - exact.low) / h)
    return origins


def _shift(coefficients: FloatArray, inner: IntArray, offsets: FloatArray) -> None:
    """Make polynomials in s, (K, dim, P, k), at some points those in s minus an offset, (points, k)."""
    some = coefficients[:, :, inner]
    for lowest in range(len(some) - 1):
        for power in range(len(some) - 2, lowest - 1, -1):
            some[power] += offsets * some[power + 1]
    coefficients[:, :, inner] = some
