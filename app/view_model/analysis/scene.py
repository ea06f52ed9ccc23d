"""The curve that overlays are drawn of, with what several of them need."""

from __future__ import annotations

from functools import cached_property

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...tasks.progress import Report, silent
from ..curve.curve_view import CurveView
from ..geometry import Samples, one_sided, size_of
from .overlay_settings import OverlaySetting, SettingValues

_QUICK = 64
"""Points of the longest polynomial whose derivatives are found within a frame."""

_MOST = 600
"""Samples of a whole curve; more are not told apart on a screen."""

_LEAST_A_SEGMENT = 6

_FEW, _LONG = 3, 200
"""Samples a segment of a polynomial through more than `_LONG` points, whose derivatives cost most."""


class Scene(msgspec.Struct, frozen=True, eq=False, dict=True):
    """A curve and how it is to be shown.

    Attributes
    ----------
    scrub
        The scrub line's t; None without one.
    report
        Called now and then by what takes long; raises when nobody waits for it any more.
    """

    view: CurveView
    settings: SettingValues
    scrub: float | None = None
    report: Report = silent

    def value(self, setting: OverlaySetting) -> float:
        """Return what a setting of an overlay is."""
        return self.settings.value(setting)

    @cached_property
    def samples(self) -> list[Samples]:
        """Samples of every piece; computed once for all overlays."""
        return _samples_of(self.view)

    @cached_property
    def size(self) -> float:
        """The larger side of the box around the points."""
        return size_of(self.view.points)

    def at_scrub(self, order: int) -> FloatArray | None:
        """Return a derivative at the scrub line, None without a line or where it is not finite."""
        curve = self.view.curve
        if self.scrub is None or curve is None:
            return None
        value: FloatArray = curve.evaluate(min(max(self.scrub, curve.domain[0]), curve.domain[1]), order)
        return value if np.isfinite(value).all() else None


def is_quick(view: CurveView) -> bool:
    """Whether derivatives along the whole curve can be had in every frame of a drag."""
    return view.curve is None or view.curve.is_local or len(view.parameters) <= _QUICK


def _samples_of(view: CurveView) -> list[Samples]:
    """Return samples of every piece, the joints among them, one-sided at both ends of each segment.

    A joint of a Hermite curve stands there twice: its second derivative is another one on either side.
    """
    if view.curve is None or not view.is_current:
        return []
    segments = len(view.parameters) - 1
    least = _FEW if not view.source.family.curve_class.is_local and segments > _LONG else _LEAST_A_SEGMENT
    count = max(least, min(_MOST // segments, 60))
    samples = []
    for piece in view.pieces:
        t = one_sided(piece.parameters, np.full(len(piece.parameters) - 1, count)).t
        samples.append(Samples(t, *piece.derivatives_at(t, (0, 1, 2))))
    return samples
