"""The figures of everything that is switched on."""

from __future__ import annotations

from app.view_model.analysis.comb import comb
from app.view_model.analysis.figures import Figure
from app.view_model.analysis.settings import AnalysisSettings, Overlay
from app.view_model.curve_view import CurveView


def live_figures(view: CurveView, settings: AnalysisSettings) -> list[Figure]:
    """Return what follows a drag frame by frame."""
    if not view.is_current:
        return []
    figures: list[Figure] = []
    if Overlay.COMB in settings.overlays:
        figures += comb(view, settings.comb_scale)
    return figures
