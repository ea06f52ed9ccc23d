"""The figures of all overlays that are switched on."""

from __future__ import annotations

from collections.abc import Collection

import msgspec
import numpy as np

from ...tasks.progress import Report, silent
from ..curve.curve_view import CurveView
from .overlay import Figure, Overlay, OverlayInput, is_quick
from .settings import AnalysisSettings


class Picture(msgspec.Struct, frozen=True, eq=False):
    """The figures over a curve, the first one at the bottom, and the notes of overlays."""

    figures: list[Figure] = []
    notes: dict[Overlay, str] = {}


def live_picture(view: CurveView, settings: AnalysisSettings, scrub: float | None = None) -> Picture:
    """Return the picture of overlays that follow a drag frame by frame."""
    if not view.is_current:
        return Picture()
    return _picture(OverlayInput(view, settings, scrub), settings.overlays - settling(view, settings))


def settling(view: CurveView, settings: AnalysisSettings) -> frozenset[Overlay]:
    """Return the overlays that are computed only when nothing changes any more."""
    if not view.is_current:
        return frozenset()
    if not is_quick(view):
        return settings.overlays
    return frozenset(overlay for overlay in settings.overlays if overlay.settles(view))


def settling_key(view: CurveView, settings: AnalysisSettings, scrub: float | None) -> object:
    """Return the key of the settled picture of a curve: equal keys, equal pictures."""
    waiting = settling(view, settings)
    values = {setting: settings.value(setting) for overlay in waiting for setting in overlay.settings}
    return waiting, values, scrub if any(overlay.follows_scrub for overlay in waiting) else None


def settled_picture(
    view: CurveView,
    settings: AnalysisSettings,
    scrub: float | None = None,
    report: Report = silent,
) -> Picture:
    """Return the picture of overlays that are too heavy for a frame."""
    return _picture(OverlayInput(view, settings, scrub, report), settling(view, settings))


def _picture(data: OverlayInput, overlays: Collection[Overlay]) -> Picture:
    picture = Picture()
    # A wild curve leaves the range of numbers; points that are not finite are not drawn.
    with np.errstate(all="ignore"):
        for overlay in sorted(
            overlays, key=lambda overlay: overlay.rank if overlay.layer is None else overlay.layer
        ):
            data.report(0.0, "Computing")
            drawn = overlay.draw(data)
            picture.figures.extend(drawn.figures)
            if drawn.note:
                picture.notes[overlay] = drawn.note
    return picture
