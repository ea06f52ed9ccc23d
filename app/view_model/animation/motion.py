"""A dot that runs along a curve: from time to parameter, and how fast it is there.

At speed 1 the dot takes as many seconds as the domain of the curve is long: where t is in seconds, the
motion is the real one.
"""

from __future__ import annotations

import numpy as np

from curvecore.analysis.lengths import ArcLength
from curvecore.arrays import FloatArray, IntArray

from ..arc_lengths import arc_lengths_of
from ..curve.curve_view import ParametricCurve
from ..geometry import Samples
from .motion_settings import Pace, Repeat

ACCURACY = 1e-6
"""Error allowed in arc lengths, against the whole length: below a pixel."""

STATIONS = 60
"""Equal steps of time from one end of a curve to the other; trails are dots at some of them."""


def round_of(duration: float, repeat: Repeat) -> float:
    """Return the seconds after which everything begins again."""
    return 2.0 * duration if repeat is Repeat.PING_PONG else duration


def folded(seconds: FloatArray, duration: float, repeat: Repeat) -> FloatArray:
    """Return how far along its way, in seconds from the start of the curve, the dot is at `seconds` >= 0."""
    if repeat is Repeat.ONCE:
        return np.minimum(seconds, duration)
    if repeat is Repeat.LOOP:
        return np.asarray(np.fmod(seconds, duration))
    within = np.fmod(seconds, 2.0 * duration)
    return np.where(within <= duration, within, 2.0 * duration - within)


def runs_back(seconds: float, duration: float, repeat: Repeat) -> bool:
    """Whether the dot is on its way back."""
    return repeat is Repeat.PING_PONG and bool(np.fmod(seconds, 2.0 * duration) > duration)


class Course:
    """The way of a dot along one curve.

    Parameters
    ----------
    curve
        Its domain gives the duration.
    pace
        By arc length the dot is equally fast everywhere; a curve without length is run through by t.

    Attributes
    ----------
    duration
        Seconds from one end to the other.
    """

    def __init__(
        self, curve: ParametricCurve, pace: Pace = Pace.PARAMETER, accuracy: float = ACCURACY
    ) -> None:
        self.curve = curve
        self.pace = pace
        self._start, self._end = curve.domain
        self.duration = self._end - self._start
        self._lengths: ArcLength | None = None
        self._speed = 0.0
        self._stations = np.full((STATIONS + 1, 2), np.nan)
        self._is_known = np.zeros(STATIONS + 1, dtype=bool)
        if pace is Pace.LENGTH:
            self._measure(accuracy)

    def _measure(self, accuracy: float) -> None:
        lengths = arc_lengths_of(self.curve, accuracy)
        speed = lengths.total.value / self.duration
        if 0.0 < speed < np.inf:
            self._lengths, self._speed = lengths, speed

    def parameters_at(self, elapsed: FloatArray) -> FloatArray:
        """Return the parameters that the dot has reached after `elapsed` seconds, (m,)."""
        if self._lengths is not None:
            return self._lengths.parameter_at(elapsed * self._speed)
        return np.minimum(self._start + elapsed, self._end)

    def elapsed_at(self, t: float) -> float:
        """Return the seconds after which the dot is at parameter `t`."""
        t = min(max(t, self._start), self._end)
        if self._lengths is not None:
            return min(float(self._lengths.length_at(t)) / self._speed, self.duration)
        return t - self._start

    def stations(self, indices: IntArray) -> FloatArray:
        """Return the points (k, 2) at steps 0 … `STATIONS`; each is computed once."""
        new = np.unique(indices[~self._is_known[indices]])
        if len(new):
            with np.errstate(all="ignore"):
                t = self.parameters_at(new.astype(float) * (self.duration / STATIONS))
                self._stations[new] = self.curve.evaluate(t)
            self._is_known[new] = True
        return np.asarray(self._stations[indices])

    def moments_at(self, t: FloatArray, *, back: bool = False) -> Samples:
        """Return the dot at parameters (m,), with its derivatives per second; on the way back against t."""
        with np.errstate(all="ignore"):
            points, velocities, accelerations = (self.curve.evaluate(t, order) for order in (0, 1, 2))
            if self._lengths is not None:
                velocities, accelerations = _at_even_speed(velocities, accelerations, self._speed)
        return Samples(t, points, -velocities if back else velocities, accelerations)


def _at_even_speed(
    velocities: FloatArray, accelerations: FloatArray, speed: float
) -> tuple[FloatArray, FloatArray]:
    """Return velocity and acceleration of a dot with this speed: all of the latter is due to the bend."""
    # Not the squares of lengths: they would overflow at 1e154.
    length = np.hypot(velocities[:, 0], velocities[:, 1])[:, None]
    rests = length == 0.0
    unit = velocities / np.where(rests, 1.0, length)
    across = accelerations - (accelerations * unit).sum(axis=1, keepdims=True) * unit
    factor = speed / np.where(rests, 1.0, length)
    return unit * speed, np.where(rests, 0.0, across * factor * factor)
