"""The arc of a radius that touches both sides of a corner, of which one at least is curved.

Its centre lies where the two parallel curves at that distance meet. It is followed from an arc that is next
to nothing, in the corner itself, as the radius grows: until the one that is asked for, or the largest.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from curvecore.arrays import FloatArray

from .corner_arc import Arc, pieces_about

ComplexArray = NDArray[np.complexfloating[Any, Any]]

_BEGIN = 1e-3
"""Share of the shorter side that the first arc reaches along it."""

_STEPS = 8
"""Steps in which the radius grows, where nothing hinders it."""

_FINEST = 1e-12
"""Share of the radius below which no step is tried: the largest arc that fits is exact to that."""

_EXACT = 1e-13
"""Share of the radius, or of the largest coordinate, by which the parallel curves may miss each other."""

_CLEAR = 1e-7
"""Share of the radius by which a side may be nearer to the centre than where the arc touches it."""

_LEAST_TURN, _MOST_TURN = 1e-3, 1.5 * math.pi
"""Angles in radians between which arcs turn."""


class Side:
    """A segment beside a corner: a polynomial on [0, 1], by its Bézier control points."""

    def __init__(self, controls: FloatArray) -> None:
        self.controls = controls
        self._orders = [controls]
        while len(self._orders) < 4:
            last = self._orders[-1]
            self._orders.append(
                np.diff(last, axis=0) * (len(last) - 1) if len(last) > 1 else np.zeros((1, 2))
            )

    def at(self, u: float, order: int = 0) -> FloatArray:
        """Return the place at `u`, or a derivative there; order 3 at most."""
        rows = self._orders[order]
        while len(rows) > 1:
            rows = rows[:-1] * (1.0 - u) + rows[1:] * u
        return np.asarray(rows[0])

    @cached_property
    def powers(self) -> list[list[complex]]:
        """The coefficients of it and of its derivatives up to order 2, the highest first, x + iy each."""
        # Of so low a degree on [0, 1] they lose hardly a digit, and plain numbers are far faster than arrays.
        found = []
        for rows in self._orders[:3]:
            n, ways = len(rows) - 1, [complex(x, y) for x, y in rows.tolist()]
            found.append(
                [
                    math.comb(n, k) * sum((-1) ** (k - j) * math.comb(k, j) * ways[j] for j in range(k + 1))
                    for k in range(n, -1, -1)
                ]
            )
        return found

    def sight(self, u: float) -> tuple[complex, complex, complex]:
        """Return the place at `u` and the first two derivatives there, x + iy each."""
        first, second, third = (_horner(each, u) for each in self.powers)
        return first, second, third

    @cached_property
    def sampled(self) -> tuple[FloatArray, ComplexArray]:
        """Parameters and the places there, x + iy each."""
        u = np.linspace(0.0, 1.0, 129)
        return u, np.polyval(self.powers[0], u)

    @cached_property
    def length(self) -> float:
        """The length of the way through the control points."""
        return float(np.hypot(*np.diff(self.controls, axis=0).T).sum())


class _Touch(NamedTuple):
    """An arc by its radius, where it touches the sides, and the angle by which it turns."""

    radius: float
    u: float
    v: float
    turn: float


@dataclass(frozen=True, eq=False)
class CurvedCorner:
    """A corner of which one side at least is curved: the sides that lead to it and on, and its directions."""

    behind: Side
    ahead: Side
    towards: FloatArray
    onwards: FloatArray
    _found: dict[float, _Touch | None] = field(default_factory=dict)

    @cached_property
    def _angle(self) -> float:
        """Angle in radians by which the curve turns at the corner, above 0 to the left."""
        (a, b), (c, d) = self.towards, self.onwards
        return math.atan2(a * d - b * c, a * c + b * d)

    def shares(self, radius: float) -> tuple[float, float]:
        """Return how much of both sides an arc would take; of one that does not fit, the largest."""
        touch = self._largest(radius)
        return (0.0, 0.0) if touch is None else (1.0 - touch.u, touch.v)

    def arc(self, radius: float, room: tuple[float, float]) -> Arc | None:
        """Return the arc, or the largest one within shares of both sides; None where none touches both."""
        touch = self._largest(radius)
        if touch is not None and not (1.0 - room[0] <= touch.u and touch.v <= room[1]):
            touch = self._touch(radius, room)
        if touch is None:
            return None
        start, end = (_unit(each.at(at, 1)) for each, at in ((self.behind, touch.u), (self.ahead, touch.v)))
        side = math.copysign(touch.radius, touch.turn)
        centre = self.behind.at(touch.u) + side * np.array([-start[1], start[0]])
        pieces = pieces_about(centre, touch.radius, start, end, touch.turn)
        return Arc(self.behind.at(touch.u), pieces, touch.radius, (1.0 - touch.u, touch.v))

    def _largest(self, radius: float) -> _Touch | None:
        """Return the arc of a radius that has both sides to itself, or the largest."""
        if radius not in self._found:
            self._found[radius] = self._touch(radius, (1.0, 1.0))
        return self._found[radius]

    def _touch(self, radius: float, room: tuple[float, float]) -> _Touch | None:
        """Follow the arc as its radius grows, and halve the step where it does not fit any more."""
        slope = math.tan(abs(self._angle) / 2)
        first = min(_BEGIN * min(self.behind.length, self.ahead.length) / slope, radius)
        reach = first * slope
        u = _share_within(self.behind, reach, from_end=True)
        found = self._solved(first, u, _share_within(self.ahead, reach, from_end=False), room)
        if found is None:
            return None
        before, step = found, (radius - first) / _STEPS
        while found.radius < radius and step > _FINEST * found.radius:
            # Reached exactly, whatever the steps add up to.
            aim = radius if found.radius + step * (1 + 1e-9) >= radius else found.radius + step
            part = (aim - found.radius) / (found.radius - before.radius) if found is not before else 0.0
            u, v = (b + (b - a) * part for a, b in ((before.u, found.u), (before.v, found.v)))
            after = self._solved(aim, u, v, room)
            if after is None:
                step /= 2
            else:
                before, found, step = found, after, min(step * 2, (radius - first) / _STEPS)
        return found

    def _solved(self, radius: float, u: float, v: float, room: tuple[float, float]) -> _Touch | None:
        """Return the arc of a radius that touches near two places; None where there is none that fits."""
        side = math.copysign(1.0, self._angle)
        size = max(radius, *(float(np.abs(each.controls).max()) for each in (self.behind, self.ahead)))
        for _ in range(12):
            one, other = (
                _Parallel.of(each, at, side * radius) for each, at in ((self.behind, u), (self.ahead, v))
            )
            if min(one.stretch, other.stretch) <= 0.0:
                # The parallel curve has a cusp there: the side is more curved than the arc.
                return None
            determinant = _cross(other.way, one.way)
            if not determinant:
                return None
            miss = one.place - other.place
            u += _cross(miss, other.way) / determinant
            v += _cross(miss, one.way) / determinant
            u, v = min(max(u, -0.5), 1.5), min(max(v, -0.5), 1.5)
            if abs(miss) <= _EXACT * size:
                return self._fitting(radius, u, v, room)
        return None

    def _fitting(self, radius: float, u: float, v: float, room: tuple[float, float]) -> _Touch | None:
        """Return an arc where it is on both sides, within the room there, and crosses neither."""
        if not (1.0 - room[0] <= u < 1.0 and 0.0 < v <= room[1]):
            return None
        side = math.copysign(1.0, self._angle)
        (place, start, _), (_, end, _) = self.behind.sight(u), self.ahead.sight(v)
        centre = place + side * radius * 1j * start / abs(start)
        turn = cmath.phase(end / start)
        if side * turn < -_LEAST_TURN:
            turn += side * 2 * math.pi
        if not _LEAST_TURN <= side * turn <= _MOST_TURN:
            return None
        for each, low, high in ((self.behind, 0.0, u), (self.ahead, v, 1.0)):
            at, places = each.sampled
            rest = places[(at >= low) & (at <= high)]
            if len(rest) and np.abs(rest - centre).min() < radius * (1 - _CLEAR):
                return None
        return _Touch(radius, u, v, turn)


class _Parallel(NamedTuple):
    """A point of a parallel curve: its place, its derivative, and how much longer that is than the side's."""

    place: complex
    way: complex
    stretch: float

    @classmethod
    def of(cls, side: Side, u: float, distance: float) -> _Parallel:
        """Return the point at a distance to the left of that at `u`."""
        place, way, bend = side.sight(u)
        speed = abs(way)
        if not speed:
            return cls(place, 0j, 0.0)
        stretch = 1.0 - distance * _cross(way, bend) / speed**3
        return cls(place + distance * 1j * way / speed, way * stretch, stretch)


def _horner(coefficients: list[complex], u: float) -> complex:
    value = 0j
    for each in coefficients:
        value = value * u + each
    return value


def _cross(one: complex, other: complex) -> float:
    return one.real * other.imag - one.imag * other.real


def _unit(way: FloatArray) -> FloatArray:
    return np.asarray(way / math.hypot(*way))


def _share_within(side: Side, reach: float, *, from_end: bool) -> float:
    """Return the parameter up to which a side stays within a distance of its one end, or of the other."""
    corner, low, high = side.controls[-1 if from_end else 0], 0.0, 1.0
    place = complex(*corner.tolist())
    for _ in range(40):
        middle = (low + high) / 2
        if abs(_horner(side.powers[0], 1.0 - middle if from_end else middle) - place) < reach:
            low = middle
        else:
            high = middle
    return 1.0 - high if from_end else high
