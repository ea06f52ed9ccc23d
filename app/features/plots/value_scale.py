"""From values of any size to the height of a plot and back to numbers at its axis."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from curvecore.arrays import FloatArray

from ...document.words import number, with_minus
from ...view_model.analysis.plot import PlotData, Scale

_MARGIN = 0.06
_LEAST_DECADES = math.log10(2)
_LARGEST, _SMALLEST = 1e300, 1e-300

_FAR = 50.0
"""Heights of the plot beyond which a value need not be where it is."""

_PLAIN = (-3, 4)
"""Powers of ten that are written out."""

_STEPS = (1, 2, 5, 10)


@dataclass(frozen=True)
class ValueScale:
    """The values at the foot and at the head of a plot.

    pyqtgraph loses ranges above 1e150; so what it sees is the share of the height, from 0 to 1.
    """

    low: float
    high: float
    scale: Scale

    @classmethod
    def of(cls, plot: PlotData) -> ValueScale:
        """Return a scale that shows the extent of a plot, with a little room above."""
        least, greatest = (float(np.clip(value, -_LARGEST, _LARGEST)) for value in plot.extent)
        if plot.scale is Scale.LOG:
            least, greatest = max(least, _SMALLEST), max(greatest, _SMALLEST)
            high = max(math.log10(greatest), math.log10(least) + _LEAST_DECADES)
            room = _MARGIN * (high - math.log10(least))
            return cls(least, 10 ** min(high + room, 307.0), plot.scale)
        low, high = min(least, 0.0), max(greatest, 0.0)
        if low == high:
            return cls(0.0, 1.0, plot.scale)
        room = _MARGIN * (high - low)
        return cls(low - room if low < 0 else 0.0, high + room if high > 0 else 0.0, plot.scale)

    def holding(self, other: ValueScale) -> ValueScale:
        """Return a scale that shows what either shows."""
        if other.scale is not self.scale:
            return other
        return ValueScale(min(self.low, other.low), max(self.high, other.high), self.scale)

    def shares(self, values: FloatArray) -> FloatArray:
        """Return how high values stand: 0 at the foot, 1 at the head; NaN stays."""
        with np.errstate(all="ignore"):
            if self.scale is Scale.LOG:
                low, high = math.log10(self.low), math.log10(self.high)
                shares = (np.log10(np.where(values < 0, 0.0, values)) - low) / (high - low)
            else:
                # Halved, because the difference of two huge numbers must not overflow.
                shares = (values / 2 - self.low / 2) / (self.high / 2 - self.low / 2)
        return np.asarray(np.clip(shares, -_FAR, 1 + _FAR))

    def share(self, value: float) -> float:
        """Return how high one value stands."""
        return float(self.shares(np.array([value]))[0])

    def ticks(self, most: int) -> list[tuple[float, str]]:
        """Return (share, number) of at most so many round values, and at least one."""
        values = self._powers(most) if self.scale is Scale.LOG else self._multiples(most)
        return [(share, text) for value, text in values if -1e-9 <= (share := self.share(value)) <= 1 + 1e-9]

    def _powers(self, most: int) -> list[tuple[float, str]]:
        first, last = math.ceil(math.log10(self.low) - 1e-9), math.floor(math.log10(self.high) + 1e-9)
        stride = max(-(-(last - first + 1) // max(most, 1)), 1)
        powers = range(first, last + 1, stride)
        found = [(10.0**power, _power_text(1, power)) for power in powers]
        if last - first <= 0 or 3 * (last - first + 1) <= most:
            # Little more than one power of ten: what lies between says more.
            around = range(first - 1, last + 1)
            found += [(f * 10.0**power, _power_text(f, power)) for power in around for f in (2, 5)]
        return found

    def _multiples(self, most: int) -> list[tuple[float, str]]:
        least = (self.high / 2 - self.low / 2) / max(most, 1) * 2
        power = math.floor(math.log10(least))
        steps = [step * 10.0**exponent for exponent in (power - 1, power) for step in _STEPS]
        unit = min((step for step in steps if step >= least * (1 - 1e-9)), default=steps[-1])
        # Zero by itself says nothing.
        smaller = (step for step in reversed(steps) if step <= unit and max(self.high, -self.low) >= step)
        unit = next(smaller, unit)
        first, last = math.ceil(self.low / unit - 1e-9), math.floor(self.high / unit + 1e-9)
        return [(count * unit, number(count * unit)) for count in range(first, last + 1)]


def _power_text(factor: int, power: int) -> str:
    if _PLAIN[0] <= power <= _PLAIN[1]:
        return number(factor * 10.0**power)
    return with_minus(f"{factor}e{power}")
