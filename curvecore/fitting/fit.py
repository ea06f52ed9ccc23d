"""A curve of few points near many data: so many, or as few as keep a tolerance.

References
----------
.. [1] P. J. Schneider, "An algorithm for automatically fitting digitized curves", Graphics Gems, Academic
   Press 1990, 612-626: parameters that move, corners apart, within a tolerance.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from math import ceil, inf

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import integer, point_array, tolerance_value
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.setting import SettingValue
from curvecore.fitting.fitter import MOST, NEAR, Attempt, Fitter, RoundsProgress
from curvecore.fitting.joints import scatter_of, sharp_turns
from curvecore.fitting.least_squares import least_squares_curve
from curvecore.fitting.records import Data, Fit

_SEARCH = 0.3
"""Share of the work that a search among some of the data takes."""

_DENSE, _ABOVE_ERRORS = 5.0, 20.0
"""Data within the reach of a corner that tell of their errors; how far that is above these, at least."""


def fit(
    points: ArrayLike,
    family: type[ParametricCurve],
    count: int | None = None,
    *,
    tolerance: float | None = None,
    parameters: ArrayLike | None = None,
    closed: bool = False,
    with_corners: bool = True,
    settings: Mapping[str, SettingValue] | None = None,
    end_directions: tuple[ArrayLike | None, ArrayLike | None] = (None, None),
    progress: Callable[[float], object] = lambda _share: None,
) -> Fit:
    """Return a curve of few points near many data.

    All jets of the curve are unknowns of a linear least-squares problem, those of derivatives too: few
    points, each with the derivatives that fit best. It begins in the first and ends in the last of the data.
    The data's parameters begin by chord length and move to the feet of their perpendiculars; the joints move
    to where the error is; both until the largest deviation no longer falls.

    Parameters
    ----------
    points : array_like, shape (m, dim)
        The data, in order along the curve; m >= 2.
    family : type of ParametricCurve
        The class of the curve: any, whether its curves pass through their points or not.
    count : int, optional
        The points of the curve, at least 2. At a closed one the last is not counted again.
    tolerance : float, optional
        In place of `count`: the largest deviation allowed, above 0.
    parameters : array_like, shape (m,), optional
        Those of the data, strictly increasing. They are kept as they are, and deviations are measured
        between data and curve at the same parameter. Else they begin at 0 and end at 1, by chord length.
    closed : bool, optional
        Whether a last segment leads back to the first point, where the jet is the same. The data go around
        once; that they return to the first one need not be said.
    with_corners : bool, optional
        Whether the curve may have a corner where the data turn sharply, in a family with derivatives.
    settings : mapping, optional
        Values of the family's `settings`, by their names; of a closed curve such as make it periodic.
    end_directions : pair of array_like, shape (dim,), optional
        Directions of length 1 in which an open curve of a family with derivatives begins and ends, without
        `parameters`; None for one that is free.
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Fit
        With a tolerance the curve of the fewest points found that keeps it, else the nearest one found:
        look at its `deviation`. Where the errors of the data are larger than the tolerance, that is one
        of few points, not one that follows them (`is_scattered`).

    Raises
    ------
    CurveError
        If the data are no points, coincide, or are too few for so many points; if neither or both of count
        and tolerance are given, or the functions of so many points cannot be told apart at the data.

    See Also
    --------
    Fit : What it returns.
    least_squares_curve : With given parameters, in one step.

    Notes
    -----
    Distances are measured to the foot of a perpendicular near the datum: no datum is farther away from the
    curve. The fewest points are searched by doubling and halving, guided by the order of the approximation,
    error ~ h^p; they are the fewest for the joints that were tried. Near the tolerance the data that are
    farthest off count more than the others: the largest deviation is to be small, not only the mean.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import HermiteCurve, fit
    >>> angle = np.linspace(0, np.pi, 200)
    >>> found = fit(np.column_stack([np.cos(angle), np.sin(angle)]), HermiteCurve, tolerance=1e-3)
    >>> found.deviation <= 1e-3, len(found.curve.points) < 10
    (True, True)
    """
    if (count is None) == (tolerance is None):
        raise CurveError("either count or tolerance must be given")
    data = Data.of(points, parameters, closed, _grain(points, count, tolerance))
    has_corners = with_corners and family.derivatives and family.is_local
    corners = _corners_of(data, count, tolerance, closed=closed) if has_corners else []
    rounds = RoundsProgress(progress)
    # Parameters by chord length: the speed is about the whole length.
    first, last = (
        None if direction is None else data.along[-1] * np.asarray(direction) for direction in end_directions
    )
    solve = partial(
        least_squares_curve, family, closed=closed, settings=settings, end_velocities=(first, last)
    )
    moves = parameters is None
    fitter = partial(
        Fitter,
        family=family,
        solve=solve,
        closed=closed,
        progress=rounds,
        tolerance=tolerance or 0.0,
        moves=moves,
    )
    everything = fitter(data, corners=corners)
    if tolerance is None:
        assert count is not None
        return data.of_all(everything.attempt(count).fit)
    few, their_corners = data.thinned(corners)
    if len(few.points) == len(data.points):
        return data.of_all(fewest(everything).fit)
    rounds.set_range(0.0, _SEARCH)
    rough = fewest(fitter(few, corners=their_corners), persists=False)
    rounds.set_range(_SEARCH, 1.0)
    return data.of_all(fewest(everything, (len(rough.joints) - closed, rough)).fit)


def _corners_of(data: Data, count: int | None, tolerance: float | None, *, closed: bool) -> list[int]:
    """Return the data at which the curve is to have a corner."""
    size = float(data.along[-1])
    reach = 5.0 * tolerance if tolerance is not None else size / (4.0 * max(count or 0, 4))
    spacing = size / len(data.points)
    reach = max(reach, 4.0 * spacing)
    if reach > _DENSE * spacing:
        reach = max(reach, _ABOVE_ERRORS * scatter_of(data.points))
    corners = sharp_turns(data.points, reach, closed=closed)
    # So many are none.
    return corners if len(corners) <= MOST // 4 else []


def _grain(points: ArrayLike, count: int | None, tolerance: float | None) -> float:
    """Return the length below which the data tell of their errors, not of a curve."""
    if tolerance is not None:
        return 2.0 * tolerance_value(tolerance)
    return float(np.ptp(point_array(points), axis=0).max()) / (8.0 * integer(count, "count", 2))


# The fewest points within a tolerance

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
    low, high, attempt = _grown(fitter, start)
    if attempt.fit.is_scattered and persists and attempt.fit.deviation <= NEAR * fitter.tolerance:
        for tries, times in enumerate(_MORE):
            fitter.progress.report(0.5 + 0.2 * tries)
            count = min(ceil(times * high), fitter.most)
            more = fitter.attempt(count, attempt)
            if more.fit.deviation <= fitter.tolerance:
                low, high, attempt = high, count, more
                break
    if attempt.fit.deviation <= fitter.tolerance:
        return _bisected(fitter, (low, high), attempt, lambda fit: fit.deviation <= fitter.tolerance)
    if attempt.fit.is_scattered:
        return _bisected(fitter, (low, high), attempt, lambda fit: fit.is_scattered)
    return attempt


def _grown(fitter: Fitter, start: tuple[int, Attempt] | None) -> tuple[int, int, Attempt]:
    """Try more and more points until more do not help; return numbers that are too few and enough."""
    count, guide = start or (min(fitter.least, fitter.most), None)
    low, tried = count - 1, dict[int, Attempt]()
    while True:
        try:
            attempt = fitter.attempt(count, guide)
        except CurveError:
            if not tried:
                raise
            break
        tried[count] = attempt
        began, best = next(iter(tried.values())), min(tried.values(), key=_deviation)
        fitter.progress.report_deviation(_deviation(began), _deviation(best), fitter.tolerance)
        if _deviation(attempt) <= fitter.tolerance or attempt.fit.is_scattered:
            return low, count, attempt
        before = [earlier for number, earlier in tried.items() if 2 * number <= count]
        known = min(map(_deviation, before), default=inf)
        is_vain = _deviation(best) > max(_WORTH * known, NEAR * fitter.tolerance)
        is_vain = is_vain and known < _RESOLVED * _deviation(began)
        if count >= fitter.most or is_vain:
            break
        low, guide = count, best
        needed = float(((attempt.errors / fitter.tolerance) ** fitter.power).sum())
        least = max(count + 1, int(_GROWTH * count))
        count = min(max(ceil(needed) if needed < inf else 2 * count, least), 2 * count, fitter.most)
    limit = _AS_GOOD * min(map(_deviation, tried.values()))
    count = min(number for number, earlier in tried.items() if _deviation(earlier) <= limit)
    return low, count, tried[count]


def _deviation(attempt: Attempt) -> float:
    return attempt.fit.deviation


def _bisected(
    fitter: Fitter, between: tuple[int, int], best: Attempt, is_good: Callable[[Fit], bool]
) -> Attempt:
    """Return the good fit of the fewest points, between a number that is not enough and one that is."""
    low, high = between
    while high - low > max(1, high // _EXACT):
        fitter.progress.report(1.0 - (high - low) / (2.0 * high))
        middle = (low + high) // 2
        attempt = fitter.attempt(middle, best)
        if is_good(attempt.fit):
            best, high = attempt, middle
        else:
            low = middle
    return best
