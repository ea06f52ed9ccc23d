"""The plots over t: speed, acceleration, jerk, curvature and the Lebesgue function."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from app.document.words import number
from app.view_model.analysis.plot_lines import Floats, Level, PlotData, PlotLine, Scale, extent_of
from app.view_model.analysis.plot_samples import derivatives_of, samples_over
from app.view_model.analysis.settings import Plot
from app.view_model.curve_view import CurveView
from app.view_model.growth import growth_at
from curvecore import curvature_of
from curvecore.vectors import vector_lengths

TITLES = {
    Plot.SPEED: "Speed |c′|",
    Plot.ACCELERATION: "Acceleration |c″|",
    Plot.JERK: "Jerk |c‴|",
    Plot.CURVATURE: "Curvature κ",
    Plot.LEBESGUE: "Lebesgue function Λ(t)",
}

SYMBOLS = {
    Plot.SPEED: "|c′|",
    Plot.ACCELERATION: "|c″|",
    Plot.JERK: "|c‴|",
    Plot.CURVATURE: "κ",
    Plot.LEBESGUE: "Λ(t)",
}

_ORDERS = {
    Plot.SPEED: (1,),
    Plot.ACCELERATION: (2,),
    Plot.JERK: (3,),
    Plot.CURVATURE: (1, 2),
    Plot.LEBESGUE: (),
}

_SPIKE = 6.0
"""How far a curvature may surpass nine tenths of all: at a cusp it would be infinite."""


def plots_of(
    view: CurveView,
    kinds: Collection[Plot],
    t_range: tuple[float, float],
    columns: int,
    lebesgue_constant: float = 1.0,
) -> list[PlotData]:
    """Return the plots of a curve over the visible part of t, which is `columns` pixels wide."""
    if not view.is_current:
        return []
    samples = samples_over(view, t_range, columns)
    derivatives = derivatives_of(view, samples.t, orders_of(kinds)) if len(samples.t) else {}
    plots = []
    for kind in Plot:
        if kind in kinds:
            values = _values(kind, view, samples.t, derivatives) if len(samples.t) else np.empty(0)
            line = PlotLine(TITLES[kind], *samples.broken_at_jumps(values))
            plots.append(_plot(kind, line, lebesgue_constant))
    return plots


def orders_of(kinds: Collection[Plot]) -> tuple[int, ...]:
    """Return the orders of the derivatives that these plots need."""
    return tuple(sorted({order for kind in kinds for order in _ORDERS[kind]}))


def values_at(view: CurveView, kinds: Collection[Plot], t: float) -> dict[Plot, float]:
    """Return the value of each plot at one t; at a joint, that of the segment after it."""
    if not view.is_current:
        return {}
    at = np.array([t])
    derivatives = derivatives_of(view, at, orders_of(kinds))
    return {kind: float(_values(kind, view, at, derivatives)[0]) for kind in Plot if kind in kinds}


def _plot(kind: Plot, line: PlotLine, lebesgue_constant: float) -> PlotData:
    scale = Scale.LOG if kind is Plot.LEBESGUE else Scale.LINEAR
    extent, note = extent_of([line.values], scale), ""
    levels: tuple[Level, ...] = ()
    if kind is Plot.CURVATURE:
        extent, note = _without_spikes(line.values, extent)
    if kind is Plot.LEBESGUE:
        constant = max(lebesgue_constant, 1.0)
        extent = (1.0, max(extent[1], constant))
        levels = (Level(constant, _about(constant)),)
    return PlotData(TITLES[kind], SYMBOLS[kind], scale, (line,), extent, levels, note)


def _values(kind: Plot, view: CurveView, t: Floats, derivatives: dict[int, Floats]) -> Floats:
    assert view.curve is not None
    if kind is Plot.LEBESGUE:
        return np.maximum(growth_at(view, t), 1.0)
    if kind is Plot.CURVATURE:
        return curvature_of(derivatives[1], derivatives[2])
    return vector_lengths(derivatives[_ORDERS[kind][0]])


def _about(constant: float) -> str:
    """Return what is written at the Lebesgue constant."""
    if constant < 1.0 + 1e-9:
        return "Lebesgue constant Λ = 1: no error of a point grows"
    return f"Lebesgue constant Λ = {number(constant, 3)}"


def _without_spikes(values: Floats, extent: tuple[float, float]) -> tuple[tuple[float, float], str]:
    """Return an extent that a few huge values do not decide, and what lies beyond it in words."""
    sizes = np.abs(values[np.isfinite(values)])
    if not len(sizes):
        return extent, ""
    limit = _SPIKE * float(np.quantile(sizes, 0.9))
    low, high = max(extent[0], -limit), min(extent[1], limit)
    if limit == 0 or (low, high) == extent:
        return extent, ""
    far = extent[0] if -extent[0] > extent[1] else extent[1]
    return (low, high), f"⚠ reaches {number(far, 3)}"
