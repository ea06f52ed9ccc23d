"""Plots over t computed: no more samples of the curve than there are pixels, one-sided at joints."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from curvecore import lebesgue_function
from curvecore.arrays import FloatArray, IntArray

from ..curve.curve_view import CurveView
from ..geometry import crowded_at_ends, one_sided
from .plot import Plot, PlotData, PlotLine, Sampled, plot_of

_MOST = 500
"""Samples of a polynomial, as many as the basis panel takes and some."""

_PIXELS_A_SAMPLE = 2.5
_LEAST, _MOST_A_SEGMENT = 3, 96

_QUICK_POINTS = 64
_QUICK_CONSTANT = 1e5
"""Beyond either the core must differentiate a polynomial's basis at every t: many times a frame."""

_ALWAYS_QUICK = 12

_MANY_PIECES = 24

_SAME = 1e-9
"""Values at a joint that differ by less, relative to the greatest of all, are no jump."""


@dataclass(frozen=True, eq=False)
class PlotSamples:
    """Ascending parameters (m,), and the starts of stretches between joints, without the first."""

    t: FloatArray
    starts: IntArray

    def broken_at_jumps(
        self, values: FloatArray, all_values: FloatArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Return (t, values) with a NaN between the two sides of every jump.

        With `all_values` (m, k), a jump of any of them breaks all.
        """
        if not len(self.starts):
            return self.t, values
        judged = values[:, None] if all_values is None else all_values
        with np.errstate(invalid="ignore", over="ignore"):
            size = float(np.max(np.abs(judged), where=np.isfinite(judged), initial=0.0))
            steps = np.abs(judged[self.starts] - judged[self.starts - 1]).max(axis=1)
        jumps = self.starts[steps > _SAME * size]
        return np.insert(self.t, jumps, self.t[jumps]), np.insert(values, jumps, np.nan)


def samples_over(view: CurveView, t_range: tuple[float, float], columns: int) -> PlotSamples:
    """Return the samples of the part of a current curve within `t_range`, over `columns` pixels."""
    knots = view.present_curve.breaks
    start, end = max(t_range[0], float(knots[0])), min(t_range[1], float(knots[-1]))
    if not start < end:
        return PlotSamples(np.empty(0), np.empty(0, dtype=np.intp))
    if len(knots) == 2 and not view.present_curve.is_local:
        return PlotSamples(_of_polynomial(view.parameters, start, end, columns), np.empty(0, dtype=np.intp))
    first = max(int(np.searchsorted(knots, start, side="right")) - 1, 0)
    last = min(int(np.searchsorted(knots, end, side="left")), len(knots) - 1)
    pixels = columns / (t_range[1] - t_range[0])
    return _of_segments(np.clip(knots[first : last + 1], start, end), pixels, knots)


def _of_polynomial(knots: FloatArray, start: float, end: float, columns: int) -> FloatArray:
    """Return samples of one polynomial; the knots, where Λ is 1, are some."""
    t = crowded_at_ends(start, end, min(max(columns, 2), _MOST))
    inside = knots[(knots > start) & (knots < end)]
    t = np.concatenate([t, inside]) if len(inside) < len(t) / 2 else t
    return np.unique(np.clip(t, start, end))


def _of_segments(cuts: FloatArray, pixels: float, knots: FloatArray) -> PlotSamples:
    """Return samples of every segment between cuts, in proportion to its pixels, both ends included."""
    spacing = np.diff(cuts)
    counts = np.clip(np.ceil(spacing * pixels / _PIXELS_A_SAMPLE), _LEAST, _MOST_A_SEGMENT).astype(np.intp)
    t, first = one_sided(cuts, counts)
    if cuts[-1] < knots[-1]:
        t[-1] = np.nextafter(cuts[-1], cuts[-2])
    return PlotSamples(t, first[1:-1].astype(np.intp))


def derivatives_of(view: CurveView, t: FloatArray, orders: tuple[int, ...]) -> dict[int, FloatArray]:
    """Return derivatives (m, 2) of a current curve by their order."""
    if not orders:
        return {}
    # Overflows are infinite, and leave the plot.
    with np.errstate(all="ignore"):
        return dict(zip(orders, view.present_curve.derivatives_at(t, orders), strict=True))


def is_slow(view: CurveView) -> bool:
    """Whether derivatives at as many t as a plot has pixels take longer than a frame."""
    curve = view.curve
    if curve is None or curve.is_local:
        return len(view.pieces) > _MANY_PIECES
    count = len(curve.parameters)
    if count <= _ALWAYS_QUICK or count > _QUICK_POINTS:
        return count > _QUICK_POINTS
    # Λ is largest near an end, in the middle between two parameters.
    ends = curve.parameters[[0, 1, -2, -1]]
    return bool(lebesgue_function(curve, (ends[::2] + ends[1::2]) / 2).max() > _QUICK_CONSTANT)


def plots_of(
    view: CurveView,
    plots: Collection[Plot],
    t_range: tuple[float, float],
    columns: int,
    lebesgue_constant: float = 1.0,
) -> list[PlotData]:
    """Return the plots of a curve over the visible part of t, which is `columns` pixels wide."""
    if not view.is_current:
        return []
    samples = samples_over(view, t_range, columns)
    derivatives = derivatives_of(view, samples.t, orders_of(plots)) if len(samples.t) else {}
    sampled = Sampled(view, samples.t, derivatives, lebesgue_constant)
    return [_plotted(plot, sampled, samples) for plot in _in_order(plots)]


def orders_of(plots: Collection[Plot]) -> tuple[int, ...]:
    """Return the orders of the derivatives that these plots need."""
    return tuple(sorted({order for plot in plots for order in plot.orders}))


def uncertain_values_at(
    view: CurveView, plots: Collection[Plot], t: float
) -> dict[Plot, tuple[float, float]]:
    """Return values at one t, at a joint those of the segment after it, and their errors by rounding."""
    if not view.is_current:
        return {}
    at = np.array([t])
    sampled = Sampled(view, at, derivatives_of(view, at, orders_of(plots)))
    return {plot: (plot.values(sampled).item(), plot.errors(sampled).item()) for plot in _in_order(plots)}


def _plotted(plot: Plot, sampled: Sampled, samples: PlotSamples) -> PlotData:
    values = plot.values(sampled) if len(sampled.t) else np.empty(0)
    line = PlotLine(plot.title, *samples.broken_at_jumps(values))
    return plot.finish(plot_of(plot.title, [line], plot.scale, plot.symbol), sampled)


def _in_order(plots: Collection[Plot]) -> list[Plot]:
    return sorted(plots, key=lambda plot: plot.sort_key)
