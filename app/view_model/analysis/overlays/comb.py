"""The curvature comb: the curvature as teeth at right angles to the curve.

A tooth stands on the outer side of the bend, its length in proportion to the curvature. Where the curvature
jumps, at a joint, two teeth of different length stand at one point.
"""

from __future__ import annotations

import numpy as np

import curvecore
from curvecore.arrays import FloatArray

from ...geometry import Samples, to_the_left, unit_tangents, usual_length
from ...line_styles import LineStyle
from ...settings import Factor
from ..overlay import Figure, Figures, Group, Overlay, OverlayInput, Shape

TEETH = LineStyle("accent", 0.35)
EDGE = LineStyle("accent", 0.9)

SCALE = Factor("combScale", "Length of the teeth")
"""1 makes the longest a fifth of the curve's size."""

_SHARE = 0.2
"""The longest tooth against the size of the points at scale 1."""

_LONGEST = 5.0
"""Largest factor of a tooth over nine tenths of all teeth: at a cusp it would be infinite."""

_STRAIGHT = 1e-10
"""Curvature times the square of the size, relative to the largest coordinate, up to which all of it is
rounding, as along straight lines: some hundred segments divide the size, and cancel a few digits."""


def comb(data: OverlayInput) -> Figures:
    """Return the comb of a curve: its teeth, and the line through their ends."""
    pieces = data.samples
    teeth = [_tooth(piece) for piece in pieces]
    if not pieces:
        return Figures()
    longest = usual_length(np.vstack(teeth), _LONGEST)
    coordinate = max(float(np.abs(piece.points).max()) for piece in pieces)
    bends = longest * data.size**2 > _STRAIGHT * coordinate
    unit = _SHARE * data.size / longest * data.value(SCALE) if bends else 0.0
    figures = []
    for piece, tooth in zip(pieces, teeth, strict=True):
        ends = piece.points + tooth * unit
        figures.append(Figure(TEETH, Shape.SEGMENTS, np.hstack([piece.points, ends]).reshape(-1, 2)))
        figures.append(Figure(EDGE, Shape.LINE, ends))
    return Figures(figures)


def _tooth(piece: Samples) -> FloatArray:
    """Return the curvature as vectors to the outer side of the bend, zero where the curve stands still."""
    curvature = np.nan_to_num(curvecore.curvature_of(piece.velocities, piece.accelerations))
    return to_the_left(unit_tangents(piece.velocities)) * -curvature[:, None]


COMB = Overlay(
    name="comb",
    text="Curvature Comb",
    tip="Draw the curvature as teeth at right angles to the curve",
    key="Ctrl+Alt+1",
    icon="comb",
    group=Group.SHAPE,
    rank=10,
    layer=20,
    draw=comb,
    settings=(SCALE,),
)
