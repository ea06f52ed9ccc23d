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

_RESOLVED = 0.1
"""Share of the first deviation below which it falls with every point, unless nothing more can be had."""

_WORTH = 0.5
"""Share of the deviation that twice as many points leave, at most, where they are worth it."""

_AS_GOOD = 1.25
"""Times the least deviation that is as good where none is within the tolerance."""

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
        for tries, times in enumerate(_MORE):
            fitter.told.reaches(0.5 + 0.2 * tries)
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
    low, tried = count - 1, dict[int, Attempt]()
    while True:
        try:
            found = fitter.attempt(count, guide)
        except CurveError:
            if not tried:
                raise
            break
        tried[count] = found
        began, best = next(iter(tried.values())), min(tried.values(), key=_deviation)
        fitter.told.nears(_deviation(began), _deviation(best), fitter.tolerance)
        if _deviation(found) <= fitter.tolerance or found.fit.is_scattered:
            return low, count, found
        before = [each for number, each in tried.items() if 2 * number <= count]
        known = min(map(_deviation, before), default=inf)
        is_vain = _deviation(best) > max(_WORTH * known, NEAR * fitter.tolerance)
        is_vain = is_vain and known < _RESOLVED * _deviation(began)
        if count >= fitter.most or is_vain:
            break
        low, guide = count, best
        needed = float(((found.errors / fitter.tolerance) ** fitter.power).sum())
        least = max(count + 1, int(_GROWTH * count))
        count = min(max(ceil(needed) if needed < inf else 2 * count, least), 2 * count, fitter.most)
    limit = _AS_GOOD * min(map(_deviation, tried.values()))
    count = min(number for number, each in tried.items() if _deviation(each) <= limit)
    return low, count, tried[count]


def _deviation(attempt: Attempt) -> float:
    return attempt.fit.deviation


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
