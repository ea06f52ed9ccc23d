"""Dashed lines straight from arrays: Qt's own dashes begin anew with every piece, and are slow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from curvecore.arrays import FloatArray


def dashed(segments: FloatArray, pattern: Sequence[float]) -> FloatArray:
    """Return what remains of segments (m, 4), drawn one after the other with a pattern of pixels.

    `pattern` has the lengths of a dash, a gap, a dash and so on; empty, everything remains.
    """
    if not pattern or not len(segments):
        return segments
    along = segments[:, 2:] - segments[:, :2]
    ends = np.cumsum(np.hypot(along[:, 0], along[:, 1]))
    total = float(ends[-1])
    stops = np.cumsum(pattern)
    turns = np.arange(np.ceil(total / stops[-1]) + 1)[:, None] * stops[-1]
    switches = (turns + stops).ravel()
    cuts = np.unique(np.concatenate([[0.0], ends, switches[switches < total]]))
    middle = (cuts[:-1] + cuts[1:]) / 2
    # Pieces between an even and an odd switch are dashes.
    is_dash = np.searchsorted(switches, middle) % 2 == 0
    owner = np.minimum(np.searchsorted(ends, middle), len(segments) - 1)[is_dash]
    starts = np.concatenate([[0.0], ends[:-1]])
    lengths = np.maximum(ends - starts, 1e-300)
    shares = [
        np.clip((cut[is_dash] - starts[owner]) / lengths[owner], 0.0, 1.0)[:, None]
        for cut in (cuts[:-1], cuts[1:])
    ]
    pieces = [segments[owner, :2] + share * along[owner] for share in shares]
    return np.hstack(pieces)
