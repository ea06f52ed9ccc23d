"""Curves through points and parameters that were disturbed at random."""

from __future__ import annotations

import numpy as np

from app.view_model.analysis.figures import Figure, Shape, Style
from app.view_model.analysis.scene import Scene
from app.view_model.curve_view import Floats
from app.view_model.refusals import in_words
from curvecore import CurveError, ensemble

_SAMPLES = 240


def disturbed_curves(scene: Scene) -> tuple[list[Figure], str]:
    """Return the curves as one figure, or in words why there are none; heavy."""
    curve, settings = scene.view.curve, scene.settings
    if curve is None:
        return [], ""
    epsilon = settings.point_error or 0.0
    try:
        made = ensemble(
            curve,
            epsilon,
            settings.parameter_error,
            settings.ensemble_count,
            settings.ensemble_seed,
            closed=scene.view.source.is_closed,
            remake=scene.view.with_knots if scene.view.source.family.derivatives else None,
        )
    except CurveError as reason:
        text = in_words(str(reason).replace("parameter_error", "δ"))
        return [], f"Not drawn: {text}."
    curves = made.evaluate(_parameters(curve.parameters))
    lines = np.concatenate([curves, np.full((len(curves), 1, 2), np.nan)], axis=1)
    words = f"{len(curves)} curves, seed {settings.ensemble_seed}."
    return [Figure(Style.ENSEMBLE, Shape.LINE, lines.reshape(-1, 2))], words


def _parameters(knots: Floats) -> Floats:
    """Return parameters for a drawing, the knots among them."""
    count = max(_SAMPLES // (len(knots) - 1), 3)
    inner = knots[:-1, None] + np.diff(knots)[:, None] * np.linspace(0.0, 1.0, count, endpoint=False)
    return np.append(inner.ravel(), knots[-1])
