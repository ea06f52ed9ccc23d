"""A curve of so many points near data: parameters and joints follow the curve, round after round.

References
----------
.. [1] J. Hoschek, "Intrinsic parametrization for approximation", Computer Aided Geometric Design 5 (1988)
   27-31: the parameter of a datum moves to the foot of its perpendicular on the curve, and a curve is fitted
   anew.
.. [2] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapter XII: joints such that
   every segment has the same share of the error (NEWKNOT).
.. [3] M. J. D. Powell, "Curve fitting by splines in one variable", in J. G. Hayes (ed.), Numerical
   Approximation to Functions and Data, Athlone Press 1970, 65-83: what is left has a trend, where neighbours
   are off to the same side, or is error of the data.
.. [4] C. L. Lawson, "Contributions to the theory of linear least maximum approximation", thesis, University
   of California, Los Angeles 1961: least squares with weights that grow where the data are far off.
"""

from __future__ import annotations

from collections.abc import Callable
from math import isqrt, log
from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, IntArray
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.fitting.joints import placed
from curvecore.fitting.records import Data, Fit

MOST = 500
"""Points beyond which none are searched for: those are not few any more."""

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
"""Share of the largest error that every segment counts with, lest joints all go to one parameter."""

_WARM = 4.0
"""Times the tolerance up to which a fit tells others where the data belong."""

NEAR = 1.5
"""Times the tolerance from which weights can bring the largest deviation down to it."""

_PRESSES, _SURE = 12, 0.98
"""Rounds with weights; what they aim at, as a share of the tolerance."""

_TREND = 0.2
"""Share of the squares that products of neighbours have where a curve is off by half of the data's errors."""

_SIGMAS = 3.0
"""Standard deviations of that share, the root of one over their number, within which it may be chance."""

_BEYOND_ENDS = 1.25
"""Times as far off as inside that the outer segments may be for that."""

_FEW = 8
"""Data in a segment of which no trend can be told."""

_DENSE = 10
"""Data for each unknown from which errors can be told from what a curve of more points would follow."""


class Attempt(NamedTuple):
    """A fit with so many points.

    Attributes
    ----------
    fit, data
        The curve, and what it was fitted to.
    joints
        The data at which it has its joints, (k,).
    off
        Where it lies from the data, (m, dim).
    """

    fit: Fit
    data: Data
    joints: IntArray
    off: FloatArray

    @property
    def along(self) -> FloatArray:
        """The lengths along the data at the joints, (k,)."""
        return self.data.along[self.joints]

    @property
    def errors(self) -> FloatArray:
        """The largest distance in each segment, (k - 1,)."""
        return np.asarray(np.maximum.reduceat(np.linalg.norm(self.off, axis=1), self.joints[:-1]))

    def has_no_trend(self, tolerance: float, *, holds_ends: bool) -> bool:
        """Whether data are dense, and no segment with data beyond the tolerance has a trend [3]_.

        The outer ones of a curve that is held to the errors of two data, its ends, are asked only where it is
        much farther off than inside.
        """
        if len(self.off) < _DENSE * self.fit.curve.jets[..., 0].size:
            return False
        starts, errors = self.joints[:-1], self.errors
        beyond = errors > tolerance
        if holds_ends and len(starts) > 2:
            beyond[[0, -1]] &= errors[[0, -1]] > _BEYOND_ENDS * errors[1:-1].max()
        neighbours = np.append((self.off[1:] * self.off[:-1]).sum(axis=1), 0.0)
        products = np.add.reduceat(neighbours, starts)[beyond]
        squares = np.add.reduceat((self.off * self.off).sum(axis=1), starts)[beyond]
        counts = np.diff(self.joints)[beyond]
        several = counts >= _FEW
        alone = products > np.maximum(_TREND, _SIGMAS / np.sqrt(counts)) * squares
        many = int(counts.sum())
        if (alone & several).any() or many < 4 * _FEW:
            return False
        return bool(products.sum() <= max(_TREND, _SIGMAS / many**0.5) * squares.sum())


