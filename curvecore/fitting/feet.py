"""Feet of perpendiculars from data near a curve."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.families.curve import ParametricCurve

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
        """Return the curve's own cubics, or those through some of its places."""
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
        """Return where the curve lies from the data, and its velocity, each (dim, m) like the data."""
        piece = np.searchsorted(self.breaks[1:-1], t, side="right")
        length = np.diff(self.breaks)[piece]
        x = (t - self.breaks[piece]) / length
        a, b, c, d = self.coefficients.take(piece, axis=-1)
        return a + x * (b + x * (c + x * d)) - data, (b + x * (2.0 * c + x * 3.0 * d)) / length
