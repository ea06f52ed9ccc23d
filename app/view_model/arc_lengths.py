"""Arc length of a curve of the document, to a relative accuracy.

The core's arc length takes an absolute tolerance. What is asked for here is a share of the length itself, so
that a curve small against its distance from the origin, or one whose points all coincide, is measured as
well as any other.
"""

from __future__ import annotations

import numpy as np

from app.view_model.flattener import CoreCurve
from curvecore.lengths import ArcLength

_PARTS = np.arange(4) / 4
_LEAST = 1e-300
"""A tolerance for curves at rest; the next power of ten down is subnormal under the core's own factors."""


def arc_lengths_of(core: CoreCurve, accuracy: float) -> ArcLength:
    """Return the arc length of a curve as a function of t, and back.

    Parameters
    ----------
    core
        A curve in the plane.
    accuracy
        Error aimed at, against the length. `ArcLength.total` says what was reached: rounding, at points far
        from the origin for example, may not allow as much.
    """
    return ArcLength(core, max(accuracy * _least_length(core), _LEAST))


def _least_length(core: CoreCurve) -> float:
    """Return the length of a polyline through the curve, which is never longer than the curve."""
    joints = core.parameters
    between = joints[:-1, None] + np.diff(joints)[:, None] * _PARTS
    with np.errstate(all="ignore"):
        points = core.evaluate(np.append(between.ravel(), joints[-1]))
        length = float(np.hypot(*np.diff(points, axis=0).T).sum())
    return length if np.isfinite(length) else float(np.finfo(float).max)