class RoundsProgress:
    """The progress of a fit: the share only grows, and is reported again before every round."""

    def __init__(self, progress: Callable[[float], object]) -> None:
        self._progress, self._share = progress, 0.0
        self._start, self._end = 0.0, 1.0

    def set_range(self, start: float, end: float) -> None:
        """Map the shares from now on to a part of the whole work."""
        self._start, self._end = start, end

    def repeat(self) -> None:
        """Report the same share again: the callback may end the work."""
        self._progress(self._share)

    def report(self, share: float) -> None:
        """Report a share between 0 and 1."""
        self._share = max(self._share, self._start + (self._end - self._start) * share)

    def report_deviation(self, began: float, now: float, tolerance: float) -> None:
        """Report half the work as the logarithm of the deviation falls to that of the tolerance."""
        if tolerance < now < began:
            self.report(0.5 * log(began / now) / log(began / tolerance))


class Fitter:
    """Fit of curves with given numbers of points to data.

    Attributes
    ----------
    progress
        The progress of the work.
    tolerance
        The deviation that is enough; 0 where the nearest curve is wanted.
    power
        1 / p of an error ~ h^p.
    least, most
        Points of a curve.
    """

    def __init__(
        self,
        data: Data,
        family: type[ParametricCurve],
        solve: Callable[..., ParametricCurve],
        corners: list[int],
        closed: bool,
        progress: RoundsProgress,
        tolerance: float,
        *,
        moves: bool,
    ) -> None:
        self._solve, self.progress, self.tolerance = solve, progress, tolerance
        self._data, self._family, self._corners = data, family, corners
        self._closed, self._moves = closed, moves
        order = family.derivatives + 1
        # Of a spline of simple joints, whose functions reach further, as of a cubic.
        self.power = 1.0 / max(2 * order, 4)
        self._apart = order
        self.least = max(2, 2 - closed + len([corner for corner in corners if corner]))
        room = (len(data.points) - 1) // order
        # Beyond so many points one polynomial is no longer determined by evenly spaced data.
        determined = 2 * isqrt(len(data.points)) if family.is_one_polynomial else MOST
        bound = family.most_points or MOST
        self.most = max(min(room, determined, bound - 1) + 1 - closed, 2)

    def attempt(self, count: int, before: Attempt | None = None) -> Attempt:
        """Return the best fit with so many points, for joints that follow the error.

        `before` is another one, for its joints and parameters.
        """
        tolerance = self.tolerance
        if count + self._closed > len(self._data.points):
            raise CurveError(f"{len(self._data.points)} distinct points are too few for a curve of {count}")
        best: Attempt | None = None
        at = self._start(before)
        for mesh in range(_MESHES):
            settled = self._settled(self._joints(count, before), at)
            gained = best is None or settled.fit.deviation < best.fit.deviation
            is_done = best is not None and settled.fit.deviation > _LEAST_GAIN * best.fit.deviation
            best = settled if gained else best
            is_far = settled.fit.deviation > tolerance * _FALLS ** (mesh - _MESHES) or mesh >= _FEW_MESHES
            if (
                (tolerance and (is_done or is_far or settled.fit.is_scattered))
                or settled.fit.deviation <= tolerance
                or self._family.is_one_polynomial
            ):
                break
            before = settled
        assert best is not None
        is_near = tolerance < best.fit.deviation <= NEAR * tolerance
        return self._pressed(best) if is_near else best

    def _start(self, before: Attempt | None) -> FloatArray:
        """Return first parameters of the data: on a curve that is near them already, else by their length."""
        data = self._data
        if not self._moves or before is None or before.fit.deviation > _WARM * self.tolerance:
            return data.parameters
        if before.data is data:
            return before.fit.parameters
        at = np.interp(data.along, before.data.along, before.fit.parameters)
        return self._clipped(at, *before.fit.curve.domain)

    def _joints(self, count: int, before: Attempt | None) -> IntArray:
        shares = self._data.along
        is_whole = self._family.is_one_polynomial
        if before is not None and not is_whole and (errors := before.errors).max() > 0.0:
            errors = np.maximum(errors, _EVEN * errors.max()) ** self.power
            sums = np.append(0.0, np.cumsum(errors))
            shares = np.interp(shares, before.along, sums)
        return placed(shares, count + self._closed, self._corners, self._apart, towards_ends=is_whole)

    @np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore")
    def _settled(self, joints: IntArray, at: FloatArray) -> Attempt:
        """Return the fit with these joints, after rounds of moving parameters."""
        tolerance = self.tolerance
        best: Attempt | None = None
        gained = True
        for step in range(_ROUNDS):
            try:
                latest = self._round(joints, at)
            except CurveError:
                if best is None:
                    raise
                break
            deviation = latest.fit.deviation
            before, gained = gained, best is None or deviation < _LEAST_GAIN * best.fit.deviation
            best = latest if best is None or deviation < best.fit.deviation else best
            # A round may be worse than the one before, and still lead to a better one.
            is_far = 0.0 < tolerance * _FALLS ** (step + 1 - _ROUNDS) < deviation
            is_lost = is_far or deviation > _LOST * best.fit.deviation
            if not (self._moves and (gained or before)) or deviation <= tolerance or is_lost:
                break
            at = self._clipped(at + _OVER * (latest.fit.parameters - at), *latest.fit.curve.domain)
        assert best is not None
        if 0.0 < tolerance < best.fit.deviation:
            scattered = best.has_no_trend(tolerance, holds_ends=not self._closed)
            best = best._replace(fit=best.fit._replace(is_scattered=scattered))
        return best

    @np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore")
    def _pressed(self, settled: Attempt) -> Attempt:
        """Return a fit of the same joints with a smaller deviation: data beyond the tolerance count more.

        A datum of weight w draws the curve by w h / (1 + w h) of its distance, with h the share of one datum
        among the unknowns; so much more weight brings it where it should be [4]_.
        """
        best, latest, tolerance = settled, settled, self.tolerance
        weights = np.ones(len(settled.off))
        share = len(settled.joints) * (self._family.derivatives + 1) / len(settled.off)
        waits = 0
        for _ in range(_PRESSES):
            excess = np.linalg.norm(latest.off, axis=1) / (_SURE * tolerance) - 1.0
            weights += np.maximum(excess, 0.0) / share
            try:
                latest = self._round(settled.joints, latest.fit.parameters, weights)
            except CurveError:
                break
            waits = 0 if latest.fit.deviation < _LEAST_GAIN * best.fit.deviation else waits + 1
            best = latest if latest.fit.deviation < best.fit.deviation else best
            if best.fit.deviation <= tolerance or waits > 3:
                break
        scattered = settled.fit.is_scattered and best.fit.deviation > tolerance
        return best._replace(fit=best.fit._replace(is_scattered=scattered))

    def _round(self, joints: IntArray, at: FloatArray, weights: FloatArray | None = None) -> Attempt:
        """Return the curve that is nearest to data at these parameters, and their feet on it."""
        self.progress.repeat()
        data = self._data
        corners = np.flatnonzero(np.isin(joints, self._corners)).tolist()
        curve = self._solve(data.points, at, data.parameters[joints], corners=corners, weights=weights)
        if self._moves:
            at = Cubics.near(curve).feet(data.points, at, holds_ends=not self._closed)
        off = curve.evaluate(at) - data.points
        distance = np.linalg.norm(off, axis=1)
        worst = int(np.argmax(distance))
        largest = float(distance[worst])
        if not np.isfinite(largest):
            raise CurveError(f"a curve of {self._family.name} through so many points overflows")
        mean = largest * float(np.sqrt(np.mean((distance / largest) ** 2))) if largest else 0.0
        return Attempt(Fit(curve, at, largest, mean, worst), data, joints, off)

    def _clipped(self, t: FloatArray, start: float, end: float) -> FloatArray:
        """Keep parameters in the domain, and near the ends of an open curve those that began there."""
        if self._closed:
            return np.clip(t, start, end)
        first = self._data.parameters
        return np.clip(t, end - _STRETCH * (end - first), start + _STRETCH * (first - start)).clip(start, end)


