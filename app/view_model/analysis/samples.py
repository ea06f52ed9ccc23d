"""The curve and its derivatives at parameters that suit drawing."""

from __future__ import annotations

import numpy as np

from app.view_model.curve_view import CurveView
from app.view_model.sampling import Samples, one_sided

MOST = 600
"""Samples of a whole curve; more are not told apart on a screen."""

LEAST_A_SEGMENT = 6

_FEW, _LONG = 3, 200
"""Samples a segment of a polynomial through more than `_LONG` points, whose derivatives cost most."""


def samples_of(view: CurveView) -> list[Samples]:
    """Return samples of every piece, the joints among them, one-sided at both ends of each segment.

    A joint of a Hermite curve stands there twice: its second derivative is another one on either side.
    """
    if view.curve is None or not view.is_current:
        return []
    segments = len(view.parameters) - 1
    least = _FEW if not view.source.family.is_local and segments > _LONG else LEAST_A_SEGMENT
    count = max(least, min(MOST // segments, 60))
    samples = []
    for piece in view.pieces:
        t = one_sided(piece.parameters, np.full(len(piece.parameters) - 1, count)).t
        samples.append(Samples(t, *piece.derivatives_at(t, (0, 1, 2))))
    return samples
