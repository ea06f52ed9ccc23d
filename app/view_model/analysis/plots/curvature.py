"""The curvature over t."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore.arithmetic import SMALLEST
from curvecore.arrays import FloatArray

from ....document.words import number
from ...curve.rounded_parameters import curvature_error
from ...geometry import size_of
from ..plot import Plot, PlotData, Sampled

_STRAIGHT = 1e-9
"""Share of 1 / size below which a curvature counts as zero."""

_SPIKE = 6.0
"""Largest factor of a curvature over nine tenths of all: at a cusp it would be infinite."""


def _without_spikes(plot: PlotData, _sampled: Sampled) -> PlotData:
    """Return the plot with an extent that ignores a few huge values, and a note with the greatest."""
    values = plot.lines[0].values
    sizes = np.abs(values[np.isfinite(values)])
    if not len(sizes):
        return plot
    limit = _SPIKE * float(np.quantile(sizes, 0.9))
    low, high = max(plot.extent[0], -limit), min(plot.extent[1], limit)
    if limit == 0 or (low, high) == plot.extent:
        return plot
    far = plot.extent[0] if -plot.extent[0] > plot.extent[1] else plot.extent[1]
    return replace(plot, extent=(low, high), note=f"⚠ reaches {number(far, 3)}")


def _rounding(sampled: Sampled) -> FloatArray:
    error = curvature_error(sampled.view, sampled.t)
    return np.where(error < _STRAIGHT / max(size_of(sampled.view.points), SMALLEST), 0.0, error)


CURVATURE = Plot(
    name="curvature",
    text="Curvature",
    tip="Plot the curvature κ over t, positive where the curve turns left",
    icon="plot-curvature",
    title="Curvature κ",
    symbol="κ",
    rank=40,
    orders=(1, 2),
    values=lambda sampled: curvecore.curvature_of(sampled.derivatives[1], sampled.derivatives[2]),
    errors=_rounding,
    finish=_without_spikes,
)
