"""Curves through points and parameters that were disturbed at random."""

from __future__ import annotations

from functools import partial

import numpy as np

import curvecore

from ...curve.core_curve import in_words
from ...curve.curve_view import curve_through
from ...geometry import all_along
from ...line_styles import LineStyle
from ...settings import Count, OwnedSetting
from ..overlay import (
    PARAMETER_ERROR,
    POINT_ERROR,
    Figure,
    Figures,
    Group,
    Overlay,
    OverlayInput,
    Shape,
    errors_text,
)

LINES = LineStyle("muted", 0.3)

COUNT = Count("ensembleCount", "Number of curves", 30, limits=(1, 200))
SEED = OwnedSetting("ensembleSeed", "Seed of the random numbers", 0)

_SAMPLES = 240


def ensemble(data: OverlayInput) -> Figures:
    """Return the curves as one figure, or a note why there are none; heavy."""
    curve, seed = data.view.curve, data.value(SEED)
    if curve is None:
        return Figures()
    try:
        disturbed = curvecore.ensemble(
            curve,
            data.value(POINT_ERROR),
            data.value(PARAMETER_ERROR),
            data.value(COUNT),
            seed,
            closed=data.view.source.is_closed,
            remake=partial(curve_through, data.view) if data.view.source.family.derivatives else None,
        )
    except curvecore.CurveError as reason:
        text = in_words(str(reason).replace("parameter_error", "δ"))
        return Figures(note=f"Not drawn: {text}.")
    per_segment = max(_SAMPLES // (len(curve.parameters) - 1), 3)
    curves = disturbed.evaluate(all_along(curve.parameters, per_segment))
    lines = np.concatenate([curves, np.full((len(curves), 1, 2), np.nan)], axis=1)
    note = f"{len(curves)} curves, seed {seed}."
    return Figures([Figure(LINES, Shape.LINE, lines.reshape(-1, 2))], note)


ENSEMBLE = Overlay(
    name="ensemble",
    text="Disturbed Curves",
    tip="Draw curves through points and parameters with random errors",
    key="Ctrl+Alt+9",
    icon="ensemble",
    group=Group.ERRORS,
    rank=100,
    layer=0,
    draw=ensemble,
    settles=lambda _view: True,
    settings=(COUNT, POINT_ERROR, PARAMETER_ERROR, SEED),
    legend=lambda _view, settings: [
        (LINES, f"{settings.value(COUNT)} random cases, {errors_text(settings)}")
    ],
)
