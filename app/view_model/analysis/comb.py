"""The curvature comb: how the curve bends, drawn at right angles to it.

A tooth stands on the outer side of the bend, its length in proportion to the curvature. Where the curvature
jumps, at a joint, two teeth of different length stand at one point.
"""

from __future__ import annotations

import numpy as np

from app.view_model.analysis.figures import Figure, Floats, Shape, Style
from app.view_model.analysis.samples import Samples
from app.view_model.analysis.scene import Scene, usual_length
from curvecore import curvature_of

_SHARE = 0.2
"""The longest tooth against the size of the points at scale 1."""

_LONGEST = 5.0
"""How far a tooth may surpass nine tenths of all teeth: at a cusp it would be infinite."""


def comb(scene: Scene) -> list[Figure]:
    """Return the comb of a curve: its teeth, and the line through their ends."""
    pieces = scene.samples
    teeth = [_normals(piece) * -np.nan_to_num(_curvature(piece))[:, None] for piece in pieces]
    if not pieces:
        return []
    longest = usual_length(np.vstack(teeth), _LONGEST)
    unit = _SHARE * scene.size / longest * scene.settings.comb_scale if longest > 0 else 0.0
    figures = []
    for piece, tooth in zip(pieces, teeth, strict=True):
        ends = piece.points + tooth * unit
        figures.append(
            Figure(Style.COMB_TEETH, Shape.SEGMENTS, np.hstack([piece.points, ends]).reshape(-1, 2))
        )
        figures.append(Figure(Style.COMB_EDGE, Shape.LINE, ends))
    return figures


def _curvature(piece: Samples) -> Floats:
    return curvature_of(piece.velocities, piece.accelerations)


def _normals(piece: Samples) -> Floats:
    """Return unit normals to the left of the curve, zero where it stands still."""
    tangents = unit_tangents(piece.velocities)
    return np.column_stack([-tangents[:, 1], tangents[:, 0]])


def unit_tangents(velocities: Floats) -> Floats:
    """Return vectors (m, 2) of length 1 in the same directions, zero for zero."""
    largest = np.abs(velocities).max(axis=1, keepdims=True)
    # Divided first, so that squares of huge velocities stay finite.
    scaled = velocities / np.where(largest > 0, largest, 1.0)
    length = np.hypot(scaled[:, 0], scaled[:, 1])
    result: Floats = scaled / np.where(length > 0, length, 1.0)[:, None]
    return result
