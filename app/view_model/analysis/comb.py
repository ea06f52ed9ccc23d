"""The curvature comb: how the curve bends, drawn at right angles to it.

A tooth stands on the outer side of the bend, its length in proportion to the curvature. Where the curvature
jumps, at a joint, two teeth of different length stand at one point.
"""

from __future__ import annotations

import numpy as np

from app.view_model.analysis.figures import Figure, Floats, Shape, Style
from app.view_model.analysis.samples import Samples, samples_of
from app.view_model.curve_view import CurveView
from curvecore import curvature_of

_SHARE = 0.2
"""The longest tooth against the size of the points at scale 1."""

_LONGEST = 5.0
"""How far a tooth may surpass nine tenths of all teeth: at a cusp it would be infinite."""


def comb(view: CurveView, scale: float) -> list[Figure]:
    """Return the comb of a curve: its teeth, and the line through their ends."""
    pieces = samples_of(view)
    curvatures = [curvature_of(piece.velocities, piece.accelerations) for piece in pieces]
    if not pieces:
        return []
    unit = _unit(np.concatenate(curvatures), view) * scale
    figures = []
    for piece, curvature in zip(pieces, curvatures, strict=True):
        ends = piece.points - _normals(piece) * (np.nan_to_num(curvature) * unit)[:, None]
        teeth = np.hstack([piece.points, ends]).reshape(-1, 2)
        figures.append(Figure(Style.COMB_TEETH, Shape.SEGMENTS, teeth))
        figures.append(Figure(Style.COMB_EDGE, Shape.LINE, ends))
    return figures


def _unit(curvatures: Floats, view: CurveView) -> float:
    """Return the length of a tooth for curvature 1."""
    size = float(np.ptp(view.points, axis=0).max())
    usual = float(np.quantile(np.abs(curvatures[np.isfinite(curvatures)]), 0.9, method="lower"))
    largest = min(float(np.nanmax(np.abs(curvatures))), _LONGEST * usual)
    return _SHARE * size / largest if largest > 0 else 0.0


def _normals(piece: Samples) -> Floats:
    """Return unit normals to the left of the curve, zero where it stands still."""
    speed = np.hypot(piece.velocities[:, 0], piece.velocities[:, 1])
    unit = piece.velocities / np.where(speed > 0, speed, 1.0)[:, None]
    return np.column_stack([-unit[:, 1], unit[:, 0]])
