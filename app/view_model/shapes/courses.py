"""How curves run, as cubic pieces."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from curvecore import CurveError, cubic_path

from ...document.box_edits import Piece
from ...document.model import Curve
from ..curve.curve_view import view_of
from ..fitting.cubics import RELATIVE_TOLERANCE


@lru_cache(maxsize=64)
def course_of_curve(curve: Curve) -> tuple[Piece, ...]:
    """Return the pieces of a curve, in the plane; none where it has none."""
    core = view_of(curve).curve
    if core is None:
        return ()
    size = float(np.ptp(core.points, axis=0).max())
    try:
        path = cubic_path(core, RELATIVE_TOLERANCE * size) if size else None
    except CurveError:
        path = None
    if path is None:
        return ()
    return tuple(tuple((x, y) for x, y in piece) for piece in path.control_points.tolist())  # type: ignore[misc]
