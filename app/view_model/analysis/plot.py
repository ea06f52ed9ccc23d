"""The record of a plot over t, and its data: lines of (t, value) on a linear or a logarithmic scale.

`Plot.values` gets a `Sampled` curve and returns a value for each t. The recipe for a new plot stands in
``plots``.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..line_styles import USUAL_STYLE, LineStyle
from ..registry import Registry

if TYPE_CHECKING:
    from ..curve.curve_view import CurveView


class Scale(enum.Enum):
    """The scale of values."""

    LINEAR = enum.auto()
    """Zero is always visible."""
    LOG = enum.auto()
    """Zero and negative values lie below the plot."""


class PlotLine(msgspec.Struct, frozen=True, eq=False):
    """Values over t.

    Attributes
    ----------
    name
        Its name, for a plot with several lines.
    t, values
        Ascending parameters (m,) and the values there (m,), of any size. At a NaN the line is interrupted,
        and both ends are marked: a jump.
    style
        Its style; its width is that of all plots.
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
    """A value that is marked across the whole plot, and its name."""

    value: float
    name: str


class PlotData(msgspec.Struct, frozen=True, eq=False):
    """One plot.

    Attributes
    ----------
    title
        Its name; no two plots of a pane have the same.
    symbol
        The text before its value in the header.
    extent
        The least and the greatest visible value; values beyond leave the plot.
    note
        A few words beside the title, such as the greatest value beyond the plot.
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
    return PlotData(title, symbol, scale, tuple(lines), extent_of([line.values for line in lines], scale))


def extent_of(values: Sequence[FloatArray], scale: Scale) -> tuple[float, float]:
    """Return the least and the greatest value that can be shown on a scale; (1, 1) for none."""
    every = np.concatenate([np.empty(0), *values])
    displayable = every[np.isfinite(every) & ((every > 0) | (scale is Scale.LINEAR))]
    return (float(displayable.min()), float(displayable.max())) if len(displayable) else (1.0, 1.0)


class Sampled(msgspec.Struct, frozen=True, eq=False):
    """A current curve sampled for plots.

    Attributes
    ----------
    t
        Ascending parameters (m,).
    derivatives
        Derivatives (m, 2) there, by their order: those that the plots need.
    lebesgue_constant
        The largest factor by which errors of its points grow.
    """

    view: CurveView
    t: FloatArray
    derivatives: dict[int, FloatArray]
    lebesgue_constant: float = 1.0


class Plot(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """Something that can be plotted over t; compares by identity.

    Attributes
    ----------
    name
        A word in lower case, of which its object names are made.
    text, tip, icon
        Those of its action.
    title, symbol
        The text beside the plot, and before its value.
    rank
        The key by which records are sorted in menus and panels.
    orders
        Orders of the derivatives that it needs.
    values
        Computes its values (m,), each from the view and its t alone: the t are the visible ones, or that of
        the scrub line. A sum along the curve begins at the start of its domain.
    errors
        Bounds of the errors of the values by rounding, where these matter.
    follows_points
        Whether it changes where points move and parameters stay.
    finish
        Sets the extent, adds levels and a note.
    """

    name: str
    text: str
    tip: str
    title: str
    symbol: str
    rank: int
    values: Callable[[Sampled], FloatArray]
    icon: str = ""
    orders: tuple[int, ...] = ()
    scale: Scale = Scale.LINEAR
    errors: Callable[[Sampled], FloatArray] = lambda sampled: np.zeros(len(sampled.t))
    follows_points: bool = True
    finish: Callable[[PlotData, Sampled], PlotData] = lambda plot, _sampled: plot

    @property
    def sort_key(self) -> tuple[int, ...]:
        """The key by which records are sorted in menus and panels."""
        return (self.rank,)

    @property
    def action_name(self) -> str:
        """The object name of its action: plotSpeed."""
        return f"plot{self.name.capitalize()}"


PLOTS = Registry(Plot, f"{__package__}.plots")
"""All plots over t, in the order in which they stand below each other."""
