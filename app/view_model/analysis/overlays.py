"""The figures of everything that is switched on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from app.tasks.progress import Report, silent
from app.view_model.analysis.band import band
from app.view_model.analysis.circle import circle
from app.view_model.analysis.comb import comb
from app.view_model.analysis.ensembles import disturbed_curves
from app.view_model.analysis.figures import Figure
from app.view_model.analysis.marks import marks
from app.view_model.analysis.polygons import bezier_polygon_of_polynomial, bezier_polygons, polygon
from app.view_model.analysis.scene import Scene, is_quick
from app.view_model.analysis.settings import AnalysisSettings, Overlay
from app.view_model.analysis.ticks import ticks
from app.view_model.analysis.vectors import vectors
from app.view_model.curve_view import CurveView

Described = tuple[list[Figure], str]


@dataclass(frozen=True, eq=False)
class Picture:
    """What is drawn over a curve, the first figure at the bottom, and a sentence to some of the overlays."""

    figures: list[Figure] = field(default_factory=list)
    notes: dict[Overlay, str] = field(default_factory=dict)


_LIVE: dict[Overlay, Callable[[Scene], Described]] = {
    Overlay.BAND: band,
    Overlay.COMB: lambda scene: (comb(scene), ""),
    Overlay.POLYGON: lambda scene: (polygon(scene.view), ""),
    Overlay.BEZIER: lambda scene: bezier_polygons(scene.view),
    Overlay.TICKS: lambda scene: (ticks(scene), ""),
    Overlay.CIRCLE: circle,
    Overlay.VELOCITIES: lambda scene: (vectors(scene, 1), ""),
    Overlay.ACCELERATIONS: lambda scene: (vectors(scene, 2), ""),
}
"""In the order in which they are drawn."""


def live_picture(view: CurveView, settings: AnalysisSettings, scrub: float | None = None) -> Picture:
    """Return what follows a drag frame by frame."""
    if not view.is_current or not is_quick(view):
        return Picture()
    return _picture(Scene(view, settings, scrub), _LIVE)


def settles(view: CurveView, settings: AnalysisSettings) -> frozenset[Overlay]:
    """Return the overlays that are computed only once things have settled."""
    if not view.is_current:
        return frozenset()
    slow = {Overlay.MARKS, Overlay.ENSEMBLE}
    if view.curve is not None and view.curve.is_one_polynomial:
        slow.add(Overlay.BEZIER)
    return settings.overlays if not is_quick(view) else settings.overlays & slow


def settling_key(view: CurveView, settings: AnalysisSettings, scrub: float | None) -> object:
    """Return what the settled picture of a curve depends on; equal keys, equal pictures."""
    if not is_quick(view):
        return settings, scrub
    errors = (settings.point_error, settings.parameter_error)
    return settles(view, settings), errors, settings.ensemble_count, settings.ensemble_seed


def settled_picture(
    view: CurveView,
    settings: AnalysisSettings,
    scrub: float | None = None,
    report: Report = silent,
) -> Picture:
    """Return what is too heavy for a frame."""
    scene = Scene(view, settings, scrub)
    slow: dict[Overlay, Callable[[Scene], Described]] = {
        Overlay.ENSEMBLE: disturbed_curves,
        Overlay.BEZIER: bezier_polygon_of_polynomial,
        Overlay.MARKS: lambda scene: marks(scene, report),
    }
    parts = slow if is_quick(view) else _LIVE | slow
    wanted = settles(view, settings)
    return _picture(scene, {each: draw for each, draw in parts.items() if each in wanted}, report)


def _picture(
    scene: Scene,
    parts: dict[Overlay, Callable[[Scene], Described]],
    report: Report = silent,
) -> Picture:
    picture = Picture()
    # A wild curve leaves the range of numbers; what is not finite is not drawn.
    with np.errstate(all="ignore"):
        for overlay, draw in parts.items():
            report(0.0, "Computing")
            if overlay in scene.settings.overlays:
                figures, words = draw(scene)
                picture.figures.extend(figures)
                if words:
                    picture.notes[overlay] = words
    return picture
