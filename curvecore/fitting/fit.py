"""A curve of few points near many data: least squares, with parameters and joints that follow the curve.

References
----------
.. [1] J. Hoschek, "Intrinsic parametrization for approximation", Computer Aided Geometric Design 5 (1988)
   27-31: the parameter of a datum moves to the foot of its perpendicular on the curve, and a curve is fitted
   anew.
.. [2] P. J. Schneider, "An algorithm for automatically fitting digitized curves", Graphics Gems, Academic
   Press 1990, 612-626: the same by Newton's method, corners apart, within a tolerance.
.. [3] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapter XII: joints such that
   every segment has the same share of the error (NEWKNOT); chapter XIV: least squares.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from math import ceil, inf, isqrt, log
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import (
    FloatArray,
    IntArray,
    integer,
    parameter_array,
    point_array,
    tolerance_value,
)
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.setting import SettingValue
from curvecore.fitting.joints import lengths_along, placed, sharp_turns
from curvecore.fitting.least_squares import least_squares_curve

_ROUNDS = 12
_LEAST_GAIN = 0.97
"""Rounds end when two leave more than this of the deviation."""

_FALLS = 0.75
"""Share of the deviation that a round can be hoped to leave: where all that are left cannot come to the
tolerance, they are not tried."""

_LOST = 4.0
"""Rounds end, too, when one leaves so many times the deviation."""

_OVER = 1.7
"""Share of its way to the foot by which a parameter moves: farther than that takes a third of the rounds, as
over-relaxation does; from 2 on the rounds would not settle."""

_STRETCH = 1.5
"""Times as far from an end of the curve as at first that a datum may go: where a gap opens there, nothing
holds a polynomial, and it makes a loop."""

_MESHES, _FEW_MESHES = 6, 2
"""Attempts with joints that follow the error; how many of them are enough in a search."""

_EVEN = 0.02
"""Share of the largest error that every segment counts with, lest joints all go to one place."""

_EXACT = 16
"""Points up to which it is searched for the last one; beyond, for as many more as this goes into them."""

_MANY = 1500
"""Data among which the number of points is searched; all of them count in the end."""

_MOST = 500
"""Points beyond which none are searched for: those are not few any more."""

_STEPS = 2


class Fit(NamedTuple):
    """A curve near data.

    Attributes
    ----------
    curve : ParametricCurve
        Of the family asked for; a `Chain` of such curves where the data have corners.
    parameters : ndarray, shape (m,)
        Where on the curve the data belong.
    deviation : float
        The largest distance of the data from the curve there.
    root_mean_square : float
        The root of the mean of the squared distances.
    worst : int
        The index of the datum of the largest distance.

    See Also
    --------
    fit : The function that returns it.

    Examples
    --------
    >>> from curvecore import HermiteCurve, fit
    >>> found = fit([[0, 0], [1, 1], [2, 2], [3, 3]], HermiteCurve, 2)
    >>> found.curve
    HermiteCurve(n=2, dim=2, domain=(0, 1))
    >>> round(found.deviation, 9), len(found.parameters)
    (0.0, 4)
    """

    curve: ParametricCurve
    parameters: FloatArray
    deviation: float
    root_mean_square: float
    worst: int


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
    progress : callable, optional
        Hears the share that is done, between 0 and 1, now and then; what it raises ends the work.

    Returns
    -------
    Fit
        With a tolerance the curve of the fewest points found that keeps it, else the nearest one found:
        look at its `deviation`.

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
    error ~ h^p; they are the fewest for the joints that were tried.

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
    data = _Data.of(points, parameters, closed, _grain(points, count, tolerance))
    size = float(data.along[-1])
    corners: list[int] = []
    if with_corners and family.derivatives and family.is_local:
        reach = 5.0 * tolerance if tolerance is not None else size / (4.0 * max(count or 0, 4))
        reach = max(reach, 4.0 * size / len(data.points))
        corners = sharp_turns(data.points, reach, closed=closed)
        # So many are errors of the data, larger than the tolerance.
        corners = corners if len(corners) <= _MOST // 4 else []
    told = _Told(progress)
    solve = partial(least_squares_curve, family, closed=closed, settings=settings)
    moves = parameters is None
    fitter = partial(_Fitter, family=family, solve=solve, closed=closed, told=told, moves=moves)
    if tolerance is None:
        assert count is not None
        return data.told(fitter(data, corners=corners).attempt(count).fit)
    few, their_corners = data.thinned(corners)
    found = _within(fitter(few, corners=their_corners), tolerance, told)
    if len(few.points) < len(data.points):
        start = len(found.joints) - closed
        found = _within(fitter(data, corners=corners), tolerance, told, (start, found))
    return data.told(found.fit)


def _grain(points: ArrayLike, count: int | None, tolerance: float | None) -> float:
    """Return the length below which the data tell of their errors, not of a curve."""
    if tolerance is not None:
        return 2.0 * tolerance_value(tolerance)
    return float(np.ptp(point_array(points), axis=0).max()) / (8.0 * integer(count, "count", 2))


class _Data(NamedTuple):
    """Data without those that coincide with the one before.

    Attributes
    ----------
    points, along
        (m, dim), and the length of the polyline so far, (m,).
    parameters
        Where they begin, (m,): a share of the length, or what was given.
    rows, total
        The index of each among all, and how many these are.
    """

    points: FloatArray
    along: FloatArray
    parameters: FloatArray
    rows: IntArray
    total: int

    @classmethod
    def of(cls, points: ArrayLike, parameters: ArrayLike | None, closed: bool, grain: float) -> _Data:
        places = point_array(points)
        total = len(places)
        given = None if parameters is None else parameter_array(parameters, total)
        if closed and given is None and (places[0] != places[-1]).any():
            places = np.concatenate([places, places[:1]])
        along = lengths_along(places, grain)
        is_new = np.append(True, np.diff(along) > 0.0) | (given is not None)
        if not along[-1] > 0.0 or not np.isfinite(along[-1]):
            raise CurveError("points must be distinct, and not too far apart to measure")
        at = along / along[-1] if given is None else given
        rows = np.flatnonzero(is_new)
        return cls(places[rows], along[rows], at[rows], np.asarray(rows), total)

    def thinned(self, corners: list[int]) -> tuple[_Data, list[int]]:
        """Return some of the data, by which a search goes quickly, and where their corners are."""
        step = ceil(len(self.points) / _MANY)
        rows = np.union1d(np.arange(0, len(self.points), step), [*corners, len(self.points) - 1])
        points, along, parameters = self.points[rows], self.along[rows], self.parameters[rows]
        found: list[int] = np.searchsorted(rows, corners).tolist()
        return _Data(points, along, parameters, self.rows[rows], self.total), found

    def told(self, found: Fit) -> Fit:
        """Return the same for all data: those that were left out belong where the one before does."""
        which = np.searchsorted(self.rows, np.arange(self.total), side="right") - 1
        return found._replace(
            parameters=found.parameters[which], worst=int(self.rows[found.worst]) % self.total
        )


class _Attempt(NamedTuple):
    """A fit, how far along the data its joints are, and the largest distance in each segment."""

    fit: Fit
    joints: FloatArray
    errors: FloatArray


class _Told:
    """The progress of the work: the share only grows, and is told again before every round."""

    def __init__(self, progress: Callable[[float], object]) -> None:
        self._progress, self._share = progress, 0.0

    def again(self) -> None:
        """Tell the same once more: whoever hears it may end the work."""
        self._progress(self._share)

    def reaches(self, share: float) -> None:
        """Tell a share between 0 and 1."""
        self._share = max(self._share, share)

    def nears(self, began: float, now: float, tolerance: float) -> None:
        """Tell half the work as the logarithm of the deviation falls to that of the tolerance."""
        if tolerance < now < began:
            self.reaches(0.5 * log(began / now) / log(began / tolerance))


class _Feet(NamedTuple):
    """The parameters of a curve where the data belong, and their distances from there, each (m,)."""

    t: FloatArray
    distance: FloatArray


class _Fitter:
    """Fits curves of so many points to data."""

    def __init__(
        self,
        data: _Data,
        family: type[ParametricCurve],
        solve: Callable[..., ParametricCurve],
        corners: list[int],
        closed: bool,
        told: _Told,
        *,
        moves: bool,
    ) -> None:
        self._solve, self._told = solve, told
        self._data, self._family, self._corners = data, family, corners
        self._closed, self._moves = closed, moves
        order = family.derivatives + 1
        # Of a spline of simple joints, whose functions reach further, as of a cubic.
        self.power = 1.0 / max(2 * order, 4)
        self._apart = order
        self.least = max(2, 2 - closed + len([corner for corner in corners if corner]))
        room = (len(data.points) - 1) // order
        # Beyond so many points one polynomial is no longer determined by evenly spaced data.
        determined = 2 * isqrt(len(data.points)) if family.is_one_polynomial else _MOST
        bound = family.most_points or _MOST
        self.most = max(min(room, determined, bound - 1) + 1 - closed, 2)

    def attempt(self, count: int, before: _Attempt | None = None, enough: float = 0.0) -> _Attempt:
        """Return the best fit with so many points, for joints that follow the error; `enough` ends it."""
        if count + self._closed > len(self._data.points):
            raise CurveError(f"{len(self._data.points)} distinct points are too few for a curve of {count}")
        best: _Attempt | None = None
        for mesh in range(_MESHES):
            found = self._settled(self._joints(count, before), enough)
            gained = best is None or found.fit.deviation < best.fit.deviation
            is_done = best is not None and found.fit.deviation > _LEAST_GAIN * best.fit.deviation
            best = found if gained else best
            is_far = found.fit.deviation > enough * _FALLS ** (mesh - _MESHES) or mesh >= _FEW_MESHES
            if (
                (enough and (is_done or is_far))
                or found.fit.deviation <= enough
                or self._family.is_one_polynomial
            ):
                break
            before = found
        assert best is not None
        return best

    def _joints(self, count: int, before: _Attempt | None) -> IntArray:
        shares = self._data.along
        is_whole = self._family.is_one_polynomial
        if before is not None and not is_whole and before.errors.max() > 0.0:
            errors = np.maximum(before.errors, _EVEN * before.errors.max()) ** self.power
            sums = np.append(0.0, np.cumsum(errors))
            shares = np.interp(shares, before.joints, sums)
        return placed(shares, count + self._closed, self._corners, self._apart, towards_ends=is_whole)

    @np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore")
    def _settled(self, joints: IntArray, enough: float) -> _Attempt:
        """Return the fit with these joints, after rounds of moving parameters."""
        at, knots = self._data.parameters, self._data.parameters[joints]
        corners = np.flatnonzero(np.isin(joints, self._corners)).tolist()
        best, gained = None, True
        for step in range(_ROUNDS):
            self._told.again()
            try:
                curve = self._solve(self._data.points, at, knots, corners=corners)
                feet = self._feet(curve, at) if self._moves else self._at(curve, at)
                found = self._measured(curve, feet)
            except CurveError:
                if best is None:
                    raise
                break
            before, gained = gained, best is None or found.deviation < _LEAST_GAIN * best.deviation
            if best is None or found.deviation < best.deviation:
                best, errors = found, np.maximum.reduceat(feet.distance, joints[:-1])
            # A round may be worse than the one before, and still lead to a better one.
            is_far = 0.0 < enough * _FALLS ** (step + 1 - _ROUNDS) < found.deviation
            is_lost = is_far or found.deviation > _LOST * best.deviation
            if not (self._moves and (gained or before)) or found.deviation <= enough or is_lost:
                break
            at = self._kept(at + _OVER * (feet.t - at), *curve.domain)
        assert best is not None
        return _Attempt(best, self._data.along[joints], errors)

    def _kept(self, t: FloatArray, start: float, end: float) -> FloatArray:
        """Keep parameters in the domain, and near the ends of an open curve those that began there."""
        if self._closed:
            return np.clip(t, start, end)
        first = self._data.parameters
        return np.clip(t, end - _STRETCH * (end - first), start + _STRETCH * (first - start)).clip(start, end)

    def _at(self, curve: ParametricCurve, t: FloatArray) -> _Feet:
        return _Feet(t, np.asarray(np.linalg.norm(curve.evaluate(t) - self._data.points, axis=1)))

    def _feet(self, curve: ParametricCurve, t: FloatArray) -> _Feet:
        """Take steps of Gauss and Newton along the curve towards the data, where these come nearer."""
        points, furthest = self._data.points, 0.5 * float(np.diff(curve.parameters).max())
        off = curve.evaluate(t) - points
        distance = np.linalg.norm(off, axis=1)
        for _ in range(_STEPS):
            velocity = curve.evaluate(t, 1)
            step = np.nan_to_num((off * velocity).sum(axis=1) / (velocity * velocity).sum(axis=1))
            if not self._closed:
                step[[0, -1]] = 0.0
            there = np.clip(t - np.clip(step, -furthest, furthest), *curve.domain)
            rest = curve.evaluate(there) - points
            length = np.linalg.norm(rest, axis=1)
            is_nearer = length < distance
            t, off = np.where(is_nearer, there, t), np.where(is_nearer[:, None], rest, off)
            distance = np.where(is_nearer, length, distance)
        return _Feet(t, distance)

    def _measured(self, curve: ParametricCurve, feet: _Feet) -> Fit:
        worst = int(np.argmax(feet.distance))
        largest = float(feet.distance[worst])
        if not np.isfinite(largest):
            raise CurveError(f"a curve of {self._family.name} through so many points leaves all numbers")
        mean = largest * float(np.sqrt(np.mean((feet.distance / largest) ** 2))) if largest else 0.0
        return Fit(curve, feet.t, largest, mean, worst)


def _within(
    fitter: _Fitter,
    tolerance: float,
    told: _Told,
    start: tuple[int, _Attempt] | None = None,
) -> _Attempt:
    """Return the fit of the fewest points found within the tolerance, or the nearest fit found.

    `start` is a number that some of the data are content with, and their fit: there may be more, not fewer.
    """
    count, guide = start or (min(fitter.least, fitter.most), None)
    low, best, began = count - 1, None, 0.0
    while True:
        try:
            found = fitter.attempt(count, guide, tolerance)
        except CurveError:
            if best is None:
                raise
            return best
        best = guide = found if best is None or found.fit.deviation <= best.fit.deviation else best
        began = began or found.fit.deviation
        told.nears(began, best.fit.deviation, tolerance)
        if found.fit.deviation <= tolerance or count >= fitter.most:
            break
        low = count
        needed = float(((found.errors / tolerance) ** fitter.power).sum())
        count = min(max(ceil(needed) if needed < inf else 2 * count, count + 1), 2 * count, fitter.most)
    high = count
    while best.fit.deviation <= tolerance and high - low > max(1, high // _EXACT):
        told.reaches(1.0 - (high - low) / (2.0 * high))
        middle = (low + high) // 2
        found = fitter.attempt(middle, best, tolerance)
        if found.fit.deviation <= tolerance:
            best, high = found, middle
        else:
            low = middle
    return best
