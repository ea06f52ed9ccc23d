"""The fewest points of a curve within a tolerance of data."""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, inf

from curvecore.errors import CurveError
from curvecore.fitting.fitter import NEAR, Attempt, Fitter
from curvecore.fitting.records import Fit

_EXACT = 16
"""Points up to which it is searched for the last one; beyond, for as many more as this goes into them."""

_GROWTH = 1.25
"""Times as many points as before that are tried next, at least."""

_MORE = (1.4, 2.0)
"""Times as many points that are tried where the data scatter: beyond, the curve follows each of them."""


def fewest(fitter: Fitter, start: tuple[int, Attempt] | None = None, *, persists: bool = True) -> Attempt:
    """Return the fit of the fewest points found within the fitter's tolerance.

    Where the data scatter farther around every curve, it is that of the fewest points that leaves no trend in
    what is left; else the nearest fit found.

    Parameters
    ----------
    fitter
        Makes the fits.
    start
        A number that some of the data are content with, and their fit: there may be more, not fewer.
    persists
        Whether some more points are tried where the data scatter.
    """
    low, high, found = _grown(fitter, start)
    if found.fit.is_scattered and persists and found.fit.deviation <= NEAR * fitter.tolerance:
        for times in _MORE:
            count = min(ceil(times * high), fitter.most)
            more = fitter.attempt(count, found)
            if more.fit.deviation <= fitter.tolerance:
                low, high, found = high, count, more
                break
    if found.fit.deviation <= fitter.tolerance:
        return _bisected(fitter, (low, high), found, lambda fit: fit.deviation <= fitter.tolerance)
    if found.fit.is_scattered:
        return _bisected(fitter, (low, high), found, lambda fit: fit.is_scattered)
    return found


def _grown(fitter: Fitter, start: tuple[int, Attempt] | None) -> tuple[int, int, Attempt]:
    """Take more and more points until more do not help; return numbers that are too few and enough."""
    count, guide = start or (min(fitter.least, fitter.most), None)
    low, high, best, began = count - 1, count, None, 0.0
    while True:
        try:
            found = fitter.attempt(count, guide)
        except CurveError:
            if best is None:
                raise
            return low, high, best
        deviation = found.fit.deviation
        if best is None or deviation <= best.fit.deviation or found.fit.is_scattered:
            best, guide, high = found, found, count
        began = began or deviation
        fitter.told.nears(began, best.fit.deviation, fitter.tolerance)
        if deviation <= fitter.tolerance or found.fit.is_scattered or count >= fitter.most:
            return low, high, best
        low = count
        needed = float(((found.errors / fitter.tolerance) ** fitter.power).sum())
        least = max(count + 1, int(_GROWTH * count))
        count = min(max(ceil(needed) if needed < inf else 2 * count, least), 2 * count, fitter.most)


def _bisected(
    fitter: Fitter, between: tuple[int, int], best: Attempt, is_good: Callable[[Fit], bool]
) -> Attempt:
    """Return the good fit of the fewest points, between a number that is not enough and one that is."""
    low, high = between
    while high - low > max(1, high // _EXACT):
        fitter.told.reaches(1.0 - (high - low) / (2.0 * high))
        middle = (low + high) // 2
        found = fitter.attempt(middle, best)
        if is_good(found.fit):
            best, high = found, middle
        else:
            low = middle
    return best