# Feet of perpendiculars

_STEPS = 2

_FINE = 4
"""Cubics between two joints, where the curve's own pieces are not that."""

_THIRDS = np.arange(4) / 3.0
_CUBIC = np.linalg.inv(np.vander(_THIRDS, increasing=True))
"""Values at thirds of an interval to coefficients of powers."""


class Cubics(NamedTuple):
    """Cubics near a curve, by which feet are found whatever its functions cost.

    Attributes
    ----------
    breaks
        Where they join, (k,).
    coefficients
        Of the powers of the share of each interval, (4, dim, k - 1).
    """

    breaks: FloatArray
    coefficients: FloatArray

    @classmethod
    def near(cls, curve: ParametricCurve) -> Cubics:
        """Return the curve's own cubics, or those through some of its points."""
        joints = np.union1d(curve.parameters, curve.breaks)
        fine = 1 if curve.degree is not None and curve.degree <= 3 else _FINE
        step = np.arange(fine) / fine
        breaks = np.append((joints[:-1, None] + np.diff(joints)[:, None] * step).reshape(-1), joints[-1])
        at = breaks[:-1, None] + np.diff(breaks)[:, None] * _THIRDS[:3]
        values = curve.evaluate(np.append(at.reshape(-1), breaks[-1]))
        starts = 3 * np.arange(len(breaks) - 1)
        four = values[starts + np.arange(4)[:, None]]
        return cls(breaks, np.stack([np.tensordot(row, four, 1).T for row in _CUBIC]))

    def feet(self, points: FloatArray, t: FloatArray, *, holds_ends: bool) -> FloatArray:
        """Return parameters nearer to those of the feet: steps of Gauss and Newton, where data come nearer.

        Parameters
        ----------
        points, t
            (m, dim), and where to begin, (m,).
        holds_ends
            Whether the first and the last datum stay where they are.
        """
        furthest = 0.5 * float(np.diff(self.breaks).max())
        # By coordinates: rows of two numbers would each cost as much as a row of hundreds.
        data = np.ascontiguousarray(points.T)
        off, velocity = self._state(t, data)
        distance = (off * off).sum(axis=0)
        for _ in range(_STEPS):
            step = np.nan_to_num((off * velocity).sum(axis=0) / (velocity * velocity).sum(axis=0))
            if holds_ends:
                step[[0, -1]] = 0.0
            there = np.clip(t - np.clip(step, -furthest, furthest), self.breaks[0], self.breaks[-1])
            rest, ahead = self._state(there, data)
            length = (rest * rest).sum(axis=0)
            is_nearer = length < distance
            t, distance = np.where(is_nearer, there, t), np.where(is_nearer, length, distance)
            off = np.where(is_nearer, rest, off)
            velocity = np.where(is_nearer, ahead, velocity)
        return t

    def _state(self, t: FloatArray, data: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the offsets of the curve from the data, and its velocity, each (dim, m) like the data."""
        piece = np.searchsorted(self.breaks[1:-1], t, side="right")
        length = np.diff(self.breaks)[piece]
        x = (t - self.breaks[piece]) / length
        a, b, c, d = self.coefficients.take(piece, axis=-1)
        return a + x * (b + x * (c + x * d)) - data, (b + x * (2.0 * c + x * 3.0 * d)) / length
