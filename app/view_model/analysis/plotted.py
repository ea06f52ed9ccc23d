"""The plots over t that are switched on, computed."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ..curve.curve_view import CurveView
from .plot import Plot, Sampled
from .plot_lines import PlotData, PlotLine, plot_of
from .plot_samples import PlotSamples, derivatives_of, samples_over


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
