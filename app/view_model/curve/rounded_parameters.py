"""The rounding of parameters that a rule gives, and its effect on the numbers of a curve.

A rule gives t_i that are no doubles; the curve has the nearest ones. Where two are close together, that
changes their distance by a large share of it, and the curve with it: at points 1e-12 apart by some 1e-4.
Parameters that a person gave are exact.
"""

from __future__ import annotations

from contextlib import suppress
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore import CurveError, ParametricCurve
from curvecore.arithmetic import SMALLEST, UNIT_ROUNDOFF
from curvecore.arrays import FloatArray
from curvecore.parametrization import relative_spacing

from ...document.words import number, rounded_up
from .core_curve import parameters_of
from .curve_view import CurveView, curve_through

_GROUPS = 8
"""Parameters that are moved one by one; of more, so many groups are moved, each up and down by chance."""

_MOST_STEP = 2.0**-12
"""Share of the distance of two parameters by which one is moved at most, but for its rounding."""

_MOST_ROUNDINGS = 2.0**20
"""Roundings by which a parameter is moved at most."""

_CLEARLY = 4.0
"""Factor by which another error must be larger for the effect of rounding not to be measured."""

_PROPORTIONAL = 0.25
"""Share up to which the effect is in proportion to it, within a factor of two."""

_MOST_TINY = 64
"""Distances with a larger share that are corrected one by one."""

_SHOWS = 1e-9
"""Share from which the curvature, displayed with four digits, is displayed with its error."""

_WORTH_A_WORD = 1e-5
"""Share from which the displayed digits of boxes and of the growth of errors are uncertain."""


class Disturbed(NamedTuple):
    """A curve with other parameters, which measures the effect of rounding.

    Attributes
    ----------
    curve
        With some parameters moved.
    weight
        The differences of a number of such curves from that of the curve, times their weights, add up to a
        bound of its difference from that for exact parameters, with a factor of two to spare.
    """

    curve: ParametricCurve
    weight: float


def curvature_error(view: CurveView, t: FloatArray) -> FloatArray:
    """Return bounds (m,) of the error by rounding of the curvature of a current curve at t (m,).

    Rounded parameters are compared at the same share of the segment.
    """
    error, rounding = curvecore.curvature_error(view.present_curve, t), ParameterRounding(view)
    if rounding.shares.max() > _SHOWS:
        curvature = curvecore.curvature(view.present_curve, t)
        for curve, weight in rounding.disturbed():
            there = np.interp(t, view.parameters, curve.parameters)
            error += weight * np.abs(curvecore.curvature(curve, there) - curvature)
    return error


class ParameterRounding:
    """Largest errors of the parameters of a current curve, and their effect.

    Attributes
    ----------
    sizes
        The error of each parameter, (k,); 0 where it has no effect.
    shares
        The error of the distance of each parameter to the next, against that distance, (k - 1,).
    """

    __slots__ = ("_view", "shares", "sizes")

    def __init__(self, view: CurveView) -> None:
        self._view = view
        rule, t = view.source.parametrization, view.present_curve.parameters
        # The rules of Chebyshev are sines of rounded angles.
        sizes = (3.0 if rule.exponent is None else 0.51) * np.spacing(np.abs(t))
        if (rule.start, rule.end) != (0.0, 1.0):
            # The share of the interval, its product with the length and the sum are rounded each.
            sizes += 1.6 * np.spacing(np.abs(t - rule.start))
        sizes[[0, -1]] = 0.0
        self.sizes: FloatArray = sizes * ~(view.present_curve.idle_parameters | view.source.is_manual)
        self.shares: FloatArray = (self.sizes[1:] + self.sizes[:-1]) / (t[1:] - t[:-1])

    @property
    def remark(self) -> str:
        """A sentence where the effect shows in numbers of the curve; else empty."""
        knot, owner = int(self.shares.argmax()), self._view.owner
        if self.shares[knot] < _WORTH_A_WORD:
            return ""
        numbers = "Λ" if np.count_nonzero(self.shares > _PROPORTIONAL) <= _MOST_TINY else "length, Λ"
        share = number(rounded_up(100.0 * float(self.shares[knot]), 1), 3)
        return (
            f"Points {owner(knot)} and {owner(knot + 1)} are so close together that rounding changes the "
            f"distance of their t by up to {share} %: {numbers}, box and crossings are those for the "
            "stored t."
        )

    def is_lost(self, of_data: float, growth: float, accuracy: float) -> bool:
        """Whether another error of the length is much larger than the effect.

        Parameters
        ----------
        of_data, growth
            The Lebesgue constants of the data and of the points.
        accuracy
            The other error, against the length.
        """
        if of_data > 1.0 / UNIT_ROUNDOFF:
            # That error includes the rounding of the pieces, grown by as much.
            return True
        lost = accuracy / (_CLEARLY * growth)
        # The mean is at most three times the largest share, which is found by fewer calls.
        return bool(3.0 * self.shares.max() <= lost or self._mean_share() <= lost)

    def disturbed(self) -> list[Disturbed]:
        """Return disturbed curves that measure the effect."""
        t, is_tiny = self._view.parameters, self.shares > _PROPORTIONAL
        tiny = np.flatnonzero(is_tiny)
        cases = [(self._with_true_distance(knot), 2.0) for knot in tiny[:_MOST_TINY].tolist()]
        moved = np.setdiff1d(np.flatnonzero(self.sizes), [tiny, tiny + 1])
        # By many roundings at once, so that the roundings of the results do not hide the effect.
        share = float(self.shares[~is_tiny].max(initial=SMALLEST))
        steps = min(max(_MOST_STEP / share, 1.0), _MOST_ROUNDINGS)
        changes = np.random.default_rng(len(t)).choice((-2.0, 2.0), len(t)) * steps * self.sizes
        for first in range(min(_GROUPS, moved.size)):
            group, other = moved[first::_GROUPS], t.copy()
            other[group] += changes[group]
            cases.append((other, 1.0 / steps))
        results = []
        for other, weight in cases:
            # The functions of a file may refuse some parameters.
            with suppress(CurveError):
                results.append(Disturbed(curve_through(self._view, self._view.at_knots, other), weight))
        return results

    def _mean_share(self) -> float:
        """Return the mean of the shares over the lengths of the polygon; each counts for its neighbours."""
        lengths = np.linalg.norm(np.diff(self._view.at_knots, axis=0), axis=1)
        return float(self.shares @ np.convolve(lengths, np.ones(3))[1:-1] / max(lengths.sum(), SMALLEST))

    def _with_true_distance(self, knot: int) -> FloatArray:
        """Return the parameters, which count from one of them, with its exact distance to the next."""
        curve, rule, knots = self._view.source, self._view.source.parametrization, self._view.at_knots
        if rule.exponent is None:
            of_one = replace(curve, parametrization=replace(rule, start=0.0, end=1.0))
            spacing = np.diff(parameters_of(of_one, knots))
        else:
            spacing = relative_spacing(knots, rule.exponent, rule.kind.phrase)
        t: FloatArray = self._view.parameters - self._view.parameters[knot]
        t[knot + 1] = (rule.end - rule.start) * (spacing[knot] / spacing.sum())
        for index in range(1, len(t)):
            # Far from this knot parameters may coincide: they stay in order.
            t[index] = max(t[index], np.nextafter(t[index - 1], np.inf))
        return t
