"""The Lebesgue function over t: the growth of errors of the points."""

from __future__ import annotations

from math import isfinite

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ....document.words import number
from ...basis import growth_at
from ..plot import Level, Plot, PlotData, Sampled, Scale


def _values(sampled: Sampled) -> FloatArray:
    return np.maximum(growth_at(sampled.view, sampled.t), 1.0)


def _with_constant(plot: PlotData, sampled: Sampled) -> PlotData:
    constant = max(sampled.lebesgue_constant, 1.0)
    extent = (1.0, max(plot.extent[1], constant))
    words = " ".join(filter(None, (_about(constant), sampled.view.growth_holds)))
    return replace(plot, extent=extent, levels=(Level(constant, words),))


def _about(constant: float) -> str:
    """Return the text at the level of the Lebesgue constant."""
    if constant < 1.0 + 1e-9:
        return "Lebesgue constant Λ = 1: errors of points do not grow"
    return f"Lebesgue constant Λ = {number(constant, 3) if isfinite(constant) else '∞'}"


LEBESGUE = Plot(
    name="lebesgue",
    text="Lebesgue Function",
    tip="Plot Λ(t): the factor by which errors of the points can grow at t",
    icon="plot-lebesgue",
    title="Lebesgue function Λ(t)",
    symbol="Λ(t)",
    rank=50,
    values=_values,
    scale=Scale.LOG,
    follows_points=False,
    finish=_with_constant,
)
