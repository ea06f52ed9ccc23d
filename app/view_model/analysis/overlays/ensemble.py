"""Curves through points and parameters that were disturbed at random."""

from __future__ import annotations

from functools import partial

import numpy as np

import curvecore

from ...curve.core_curve import in_words
from ...curve.curve_view import curve_through
from ...geometry import all_along
from ...line_styles import LineStyle
from ..errors import PARAMETER_ERROR, POINT_ERROR, errors_text
from ..figures import Figure, Shape
from ..overlay import Drawn, Group, Overlay
from ..overlay_settings import Count, OverlaySetting
from ..scene import Scene

LINES = LineStyle("muted", 0.3)

COUNT = Count("ensembleCount", "Number of curves", 30, least=1, most=200)
SEED = OverlaySetting("ensembleSeed", "Which random numbers")

_SAMPLES = 240


def _disturbed_curves(scene: Scene) -> Drawn:
    """Return the curves as one figure, or in words why there are none; heavy."""
    curve, seed = scene.view.curve, int(scene.value(SEED))
    if curve is None:
        return [], ""
    try:
        made = curvecore.ensemble(
            curve,
            scene.value(POINT_ERROR),
            scene.value(PARAMETER_ERROR),
            int(scene.value(COUNT)),
            seed,
            closed=scene.view.source.is_closed,
            remake=partial(curve_through, scene.view) if scene.view.source.family.derivatives else None,
        )
    except curvecore.CurveError as reason:
        text = in_words(str(reason).replace("parameter_error", "δ"))
        return [], f"Not drawn: {text}."
    per_segment = max(_SAMPLES // (len(curve.parameters) - 1), 3)
    curves = made.evaluate(all_along(curve.parameters, per_segment))
    lines = np.concatenate([curves, np.full((len(curves), 1, 2), np.nan)], axis=1)
    words = f"{len(curves)} curves, seed {seed}."
    return [Figure(LINES, Shape.LINE, lines.reshape(-1, 2))], words


ENSEMBLE = Overlay(
    name="ensemble",
    text="Disturbed Curves",
    tip="Draw curves through points and parameters with random errors",
    key="Ctrl+Alt+9",
    icon="ensemble",
    group=Group.ERRORS,
    rank=100,
    layer=0,
    draw=_disturbed_curves,
    settles=lambda _view: True,
    settings=(COUNT, POINT_ERROR, PARAMETER_ERROR, SEED),
    legend=lambda _view, settings: [
        (LINES, f"{settings.value(COUNT):.0f} random cases, {errors_text(settings)}")
    ],
)
