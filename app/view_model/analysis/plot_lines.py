"""The data of a plot over t: lines of (t, value), on a linear or a logarithmic scale."""

from __future__ import annotations

import enum
from collections.abc import Sequence

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..line_styles import USUAL_STYLE, LineStyle


class Scale(enum.Enum):
    """The scales of values."""

    LINEAR = enum.auto()
    """Zero is always in sight."""
    LOG = enum.auto()
    """Zero and negative values lie below the plot."""


class PlotLine(msgspec.Struct, frozen=True, eq=False):
    """Values over t.

    Attributes
    ----------
    name
        Its name, shown where a plot has several lines.
    t, values
        Ascending parameters (m,) and the values there (m,), of any size. At a NaN the line is interrupted,
        and both ends are marked: a jump.
    style
        Its look; its width is that of all plots.
    """

    name: str
    t: FloatArray
    values: FloatArray
    style: LineStyle = USUAL_STYLE

    def value_at(self, t: float) -> float:
        """Return the value of the nearest sample; NaN where there is none near."""
        if not len(self.t) or not self.t[0] <= t <= self.t[-1]:
            return float("nan")
        after = int(np.searchsorted(self.t, t))
        near = slice(max(after - 2, 0), after + 2)
        known = ~np.isnan(self.values[near])
        nearest = np.argmin(np.where(known, np.abs(self.t[near] - t), np.inf))
        return float(self.values[near][nearest])


class Level(msgspec.Struct, frozen=True):
    """A value that is marked across the whole plot, and what it is."""

    value: float
    name: str


class PlotData(msgspec.Struct, frozen=True, eq=False):
    """One plot.

    Attributes
    ----------
    title
        Its name; no two plots of a pane have the same.
    symbol
        The words before its value in the header.
    extent
        The least and the greatest value worth seeing; values beyond run out of the plot.
    note
        A few words beside the title, such as how far the values run out of the plot.
    """

    title: str
    symbol: str
    scale: Scale
    lines: tuple[PlotLine, ...]
    extent: tuple[float, float]
    levels: tuple[Level, ...] = ()
    note: str = ""


def plot_of(title: str, lines: Sequence[PlotLine], scale: Scale, symbol: str = "") -> PlotData:
    """Return a plot of these lines that shows all of their values."""
    return PlotData(title, symbol, scale, tuple(lines), extent_of([each.values for each in lines], scale))


def extent_of(values: Sequence[FloatArray], scale: Scale) -> tuple[float, float]:
    """Return the least and the greatest value that can be shown on a scale; (1, 1) for none."""
    every = np.concatenate([np.empty(0), *values])
    shown = every[np.isfinite(every) & ((every > 0) | (scale is Scale.LINEAR))]
    return (float(shown.min()), float(shown.max())) if len(shown) else (1.0, 1.0)
